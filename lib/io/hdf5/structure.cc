#include "io/hdf5/structure.h"

#include "io/hdf5/bytes.h"
#include "io/hdf5/messages.h"
#include "io/hdf5/tables.h"

#include <set>
#include <utility>
#include <vector>

// Names of fields are those of the "HDF5 File Format Specification Version 3.0".
namespace mesoslip
{
namespace hdf5
{
namespace
{
/** All that can be reached from the root. */
class Structure
{
public:
  explicit Structure(const std::string &path)
    : file(path)
  {
  }

  void check()
  {
    waiting.push_back(root());
    while (!waiting.empty())
      {
        const Member member = waiting.back();
        waiting.pop_back();
        place = member.name;
        if (member.tree != undefined_address)
          check_group(member.tree, member.heap);
        if (member.header != undefined_address && visited.insert(member.header).second)
          check_object(member.header);
      }
  }

  /** The object that was looked at last, in words. */
  std::string at() const
  {
    return subject + place;
  }

private:
  /** A path, the address of its header, and those of its tables if it is a group and they
   * stand where it is listed. */
  struct Member
  {
    std::string name;
    std::uint64_t header = undefined_address;
    std::uint64_t tree = undefined_address, heap = undefined_address;
  };

  /** From the superblock (II.A). */
  Member root()
  {
    const auto block = file.read(0, 96);
    Bytes bytes(block);
    bytes.signature(superblock_signature.c_str());
    const std::uint64_t versions = bytes.number(5);
    require((versions & 0xff) == 0, other_kind);
    const std::uint64_t address_bytes = bytes.number(1), length_bytes = bytes.number(1);
    bytes.take(1);
    most_members = 2 * bytes.number(2);
    most_nodes   = 2 * bytes.number(2);
    bytes.take(4);
    const std::uint64_t base = bytes.number(8);
    bytes.take(16);
    const std::uint64_t driver = bytes.number(8);
    require(address_bytes == 8 && length_bytes == 8 && base == file.base() &&
              driver == undefined_address,
            other_kind);
    bytes.take(8);
    return read_member("/", bytes);
  }

  /** An entry of a symbol table (III.C), after its name. */
  static Member read_member(const std::string &name, Bytes &entry)
  {
    enum : std::uint64_t
    {
      group        = 1,
      link_by_name = 2
    };
    Member member;
    member.name              = name;
    member.header            = entry.number(8);
    const std::uint64_t kind = entry.number(4);
    entry.take(4);
    Bytes cached = entry.take(16);
    if (kind == group)
      {
        member.tree = cached.number(8);
        member.heap = cached.number(8);
      }
    else if (kind == link_by_name)
      member.header = undefined_address;
    return member;
  }

  /** A "version 1 object header" (IV.A.1.a), in one block or several. */
  void check_object(const std::uint64_t address)
  {
    subject                        = "the header of ";
    constexpr std::uint64_t prefix = 16;
    const auto head                = file.read(address, prefix);
    Bytes bytes(head);
    require(bytes.number(1) == 1, other_kind);
    bytes.take(7);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks = {
      {address + prefix, bytes.number(4)}};
    for (std::size_t k = 0; k < blocks.size(); ++k)
      {
        const auto block = file.read(blocks[k].first, blocks[k].second);
        Bytes messages(block);
        constexpr std::size_t message_prefix = 8;
        while (messages.left() >= message_prefix)
          check_message(messages, blocks);
      }
  }

  void check_message(Bytes &messages,
                     std::vector<std::pair<std::uint64_t, std::uint64_t>> &blocks)
  {
    subject                  = "the header of ";
    const std::uint64_t type = messages.number(2), size = messages.number(2),
                        flags = messages.number(1);
    messages.take(3);
    Bytes body                     = messages.take(size);
    constexpr std::uint64_t shared = 2;
    switch (static_cast<Message>(type))
      {
      case Message::attribute:
        subject = "an attribute of ";
        require((flags & shared) == 0, other_kind);
        return check_attribute(body);
      case Message::attribute_info:
        subject = "an attribute of ";
        throw Damage{other_kind};
      case Message::continuation:
        blocks.emplace_back(body.number(8), 0);
        blocks.back().second = body.number(8);
        return;
      case Message::symbol_table:
        {
          const std::uint64_t tree = body.number(8);
          return check_group(tree, body.number(8));
        }
      case Message::datatype:
        require((flags & shared) == 0, other_kind);
        return check_dataset_type(body);
      case Message::link_info:
        return check_link_info(body);
      case Message::link:
        waiting.push_back({path_of("..."), linked_object(body)});
        return;
      case Message::layout:
        return check_chunks(chunk_tree(body));
      }
  }

  void check_chunks(const ChunkTree &chunks)
  {
    if (chunks.address == undefined_address ||
        !chunk_trees.emplace(chunks.address, chunks.key_bytes).second)
      return;
    subject                      = "the list of chunks of ";
    constexpr std::uint64_t most = 64;
    const auto no_check          = [](const Bytes &) {};
    const auto check_chunk       = [this](const std::uint64_t address, Bytes key) {
      file.require_inside(address, key.number(4));
    };
    walk(file, {1, chunks.key_bytes, most, no_check, check_chunk}, chunks.address);
  }

  /** Tree and names of a group's members, by their addresses. */
  void check_group(const std::uint64_t tree, const std::uint64_t heap)
  {
    if (!groups.emplace(tree, heap).second)
      return;
    subject = "the list of members of ";
    const Names names(file, heap);
    const auto check_key     = [&](Bytes key) { names.at(key.number(8)); };
    const auto check_members = [&](const std::uint64_t address, const Bytes &) {
      this->check_members(address, names);
    };
    walk(file, {0, 8, most_nodes, check_key, check_members}, tree);
  }

  /** A "symbol table node" (III.B). */
  void check_members(const std::uint64_t address, const Names &names)
  {
    constexpr std::size_t entry_bytes = 40;
    const auto head                   = file.read(address, 8);
    Bytes bytes(head);
    bytes.signature("SNOD");
    bytes.take(2);
    const std::uint64_t n = bytes.number(2);
    require(n <= most_members, "is a damaged tree");
    const auto block = file.read(address + 8, n * entry_bytes);
    Bytes entries(block);
    for (std::uint64_t k = 0; k < n; ++k)
      {
        const std::string name = names.at(entries.number(8));
        waiting.push_back(read_member(path_of(name), entries));
      }
  }

  std::string path_of(const std::string &name) const
  {
    constexpr std::size_t longest = 1000; // of a group in itself it has no end
    const std::string path        = (place == "/" ? "" : place) + "/" + name;
    return path.size() > longest ? "..." : path;
  }

  const RawFile file;
  std::uint64_t most_members = 0, most_nodes = 0;
  std::vector<Member> waiting;
  std::set<std::uint64_t> visited;
  std::set<std::pair<std::uint64_t, std::uint64_t>> groups, chunk_trees;
  std::string subject = "the superblock of ", place = "/";
};
} // namespace

std::string structure_problem(const std::string &path)
{
  Structure structure(path);
  try
    {
      structure.check();
    }
  catch (const Damage &damage)
    {
      return structure.at() + " " + damage.what;
    }
  return "";
}
} // namespace hdf5
} // namespace mesoslip
