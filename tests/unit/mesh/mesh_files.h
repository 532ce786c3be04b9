#ifndef mesoslip_tests_unit_mesh_mesh_files_h
#define mesoslip_tests_unit_mesh_mesh_files_h

#include "base/errors.h"
#include "mesh/boundary.h"
#include "mesh/cell_quality.h"
#include "mesh/read_gmsh.h"

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace mesh_files
{
using namespace mesoslip;

/** Each test writes it anew. */
inline const std::string file = testing::TempDir() + "mesoslip_mesh_test.msh";

/** Writes a mesh in Gmsh's format 2.2, line by line: "x y z", "type group corner...", names
 * "dimension group name"; all cells in one part of the geometry, as meshio writes them, or one for
 * each group. */
inline void write_mesh(const std::vector<std::string> &points,
                       const std::vector<std::string> &cells,
                       const std::vector<std::string> &names = {},
                       const bool one_part                   = false)
{
  std::ofstream out(file);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (!names.empty())
    out << "$PhysicalNames\n" << names.size() << '\n';
  for (const std::string &name : names)
    out << name << '\n';
  out << (names.empty() ? "" : "$EndPhysicalNames\n") << "$Nodes\n"
      << points.size() << "\n";
  for (std::size_t k = 0; k < points.size(); ++k)
    out << k + 1 << ' ' << points[k] << '\n';
  out << "$EndNodes\n$Elements\n" << cells.size() << "\n";
  for (std::size_t k = 0; k < cells.size(); ++k)
    {
      int type = 0, group = 0, n = 0;
      std::sscanf(cells[k].c_str(), "%d %d%n", &type, &group, &n);
      out << k + 1 << ' ' << type << " 2 " << group << ' ' << (one_part ? 0 : group)
          << cells[k].substr(n) << '\n';
    }
  out << "$EndElements\n";
}

inline testing::AssertionResult contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos
           ? testing::AssertionSuccess()
           : testing::AssertionFailure() << "'" << text << "' has no '" << part << "'";
}

/** What is wrong with a mesh of write_mesh(). */
inline std::string refusal(const int dim,
                           const std::vector<std::string> &points,
                           const std::vector<std::string> &cells)
{
  write_mesh(points, cells);
  const auto check = [](const auto &mesh) {
    cell_quality(mesh);
    faces_of_box(mesh, boundary_faces(mesh));
  };
  try
    {
      dim == 2 ? check(read_gmsh<2>(file, 1.)) : check(read_gmsh<3>(file, 1.));
    }
  catch (const UserError &e)
    {
      return e.what();
    }
  return "accepted";
}

/** Why the file is no mesh. */
inline std::string reading_error()
{
  try
    {
      read_gmsh<2>(file, 1.);
    }
  catch (const UserError &e)
    {
      return e.what();
    }
  return "accepted";
}

inline const std::vector<std::string> square = {"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
} // namespace mesh_files

#endif
