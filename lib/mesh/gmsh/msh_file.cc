#include "mesh/gmsh/msh_file.h"

#include "base/errors.h"
#include "base/text.h"
#include "mesh/gmsh/msh_stream.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <tuple>

namespace mesoslip
{
namespace
{
/** Kinds of elements that are read. */
struct MshKind
{
  int type;               ///< as in the file
  int dim;                ///< of the element
  unsigned int n_corners; ///< of one
};

constexpr std::array<MshKind, 6> msh_kinds = {
  {{15, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 2, 4}, {4, 3, 4}, {5, 3, 8}}};

/** Names of other kinds that Gmsh often writes. */
const std::map<int, std::string> other_kinds = {
  {6, "Prism 6"},        {7, "Pyramid 5"},        {8, "Line 3"},
  {9, "Triangle 6"},     {10, "Quadrilateral 9"}, {11, "Tetrahedron 10"},
  {12, "Hexahedron 27"}, {16, "Quadrilateral 8"}, {17, "Hexahedron 20"}};

/** Reads a file into MshFile. */
class MshReader
{
public:
  MshReader(const std::string &file, const int lowest_dim)
    : in(file)
    , lowest_dim(lowest_dim)
  {
    read_format();
    for (std::string name = in.line(); !name.empty(); name = in.line())
      if (name[0] == '$')
        {
          in.section = name;
          if (!read_section())
            skip();
        }
    if (mesh.tags.empty())
      in.fail("the file has no points");
  }

  MshFile mesh;

private:
  /** Where a number of a point in the file says which it is in the list. */
  unsigned int place_of(const std::size_t tag) const
  {
    if (tag >= 1 && tag <= mesh.tags.size() && mesh.tags[tag - 1] == tag)
      return static_cast<unsigned int>(tag - 1);
    const auto found =
      std::lower_bound(order.begin(), order.end(), tag,
                       [this](const auto k, const auto t) { return mesh.tags[k] < t; });
    if (found == order.end() || mesh.tags[*found] != tag)
      in.fail("an element has the point " + std::to_string(tag) + ", which is not there");
    return *found;
  }

  void read_format()
  {
    if (in.line() != "$MeshFormat")
      throw UserError(in.file +
                      " is no mesh of Gmsh: it does not begin with $MeshFormat");
    const auto version = in.text_number<double>();
    if (version != 4.1 && version != 2.2)
      throw UserError(in.file + " has the format " + to_text(version) +
                      "; set Mesh.MshFileVersion = 4.1 or 2.2 in Gmsh and save it again");
    old_format = version == 2.2;
    in.binary  = in.text_number<int>() == 1;
    if (const int bytes = in.text_number<int>(); bytes != 8)
      in.fail("numbers have " + std::to_string(bytes) + " bytes instead of 8");
    in.end_line();
    if (in.binary && in.number<std::int32_t>() != 1)
      in.fail("a machine with another order of bytes wrote it");
    expect_end();
  }

  /** Whether it is one that is of use. */
  bool read_section()
  {
    if (in.section == "$PhysicalNames")
      read_names();
    else if (in.section == "$Entities" && !old_format)
      read_entities();
    else if (in.section == "$Nodes")
      old_format ? read_old_points() : read_points();
    else if (in.section == "$Elements")
      old_format ? read_old_elements() : read_elements();
    else
      return false;
    expect_end();
    return true;
  }

  std::string end_of_section() const
  {
    return "$End" + in.section.substr(1);
  }

  void expect_end()
  {
    if (in.line() != end_of_section())
      in.fail(end_of_section() + " does not come where it should");
  }

  void skip()
  {
    for (std::string line = in.line(); line != end_of_section(); line = in.line())
      if (line.empty())
        in.fail(end_of_section() + " is missing");
  }

  void read_names()
  {
    for (int n = in.text_number<int>(); n > 0; --n)
      {
        const int dim = in.text_number<int>(), group = in.text_number<int>();
        const std::string name = in.line();
        if (name.size() < 2 || name.front() != '"' || name.back() != '"')
          in.fail("the name of group " + std::to_string(group) + " is not in quotes");
        mesh.names[{{dim, group}}] = name.substr(1, name.size() - 2);
      }
  }

  /** The physical groups of the parts of the geometry. */
  void read_entities()
  {
    std::array<std::size_t, 4> n;
    for (std::size_t &of_dim : n)
      of_dim = in.count(8);
    for (int dim = 0; dim < 4; ++dim)
      for (std::size_t k = 0; k < n[dim]; ++k)
        {
          const auto entity = in.number<std::int32_t>();
          for (int x = 0; x < (dim == 0 ? 3 : 6); ++x)
            in.number<double>();
          for (std::size_t left = in.count(1); left > 0; --left)
            put_into_group(dim, entity, std::abs(in.number<std::int32_t>()));
          if (dim > 0)
            for (std::size_t left = in.count(1); left > 0; --left)
              in.number<std::int32_t>();
        }
  }

  void put_into_group(const int dim, const int entity, const int group)
  {
    const auto [other, is_first] = groups.insert({{{dim, entity}}, group});
    if (is_first || dim < lowest_dim || other->second == group)
      return;
    const auto name = [&](const int number) {
      const auto found = mesh.names.find({{dim, number}});
      return found == mesh.names.end() ? std::to_string(number) : found->second;
    };
    throw UserError(in.file + ": part " + std::to_string(entity) +
                    " of the geometry is in two physical groups, '" +
                    name(other->second) + "' and '" + name(group) + "'; put it into one");
  }

  void read_points()
  {
    std::size_t n_blocks = in.count(1);
    reserve_points(in.count(2));
    in.number<std::size_t>(); // the smallest and the largest number
    in.number<std::size_t>();
    for (; n_blocks > 0; --n_blocks)
      {
        const auto dim = in.number<std::int32_t>();
        in.number<std::int32_t>();
        const int n_parameters = in.number<std::int32_t>() == 0 ? 0 : dim;
        const std::size_t n    = in.count(2);
        for (std::size_t k = 0; k < n; ++k)
          mesh.tags.push_back(in.number<std::size_t>());
        for (std::size_t k = 0; k < n; ++k)
          {
            read_place();
            for (int p = 0; p < n_parameters; ++p)
              in.number<double>();
          }
      }
    sort_points();
  }

  void read_old_points()
  {
    const std::size_t n = in.checked_count(in.text_number<std::size_t>(), 2);
    in.end_line();
    reserve_points(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        mesh.tags.push_back(in.number<std::int32_t>());
        read_place();
      }
    sort_points();
  }

  void reserve_points(const std::size_t n)
  {
    if (n >= std::numeric_limits<unsigned int>::max())
      throw UserError(in.file + " has " + std::to_string(n) +
                      " points; at most 4e9 can be numbered");
    mesh.tags.reserve(n);
    mesh.coordinates.reserve(3 * n);
  }

  void read_place()
  {
    for (int d = 0; d < 3; ++d)
      mesh.coordinates.push_back(in.number<double>());
  }

  void sort_points()
  {
    order.resize(mesh.tags.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [this](const auto a, const auto b) { return mesh.tags[a] < mesh.tags[b]; });
    for (std::size_t k = 1; k < order.size(); ++k)
      if (mesh.tags[order[k - 1]] == mesh.tags[order[k]])
        in.fail("two points have the number " + std::to_string(mesh.tags[order[k]]));
  }

  void read_elements()
  {
    std::size_t n_blocks = in.count(1);
    for (int k = 0; k < 3; ++k) // of elements, their smallest and largest number
      in.number<std::size_t>();
    for (; n_blocks > 0; --n_blocks)
      {
        const auto dim       = in.number<std::int32_t>();
        const auto entity    = in.number<std::int32_t>();
        const MshKind &kind  = kind_of(in.number<std::int32_t>());
        std::size_t left     = in.count(2);
        const auto in_groups = groups.find({{dim, entity}});
        const int group      = in_groups == groups.end() ? 0 : in_groups->second;
        for (; left > 0; --left)
          {
            in.number<std::size_t>();
            read_corners<std::size_t>({kind.dim, group, entity, kind.type}, kind);
          }
      }
  }

  void read_old_elements()
  {
    std::size_t left = in.checked_count(in.text_number<std::size_t>(), 2);
    in.end_line();
    while (left > 0)
      {
        // In text each element has a number and a head, in binary many follow one.
        if (!in.binary)
          in.number<std::int32_t>();
        const MshKind &kind = kind_of(in.number<std::int32_t>());
        int n               = in.binary ? in.number<std::int32_t>() : 1;
        const int n_tags    = in.number<std::int32_t>();
        if (n < 1 || static_cast<std::size_t>(n) > left)
          in.fail("elements are more or fewer than it says");
        left -= n;
        for (; n > 0; --n)
          {
            if (in.binary)
              in.number<std::int32_t>();
            read_old_element(kind, n_tags);
          }
      }
  }

  void read_old_element(const MshKind &kind, const int n_tags)
  {
    std::array<int, 2> tags = {}; // group and part of the geometry
    for (int k = 0; k < n_tags; ++k)
      {
        const auto tag = in.number<std::int32_t>();
        if (k < 2)
          tags[k] = tag;
      }
    const int group = std::abs(tags[0]), entity = n_tags < 2 ? group : tags[1];
    if (group != 0)
      put_into_group(kind.dim, entity, group);
    read_corners<std::int32_t>({kind.dim, group, entity, kind.type}, kind);
  }

  const MshKind &kind_of(const int type) const
  {
    for (const MshKind &kind : msh_kinds)
      if (kind.type == type)
        return kind;
    const auto name = other_kinds.find(type);
    throw UserError(in.file + " has cells of the kind '" +
                    (name == other_kinds.end() ? std::to_string(type) : name->second) +
                    "'; " +
                    (type > 7 ? "set Mesh.ElementOrder = 1 in Gmsh"
                              : "mesoslip reads triangles and quadrilaterals, "
                                "tetrahedra or hexahedra"));
  }

  template <typename T>
  void read_corners(const MshFile::Block &block, const MshKind &kind)
  {
    std::deque<unsigned int> *corners =
      kind.dim < lowest_dim ? nullptr : &mesh.blocks[block];
    for (unsigned int v = 0; v < kind.n_corners; ++v)
      {
        const auto tag = static_cast<std::size_t>(in.number<T>());
        if (corners != nullptr)
          corners->push_back(place_of(tag));
      }
  }

  MshStream in;
  const int lowest_dim; ///< of the elements that are kept
  bool old_format = false;
  std::map<std::array<int, 2>, int> groups; ///< of parts of the geometry, by dimension
  std::vector<unsigned int> order;          ///< of the points by their numbers
};
} // namespace

bool MshFile::Block::operator<(const Block &other) const
{
  return std::tie(dim, group, entity, type) <
         std::tie(other.dim, other.group, other.entity, other.type);
}

MshFile read_msh(const std::string &file, const int lowest_dim)
{
  return std::move(MshReader(file, lowest_dim).mesh);
}
} // namespace mesoslip
