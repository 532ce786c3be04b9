#include "base/errors.h"
#include "mesh/boundary.h"
#include "mesh/boundary/open_seams.h"
#include "mesh/cell_quality.h"
#include "mesh/gmsh/session.h"
#include "mesh/periodic_points.h"
#include "mesh/read_gmsh.h"

#include "mesh_files.h"

#include <gtest/gtest.h>

#include <gmsh.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

using namespace mesoslip;
using namespace mesh_files;

namespace
{
constexpr double radius = 0.3; // of the inclusion in the middle of a unit square or cube

/** Edges or faces of the unit box where coordinate @p axis is @p level. */
std::vector<int> side(const int dim, const int axis, const double level)
{
  std::vector<double> lower(3, -1e-6), upper(3, 1.1);
  lower[axis] = level - 1e-6;
  upper[axis] = level + 1e-6;
  gmsh::vectorpair found;
  gmsh::model::getEntitiesInBoundingBox(lower[0], lower[1], lower[2], upper[0], upper[1],
                                        upper[2], found, dim - 1);
  std::vector<int> tags;
  for (const auto &[dimension, tag] : found)
    tags.push_back(tag);
  return tags;
}

void name_group(const int dim, const std::vector<int> &tags, const std::string &name)
{
  gmsh::model::setPhysicalName(dim, gmsh::model::addPhysicalGroup(dim, tags), name);
}

/** Gmsh meshes a disc in a square or a ball in a cube, periodic, into the file. */
void generate(const int dim,
              const std::string &kind,
              const double size,
              const double version = 4.1,
              const bool binary    = false)
{
  namespace occ = gmsh::model::occ;
  const GmshSession session;
  const int box =
    dim == 2 ? occ::addRectangle(0, 0, 0, 1, 1) : occ::addBox(0, 0, 0, 1, 1, 1);
  const int ball = dim == 2 ? occ::addDisk(.5, .5, 0, radius, radius)
                            : occ::addSphere(.5, .5, .5, radius);
  gmsh::vectorpair all, hull;
  std::vector<gmsh::vectorpair> parts;
  occ::fragment({{dim, box}}, {{dim, ball}}, all, parts);
  occ::synchronize();
  const int inside = parts[1][0].second;
  std::vector<int> outside;
  for (const auto &part : all)
    if (part.second != inside)
      outside.push_back(part.second);
  name_group(dim, outside, "matrix");
  name_group(dim, {inside}, "fibre");
  gmsh::model::getBoundary({{dim, inside}}, hull, true, false);
  name_group(dim - 1, {hull[0].second}, "interface");
  name_group(dim - 1, side(dim, dim - 1, 0.), "contact");
  for (int axis = 0; axis < dim; ++axis)
    {
      std::vector<double> shift = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      shift[4 * axis + 3]       = 1.;
      gmsh::model::mesh::setPeriodic(dim - 1, side(dim, axis, 1.), side(dim, axis, 0.),
                                     shift);
    }
  gmsh::option::setNumber("Mesh.MeshSizeMax", size);
  gmsh::option::setNumber("Mesh.MeshSizeMin", size);
  gmsh::option::setNumber("Mesh.RecombinationAlgorithm", kind == "mixed" ? 0 : 2);
  for (const int part : outside)
    if (kind == "quadrilaterals")
      gmsh::model::mesh::setRecombine(2, part);
  if (kind == "quadrilaterals" || kind == "mixed")
    gmsh::model::mesh::setRecombine(2, inside);
  gmsh::model::mesh::generate(dim);
  if (kind == "hexahedra")
    {
      gmsh::option::setNumber("Mesh.SecondOrderLinear", 1);
      gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 2);
      gmsh::model::mesh::refine();
    }
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary);
  gmsh::write(file);
}

/** Number of edges of the fibre's polygon. */
template <int dim>
std::size_t n_interface_edges(const Mesh<dim> &mesh)
{
  std::size_t n = 0;
  for (const auto &face : mesh.faces)
    n += mesh.boundaries[face.boundary_id] == "interface" ? 1 : 0;
  return n;
}
} // namespace

/** Calls check() with the mesh of a kind, of cells of about @p size, as read from each format. */
template <int dim, typename Check>
void for_each_format(const std::string &kind, const double size, const Check &check)
{
  for (const double version : {4.1, 2.2})
    for (const bool binary : {false, true})
      {
        SCOPED_TRACE(kind + " " + std::to_string(version) + " " + std::to_string(binary));
        generate(dim, kind, size, version, binary);
        const Mesh<dim> mesh = read_gmsh<dim>(file, 1e-3);
        ASSERT_EQ(mesh.phases, (std::vector<std::string>{"matrix", "fibre"}));
        check(mesh);
      }
}

TEST(Mesh, AllFormatsOfGmshGiveTheSame)
{
  for (const std::string kind : {"triangles", "quadrilaterals", "mixed"})
    for_each_format<2>(kind, 0.15, [&](const Mesh<2> &mesh) {
      const MeshQuality<2> quality = cell_quality(mesh);
      const double n               = n_interface_edges(mesh);
      const double polygon         = 0.5 * n * radius * radius * std::sin(2. * M_PI / n);
      EXPECT_NEAR(quality.volume[1], 1e-6 * polygon, 1e-15);
      EXPECT_NEAR(quality.volume[0], 1e-6 * (1. - polygon), 1e-15);
      std::array<std::size_t, 5> with_corners = {};
      for (const auto &cell : mesh.cells)
        ++with_corners[cell.vertices.size()];
      EXPECT_EQ(with_corners[3] > 0, kind != "quadrilaterals");
      EXPECT_EQ(with_corners[4] > 0, kind != "triangles");
      EXPECT_GT(quality.worst_jacobian, 0.2);
    });
}

TEST(Mesh, AllFormatsOfGmshGiveTheSameSolid)
{
  for (const std::string kind : {"tetrahedra", "hexahedra"})
    {
      std::optional<Mesh<3>> first;
      for_each_format<3>(kind, 0.4, [&](const Mesh<3> &mesh) {
        if (!first)
          first = mesh;
        ASSERT_EQ(mesh.boundaries, first->boundaries);
        ASSERT_EQ(mesh.points.size(), first->points.size());
        ASSERT_EQ(mesh.cells.size(), first->cells.size());
        ASSERT_EQ(mesh.faces.size(), first->faces.size());
        EXPECT_EQ(mesh.cells[0].vertices.size(), kind == "tetrahedra" ? 4u : 8u);
        const MeshQuality<3> a = cell_quality(mesh), b = cell_quality(*first);
        EXPECT_NEAR(a.volume[0] + a.volume[1], 1e-9, 1e-20);
        for (unsigned int p = 0; p < 2; ++p)
          EXPECT_NEAR(a.volume[p], b.volume[p], 1e-12 * b.volume[p]);
        EXPECT_NEAR(a.worst_jacobian, b.worst_jacobian, 1e-9);
      });
    }
}

template <int dim>
void check_boundary(const std::string &kind)
{
  SCOPED_TRACE(kind);
  generate(dim, kind, 0.3);
  const Mesh<dim> mesh = read_gmsh<dim>(file, 2.);
  const auto faces     = boundary_faces(mesh);
  const auto sides     = faces_of_box(mesh, faces);
  const double area    = std::pow(2., dim - 1);
  const auto total     = [&](const std::vector<BoundaryFace<dim>> &part) {
    dealii::Tensor<1, dim> sum;
    for (const auto &a : boundary_points(mesh, part).normal_area)
      sum += a;
    return sum;
  };
  EXPECT_LT(total(faces).norm(), 1e-12);
  EXPECT_TRUE(open_seams(mesh, faces).empty());
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      EXPECT_NEAR(total(sides[2 * axis])[axis], -area, 1e-12);
      EXPECT_NEAR(total(sides[2 * axis + 1])[axis], area, 1e-12);
      const auto lower = boundary_points(mesh, sides[2 * axis]).points;
      const auto opposite =
        opposite_points(mesh, sides[2 * axis], sides[2 * axis + 1], axis, 0.1);
      EXPECT_EQ(opposite.pairs.size(), lower.size());
      EXPECT_LT(opposite.largest_mismatch, 1e-12);
    }
  // The area of a face goes to its points so that a linear pressure has the right moment.
  const auto top = boundary_points(mesh, sides[2 * dim - 1]);
  double moment  = 0.;
  for (std::size_t k = 0; k < top.points.size(); ++k)
    moment += mesh.points[top.points[k]][0] * top.normal_area[k][dim - 1];
  EXPECT_NEAR(moment, area, 1e-12);
  // Groups are what the user called them; an inner surface bounds nothing.
  for (unsigned int b = 0; b < mesh.boundaries.size(); ++b)
    {
      const auto group = faces_of_group(mesh, faces, b);
      if (mesh.boundaries[b] == "contact")
        EXPECT_NEAR(total(group)[dim - 1], -area, 1e-12);
      else
        EXPECT_TRUE(group.empty());
    }
}

TEST(Mesh, BoundaryOfABox)
{
  check_boundary<2>("triangles");
  check_boundary<2>("quadrilaterals");
  check_boundary<2>("mixed");
  check_boundary<3>("tetrahedra");
  check_boundary<3>("hexahedra");
}

TEST(Mesh, ScaledJacobian)
{
  Mesh<2> mesh;
  mesh.phases = {"all"};
  mesh.points = {{0., 0.}, {2., 0.}, {1., std::sqrt(3.)}};
  mesh.cells.emplace_back(3);
  mesh.cells[0].vertices = {0, 1, 2};
  EXPECT_NEAR(cell_quality(mesh).worst_jacobian, std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(cell_quality(mesh).largest_edge, 2., 1e-15);

  // A parallelepiped sheared by 45 degrees.
  Mesh<3> brick;
  brick.phases = {"all"};
  brick.cells.emplace_back(8);
  for (unsigned int v = 0; v < 8; ++v)
    {
      brick.cells[0].vertices[v] = v;
      brick.points.emplace_back(1. * (v & 1U) + (v >> 2U), 3. * ((v >> 1U) & 1U),
                                1. * (v >> 2U));
    }
  EXPECT_NEAR(cell_quality(brick).worst_jacobian, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(cell_quality(brick).volume[0], 3., 1e-14);
}

TEST(Mesh, PointsThatAreNotOppositeAreRefused)
{
  Mesh<2> mesh;
  mesh.points = {{0., 0.}, {0., .5}, {0., 1.}, {1., 0.}, {1., .5001}, {1.00001, 1.}};
  mesh.cells.assign(2, Cell(4));
  mesh.cells[0].vertices = {0, 3, 1, 4};
  mesh.cells[1].vertices = {1, 4, 2, 5};
  const auto sides       = faces_of_box(mesh, boundary_faces(mesh));
  const auto opposite    = [&]() {
    return opposite_points(mesh, sides[0], sides[1], 0, .5).largest_mismatch;
  };
  EXPECT_NEAR(opposite(), 1e-4, 1e-12);
  mesh.tolerance = 1e-5;
  EXPECT_THROW(opposite(), UserError);
  EXPECT_THROW(opposite_points(mesh, {sides[0][0]}, sides[1], 0, .5), UserError);
  EXPECT_THROW(faces_of_box(mesh, boundary_faces(mesh)), UserError);
}

TEST(Mesh, PartsMayBeInSeveralGroupsOfFaces)
{
  auto session = std::make_unique<GmshSession>();
  gmsh::model::occ::addRectangle(0, 0, 0, 1, 1);
  gmsh::model::occ::synchronize();
  name_group(2, {1}, "matrix");
  name_group(1, side(2, 1, 0.), "Contact");
  name_group(1, {1, 2, 3, 4}, "outer");
  gmsh::model::mesh::generate(2);
  for (const double version : {4.1, 2.2})
    {
      gmsh::option::setNumber("Mesh.MshFileVersion", version);
      gmsh::write(testing::TempDir() + std::to_string(version) + ".msh");
    }
  session.reset();
  for (const double version : {4.1, 2.2})
    {
      const Mesh<2> mesh =
        read_gmsh<2>(testing::TempDir() + std::to_string(version) + ".msh", 1.);
      const auto faces = boundary_faces(mesh);
      ASSERT_EQ(mesh.boundaries, (std::vector<std::string>{"Contact", "outer"}));
      EXPECT_EQ(faces_of_group(mesh, faces, 1).size(), faces.size());
      EXPECT_EQ(faces_of_group(mesh, faces, 0).size() * 4, faces.size());
    }
}

// Of five tetrahedra in a cube the diagonals of opposite sides cross, of six they do not.
TEST(Mesh, OppositeSidesHaveTheSameFaces)
{
  Mesh<3> mesh;
  mesh.phases = {"all"};
  for (unsigned int k = 0; k < 8; ++k)
    mesh.points.emplace_back(k & 1U, k >> 1U & 1U, k >> 2U);
  const auto check = [&mesh](const std::vector<std::vector<unsigned int>> &cells) {
    mesh.cells.clear();
    for (const auto &corners : cells)
      {
        mesh.cells.emplace_back(4);
        mesh.cells.back().vertices = corners;
      }
    const auto sides = faces_of_box(mesh, boundary_faces(mesh));
    for (unsigned int axis = 0; axis < 3; ++axis)
      opposite_points(mesh, sides[2 * axis], sides[2 * axis + 1], axis, 1.);
  };
  EXPECT_NO_THROW(check({{0, 1, 3, 7},
                         {0, 1, 7, 5},
                         {0, 5, 7, 4},
                         {0, 3, 2, 7},
                         {0, 2, 6, 7},
                         {0, 6, 4, 7}}));
  EXPECT_THROW(
    check({{0, 1, 2, 4}, {1, 3, 2, 7}, {1, 4, 5, 7}, {2, 4, 7, 6}, {1, 2, 4, 7}}),
    UserError);
}

TEST(Mesh, WrongCountsOfBinaryFilesAreRefused)
{
  for (const double version : {2.2, 4.1})
    for (const std::string section : {"$Nodes\n", "$Elements\n"})
      for (const int more : {-1, 1})
        {
          generate(2, "triangles", 0.5, version, true);
          std::stringstream text;
          text << std::ifstream(file, std::ios::binary).rdbuf();
          std::string edited = text.str();
          std::size_t at     = edited.find(section) + section.size();
          if (version > 4.)
            edited[at + 8] = static_cast<char>(edited[at + 8] + more); // of 64 bits
          else
            {
              const std::size_t length = edited.find('\n', at) - at;
              edited.replace(at, length,
                             std::to_string(std::stol(edited.substr(at, length)) + more));
            }
          std::ofstream(file, std::ios::binary) << edited;
          EXPECT_NE(reading_error().find(section.substr(0, section.size() - 1) + " "),
                    std::string::npos)
            << version << ' ' << section << ' ' << more << ": " << reading_error();
        }
}

// Gmsh's library wrote beyond its memory, or left cells out.
TEST(Mesh, WrongCountsAreRefused)
{
  for (const double version : {2.2, 4.1})
    for (const std::string section : {"Nodes", "Elements"})
      for (const long more : {-1, 1, 1000000000})
        {
          generate(2, "triangles", 0.5, version, false);
          std::stringstream text;
          text << std::ifstream(file).rdbuf();
          std::string edited  = text.str();
          const std::size_t n = section.size() + 3;
          std::size_t at      = edited.find("\n$" + section + "\n") + n;
          if (version > 4.)
            at = edited.find(' ', at) + 1; // behind the number of blocks
          const std::size_t length  = edited.find_first_of(" \n", at) - at;
          const std::string counted = edited.substr(at, length);
          edited.replace(at, length, std::to_string(std::stol(counted) + more));
          std::ofstream(file) << edited;
          EXPECT_NE(reading_error().find("and has " + counted + ";"), std::string::npos)
            << version << ' ' << section << ' ' << more << ": " << reading_error();
        }
}
