#include "mesh/gmsh_content.h"

#include "base/errors.h"
#include "mesh/gmsh/cell_kinds.h"
#include "mesh/gmsh/counts.h"
#include "mesh/gmsh/session.h"

#include <deal.II/base/exceptions.h>

#include <gmsh.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace mesoslip
{
namespace
{
/** Appends the cells of the part @p entity of the geometry, which has dimension @p d. */
void append(std::vector<GmshCells> &cells,
            const unsigned int group,
            const int d,
            const int entity,
            const GmshFile &file)
{
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> cell_tags, nodes;
  gmsh::model::mesh::getElements(types, cell_tags, nodes, d, entity);
  for (std::size_t t = 0; t < types.size(); ++t)
    {
      const std::vector<unsigned int> &corner = corners_in_order(types[t], file);
      GmshCells some      = {group, corner.size(), {}, middles_in_order(types[t])};
      const std::size_t n = some.n_nodes();
      some.tags.resize(nodes[t].size());
      for (std::size_t k = 0; k < nodes[t].size(); ++k)
        {
          const std::size_t tag =
            nodes[t][k % n < corner.size() ? k - k % n + corner[k % n] : k];
          if (tag > std::numeric_limits<unsigned int>::max())
            throw UserError(file.name + " has a point with the number " +
                            std::to_string(tag) +
                            "; let Gmsh renumber the mesh, so that 32 bits hold it");
          some.tags[k] = static_cast<unsigned int>(tag);
        }
      cells.push_back(std::move(some));
      cell_tags[t] = {};
      nodes[t]     = {};
    }
}

/** A physical group and its parts of the geometry. */
struct PhysicalGroup
{
  int tag;
  std::vector<int> entities;
};

/** Physical groups of dimension @p d. */
std::vector<PhysicalGroup> physical_groups(const int d)
{
  std::vector<PhysicalGroup> result;
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, d);
  for (const auto &[dimension, tag] : groups)
    {
      result.push_back({tag, {}});
      gmsh::model::getEntitiesForPhysicalGroup(d, tag, result.back().entities);
    }
  return result;
}

/** Physical groups of a file that was read with Mesh.SwitchElementTags: each part is a
 * group. */
std::vector<PhysicalGroup> groups_by_tag(const int d, const std::string &file)
{
  std::vector<PhysicalGroup> result;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, d);
  for (const auto &[dimension, tag] : entities)
    if (tag < 0)
      throw UserError(file + " has the physical group " + std::to_string(tag) +
                      "; number groups from 1 on");
    else if (tag > 0) // 0 is no group
      result.push_back({tag, {tag}});
  return result;
}

/** Reads @p file, in which @p d is the dimension of the cells.
 * @return whether groups_by_tag() has the groups (format 2.2): the file has a group per
 * cell, but Gmsh gives a part of the geometry all groups of its cells, and other
 * programs give all parts the same number. */
bool merge(const std::string &file, const int d)
{
  std::ifstream in(file);
  std::string first, version;
  in >> first >> version;
  if (first.rfind("\xEF\xBB\xBF", 0) == 0)
    throw UserError(file + " begins with a mark of its encoding (UTF-8 with BOM), which "
                           "Gmsh does not read; save it without");
  if (first.empty() || first[0] != '$')
    throw UserError(file +
                    (first.empty() ? " is empty" : " does not begin with $MeshFormat") +
                    "; save the mesh again in Gmsh's format");
  require_gmsh_counts(file);
  gmsh::option::setNumber("Mesh.SwitchElementTags", 0);
  gmsh::merge(file);
  std::set<std::pair<int, int>> seen;
  bool is_twice = false;
  for (const int of : {d, d - 1})
    for (const PhysicalGroup &group : physical_groups(of))
      for (const int entity : group.entities)
        is_twice = !seen.emplace(of, entity).second || is_twice;
  if (!is_twice || version[0] != '2')
    return false;
  gmsh::clear();
  gmsh::option::setNumber("Mesh.SwitchElementTags", 1);
  gmsh::merge(file);
  return true;
}

/** Names of the groups of dimension @p d by number, from the first sections of @p file:
 * of several groups with one name Gmsh 4.8 keeps only the first name. */
std::map<int, std::string> names_in_file(const int d, const std::string &file)
{
  std::ifstream in(file);
  std::map<int, std::string> names;
  const auto begins = [](const std::string &line, const char *section) {
    return line.compare(0, std::string(section).size(), section) == 0;
  };
  bool here = false;
  for (std::string line;
       std::getline(in, line) && !begins(line, "$Nodes") && !begins(line, "$Entities");)
    {
      int dimension = 0, tag = 0;
      const std::size_t begin = line.find('"'), end = line.rfind('"');
      if (here && begin != end &&
          std::sscanf(line.c_str(), "%d %d", &dimension, &tag) == 2 && dimension == d)
        names[tag] = line.substr(begin + 1, end - begin - 1);
      else if (begins(line, "$"))
        here = begins(line, "$PhysicalNames");
    }
  return names;
}

/** All cells of dimension @p d in @p groups; groups with the same name are merged, and
 * their name is appended to @p names. Cells belong to one group, faces to any number. */
std::vector<GmshCells> cells_in_groups(const int d,
                                       const std::vector<PhysicalGroup> &groups,
                                       const bool are_faces,
                                       std::vector<std::string> &names,
                                       const GmshFile &file)
{
  auto name_of = names_in_file(d, file.name);
  std::vector<GmshCells> cells;
  std::map<int, std::set<std::size_t>> groups_of_entity;
  for (const PhysicalGroup &group : groups)
    {
      std::string &name = name_of[group.tag];
      if (name.empty())
        gmsh::model::getPhysicalName(d, group.tag, name);
      if (name.empty())
        name = std::to_string(group.tag);
      const std::size_t number =
        std::find(names.begin(), names.end(), name) - names.begin();
      if (number == names.size())
        names.push_back(name);
      for (const int entity : group.entities)
        {
          auto &others = groups_of_entity[entity];
          if (!others.insert(number).second)
            continue;
          if (!are_faces && others.size() > 1)
            throw UserError(file.name + ": part " + std::to_string(entity) +
                            " of the geometry is in two physical groups, '" +
                            names[*others.begin()] + "' and '" + names[*others.rbegin()] +
                            "'; put it into one");
          append(cells, static_cast<unsigned int>(number), d, entity, file);
        }
    }
  return cells;
}
} // namespace

GmshContent::GmshContent(const std::string &the_file,
                         const unsigned int dim,
                         const int max_order)
  : file(the_file)
{
  const GmshFile given     = {file, max_order};
  const char *const advice = "; if it is whole, save the mesh again in Gmsh's format";
  try
    {
      const GmshSession library;
      const int d        = static_cast<int>(dim);
      const bool of_tags = merge(file, d);
      const auto content = [&](const int of, std::vector<std::string> &names) {
        return cells_in_groups(of,
                               of_tags ? groups_by_tag(of, file) : physical_groups(of),
                               of < d, names, given);
      };
      require_cells(given, d);
      cells = content(d, phases);
      require_groups(file, d, count(cells));
      faces = content(d - 1, boundaries);
      if (d == 3)
        require_faces(file, cells, faces);
      // Last, because reading the tags of the cells takes their memory twice.
      std::vector<double> parametric;
      gmsh::model::mesh::getNodes(point_tags, coordinates, parametric, -1, -1, false,
                                  false);
    }
  catch (const UserError &)
    {
      throw;
    }
  catch (const std::string &message) // Gmsh 4.8
    {
      throw UserError(file + " cannot be read by Gmsh: " + message + advice);
    }
  catch (const std::runtime_error &error)
    {
      throw UserError(file + " cannot be read by Gmsh: " + error.what() + advice);
    }
  by_tag.resize(point_tags.size());
  std::iota(by_tag.begin(), by_tag.end(), 0U);
  std::sort(by_tag.begin(), by_tag.end(),
            [this](const auto a, const auto b) { return point_tags[a] < point_tags[b]; });
}

unsigned int GmshContent::place_of(const unsigned int tag) const
{
  const auto found =
    std::lower_bound(by_tag.begin(), by_tag.end(), tag,
                     [this](const auto k, const auto t) { return point_tags[k] < t; });
  AssertThrow(found != by_tag.end() && point_tags[*found] == tag,
              dealii::ExcMessage("Gmsh gave a cell with a point that it did not give"));
  return *found;
}

std::size_t count(const std::vector<GmshCells> &cells)
{
  std::size_t n = 0;
  for (const GmshCells &some : cells)
    n += some.tags.size() / some.n_nodes();
  return n;
}
} // namespace mesoslip
