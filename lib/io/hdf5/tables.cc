#include "io/hdf5/tables.h"

#include <algorithm>
#include <utility>

namespace mesoslip
{
namespace hdf5
{
Names::Names(const RawFile &file, const std::uint64_t address)
{
  const auto head = file.read(address, 32);
  Bytes bytes(head);
  bytes.signature("HEAP");
  bytes.take(4);
  const std::uint64_t size = bytes.number(8);
  const std::uint64_t free = bytes.number(8);
  data                     = file.read(bytes.number(8), size);
  check_free_blocks(free);
  ends = static_cast<std::size_t>(data.rend() - std::find(data.rbegin(), data.rend(), 0));
}

std::string Names::at(const std::uint64_t offset) const
{
  require(offset < ends, "has a name without end");
  return reinterpret_cast<const char *>(data.data() + offset);
}

// A chain of blocks, each with the offset of the next and its own size.
void Names::check_free_blocks(std::uint64_t offset) const
{
  constexpr std::uint64_t end = 1;
  constexpr std::size_t least = 16;
  require(!data.empty(), "has damaged names");
  for (std::size_t n = 0; offset != end; ++n)
    {
      require(offset < data.size() && n < data.size() / least, "has damaged names");
      Bytes block(data.data() + offset, data.size() - offset);
      offset                   = block.number(8);
      const std::uint64_t size = block.number(8);
      require(size >= least && size - least <= block.left(), "has damaged names");
    }
}

namespace
{
struct Node
{
  std::uint64_t level, used;
  std::vector<unsigned char> entries; // key, child, key, ..., child, key
};

Node read_node(const RawFile &file, const Tree &tree, const std::uint64_t address)
{
  constexpr std::size_t head_bytes = 24;
  const auto head                  = file.read(address, head_bytes);
  Bytes bytes(head);
  bytes.signature("TREE");
  const std::uint64_t type = bytes.number(1);
  Node node;
  node.level = bytes.number(1);
  node.used  = bytes.number(2);
  require(type == tree.type && node.used <= tree.most, "is a damaged tree");
  node.entries =
    file.read(address + head_bytes, node.used * (tree.key_bytes + 8) + tree.key_bytes);
  return node;
}
} // namespace

void walk(const RawFile &file, const Tree &tree, const std::uint64_t root)
{
  constexpr std::uint64_t any_level                            = 256;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> waiting = {{root, any_level}};
  while (!waiting.empty())
    {
      const auto [address, level] = waiting.back();
      waiting.pop_back();
      const Node node = read_node(file, tree, address);
      require(level == any_level || node.level == level, "is a damaged tree");
      Bytes entries(node.entries);
      for (std::uint64_t k = 0; k < node.used; ++k)
        {
          const Bytes key = entries.take(tree.key_bytes);
          tree.check_key(key);
          const std::uint64_t child = entries.number(8);
          if (node.level > 0)
            waiting.emplace_back(child, node.level - 1);
          else
            tree.visit(child, key);
        }
      tree.check_key(entries);
    }
}
} // namespace hdf5
} // namespace mesoslip
