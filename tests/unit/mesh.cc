#include "base/errors.h"
#include "mesh/boundary.h"
#include "mesh/boundary/open_seams.h"
#include "mesh/cell_quality.h"
#include "mesh/gmsh/session.h"
#include "mesh/periodic_points.h"
#include "mesh/read_gmsh.h"

#include <gtest/gtest.h>

#include <gmsh.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>

using namespace mesoslip;

namespace
{
constexpr double radius = 0.3; // of the inclusion in the middle of a unit square or cube

const std::string file = testing::TempDir() + "mesoslip_mesh_test.msh";

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

/** Writes a mesh in Gmsh's format 2.2, line by line: "x y z", "type group corner...", names
 * "dimension group name"; all cells in one part of the geometry, as meshio writes them, or one for
 * each group. */
void write_mesh(const std::vector<std::string> &points,
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

testing::AssertionResult contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos
           ? testing::AssertionSuccess()
           : testing::AssertionFailure() << "'" << text << "' has no '" << part << "'";
}

/** What is wrong with a mesh of write_mesh(). */
std::string refusal(const int dim,
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
std::string reading_error()
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

const std::vector<std::string> square = {"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
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

TEST(Mesh, ClockwiseCellsAreTurned)
{
  EXPECT_EQ(refusal(2, square, {"3 1 1 4 3 2"}), "accepted");
  EXPECT_EQ(read_gmsh<2>(file, 1.).n_turned, 1u);
  EXPECT_EQ(refusal(2, square, {"2 1 1 3 2", "2 1 1 3 4"}), "accepted");
}

TEST(Mesh, RefusalsOfKindsOfCells)
{
  EXPECT_TRUE(contains(refusal(2, square, {"1 1 1 2"}), "mesh the surfaces (gmsh -2)"));
  // Of two kinds with as many cells, so that the number in groups tells nothing.
  EXPECT_TRUE(contains(
    refusal(2, {"0 0 0", "1 0 0", "1 1 0", "0 1 0", ".5 .5 0", "1 .5 0", ".5 0 0"},
            {"2 1 1 3 4", "9 1 1 2 3 7 6 5"}),
    "of another order"));
  const std::vector<std::string> cube = {"0 0 0", "1 0 0", "1 1 0", "0 1 0",  "0 0 1",
                                         "1 0 1", "1 1 1", "0 1 1", ".5 .5 2"};
  const std::string hexahedron = "5 1 1 2 3 4 5 6 7 8", tetrahedron = "4 1 5 6 7 9";
  EXPECT_TRUE(contains(refusal(3, cube, {hexahedron, tetrahedron}),
                       "hexahedra and tetrahedra, which share no faces"));
  EXPECT_TRUE(contains(refusal(3, cube, {hexahedron, "2 1 1 2 3"}),
                       "triangles as faces of hexahedra"));
  EXPECT_TRUE(contains(refusal(3, cube, {tetrahedron, "3 1 1 2 3 4"}),
                       "quadrilaterals as faces of tetrahedra"));
}

TEST(Mesh, RefusalsSayWhatToDo)
{
  EXPECT_TRUE(contains(refusal(2, square, {"3 1 1 2 4 3"}), "twisted"));
  EXPECT_TRUE(contains(
    refusal(2, {"0 0 0", "1 0 0", ".2 .2 0", "0 1 0"}, {"3 1 1 2 3 4"}), "concave"));
  EXPECT_TRUE(contains(refusal(2, square, {"2 1 1 2 3", "2 1 1 3 4", "2 2 1 2 3"}),
                       "overlap or are there twice"));
  EXPECT_TRUE(contains(refusal(2, {"0 0 0", "1 0 0", "0 1 0", "1 1 0", "2 1 0", "1 2 0"},
                               {"2 1 1 2 3", "2 1 4 5 6"}),
                       "in 2 pieces"));
  EXPECT_TRUE(contains(refusal(2, square, {"2 1 1 2 3", "2 0 1 3 4"}),
                       "1 of 2 cells belong to no physical group"));
  EXPECT_TRUE(contains(refusal(2, {"0 0 0", "1 0 0", "1 1 .1", "0 1 0"}, {"3 1 1 2 3 4"}),
                       "not in a plane"));
  EXPECT_TRUE(
    contains(refusal(2, {"0 0 0", "1 0 0", "1 nan 0", "0 1 0"}, {"3 1 1 2 3 4"}),
             "no finite number"));
  EXPECT_TRUE(contains(refusal(3, square, {"3 1 1 2 3 4"}),
                       "set Dimension = 2 if the body is plane"));
  EXPECT_TRUE(
    contains(refusal(2, square, {"2 1 1 2 3", "4 2 1 2 3 4"}), "set Dimension = 3"));
  EXPECT_TRUE(contains(refusal(3, {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1"},
                               {"6 1 1 2 3 4 5 6"}),
                       "cells of the kind 'Prism 6'"));
  EXPECT_TRUE(contains(refusal(2, {"0 0 0", "1 0 0", "2 1 0", "0 1 0"}, {"3 1 1 2 3 4"}),
                       "no side of the bounding box"));
  EXPECT_THROW(read_gmsh<2>(testing::TempDir() + "no_such_file.msh", 1.), UserError);
  EXPECT_THROW(read_gmsh<2>("mesh.vtu", 1.), UserError);
  std::ofstream(file) << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n7";
  EXPECT_THROW(read_gmsh<2>(file, 1.), UserError);
  std::ofstream(file) << "";
  try
    {
      read_gmsh<2>(file, 1.);
    }
  catch (const UserError &e)
    {
      EXPECT_TRUE(contains(e.what(), "is empty"));
    }
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

TEST(Mesh, GroupsOfOneNameAreOne)
{
  // Two edges below, in two groups; the one between the cells is inside.
  const std::vector<std::string> points = {"0 0 0", "1 0 0", "2 0 0",
                                           "2 1 0", "1 1 0", "0 1 0"};
  for (const bool one_part : {false, true})
    {
      write_mesh(
        points,
        {"1 3 1 2", "1 4 2 3", "1 5 2 3", "1 5 2 5", "3 1 1 2 5 6", "3 2 2 3 4 5"},
        {"1 3 \"Contact\"", "1 4 \"Contact\"", "1 5 \"outer\"", "2 1 \"matrix\"",
         "2 2 \"matrix\""},
        one_part);
      const Mesh<2> mesh = read_gmsh<2>(file, 1.);
      const auto faces   = boundary_faces(mesh);
      EXPECT_EQ(mesh.phases, std::vector<std::string>{"matrix"});
      ASSERT_EQ(mesh.boundaries, (std::vector<std::string>{"Contact", "outer"}));
      EXPECT_EQ(faces_of_group(mesh, faces, 0).size(), 2u);
      EXPECT_EQ(faces_of_group(mesh, faces, 1).size(), 1u);
      EXPECT_EQ(n_faces_in_file(mesh, 1), 2u);
    }
  // Equal numbers of the parts, as meshio writes them, are no two groups of a part.
  write_mesh(points, {"3 1 1 2 5 6", "3 2 2 3 4 5"}, {"2 1 \"matrix\"", "2 2 \"fibre\""},
             true);
  const Mesh<2> mesh = read_gmsh<2>(file, 1.);
  EXPECT_EQ(mesh.phases, (std::vector<std::string>{"matrix", "fibre"}));
  ASSERT_EQ(mesh.cells.size(), 2u);
  EXPECT_NE(mesh.cells[0].material_id, mesh.cells[1].material_id);
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

TEST(Mesh, OpenSeamsAreFound)
{
  // Four cells around a point; of the edge to (1, 0) points are doubled, then one hangs.
  const std::vector<std::string> points = {"0 0 0", "1 0 0", "2 0 0", "0 1 0", "1 1 0",
                                           "2 1 0", "0 2 0", "1 2 0", "2 2 0"};
  const auto open = [&](const std::string &more, const std::vector<std::string> &below) {
    auto all = points, cells = std::vector<std::string>{"3 1 4 5 8 7", "3 1 5 6 9 8"};
    all.push_back(more);
    cells.insert(cells.end(), below.begin(), below.end());
    write_mesh(all, cells);
    const Mesh<2> mesh = read_gmsh<2>(file, 1.);
    return open_seams(mesh, boundary_faces(mesh)).size();
  };
  EXPECT_EQ(open("9 9 0", {"3 1 1 2 5 4", "3 1 2 3 6 5"}), 0u);
  EXPECT_EQ(open("1.000001 0 0", {"3 1 1 2 5 4", "3 1 10 3 6 5"}), 2u);
  EXPECT_EQ(open("1.05 0 0", {"3 1 1 2 5 4", "3 1 10 3 6 5"}), 0u);
  EXPECT_EQ(open("1 .5 0", {"3 1 1 2 5 4", "2 1 2 3 10", "2 1 3 6 10", "2 1 6 5 10"}),
            1u);

  // Two layers of cubes; of the cube at (2, 1, 2) a point is doubled.
  Mesh<3> cube;
  cube.phases = {"all"};
  for (unsigned int k = 0; k < 12; ++k)
    cube.points.emplace_back(k % 2, k / 2 % 2, k / 4);
  cube.cells.assign(2, Cell(8));
  for (unsigned int v = 0; v < 8; ++v)
    {
      cube.cells[0].vertices[v] = v;
      cube.cells[1].vertices[v] = v + 4;
    }
  EXPECT_TRUE(open_seams(cube, boundary_faces(cube)).empty());
  for (const dealii::Point<3> &p :
       {dealii::Point<3>(2., 0., 0.), dealii::Point<3>(2., 1., 0.),
        dealii::Point<3>(2., 0., 1.), dealii::Point<3>(2., 1., 1.),
        dealii::Point<3>(2., 0., 2.), dealii::Point<3>(2., 1., 2.),
        dealii::Point<3>(1., 1., 2.)})
    cube.points.push_back(p);
  cube.cells.push_back(Cell(8));
  cube.cells.back().vertices = {1, 12, 3, 13, 5, 14, 7, 15};
  cube.cells.push_back(Cell(8));
  cube.cells.back().vertices = {5, 14, 7, 15, 9, 16, 18, 17};
  EXPECT_EQ(open_seams(cube, boundary_faces(cube)), (std::vector<unsigned int>{11, 18}));
}

TEST(Mesh, FoldedCellsAreRefused)
{
  const std::vector<std::string> fan = {"2 1 1 2 5", "2 1 2 3 5", "2 1 3 4 5",
                                        "2 1 4 1 5"};
  auto points                        = square;
  points.push_back(".5 .5 0");
  EXPECT_EQ(refusal(2, points, fan), "accepted");
  points.back() = ".5 1.2 0";
  EXPECT_NE(refusal(2, points, fan).find("same side"), std::string::npos);
  EXPECT_NE(refusal(2, square, {"3 1 1 2 3 4", "3 1 1 2 3 4"}).find("same side"),
            std::string::npos);
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

TEST(Mesh, NumbersOfPointsFit)
{
  for (const std::string number : {"4294967297", "-1", "99999999999999999999"})
    {
      write_mesh(square, {"3 1 1 2 3 " + number});
      EXPECT_NE(reading_error().find("has a point with the number"), std::string::npos);
    }
}

TEST(Mesh, FacesThatAreNotFoundHaveAReason)
{
  const auto reason = [](const std::vector<std::string> &points,
                         const std::vector<std::string> &cells) {
    write_mesh(points, cells);
    const Mesh<2> mesh = read_gmsh<2>(file, 1.);
    return why_not_found(mesh, faces_of_group(mesh, boundary_faces(mesh), 0), 0);
  };
  EXPECT_EQ(reason(square, {"1 7 1 2", "1 7 2 1", "3 1 1 2 3 4"}),
            "are listed twice; leave each there once");
  EXPECT_EQ(reason(square, {"1 7 1 3", "2 1 1 2 3", "2 1 1 3 4"}),
            "are not on the boundary of the body; take them out of it");
  // Of a crack from the second point on the last cell has a point of its own.
  EXPECT_NE(reason({"0 0 0", "1 0 0", "1 1 0", "0 1 0", "1 0 0", "2 1 0", ".5 2 0"},
                   {"1 7 1 5", "3 1 1 2 3 4", "2 1 4 3 7", "2 1 3 6 7", "2 1 5 6 3"})
              .find("there twice, at (1, 0) m"),
            std::string::npos);
}

// deal.II multiplies coordinates as they are: far away triangles seemed to run the other way round.
TEST(Mesh, CellsFarFromTheOrigin)
{
  const auto shifted = [](const std::string &by) {
    write_mesh({by + "0 " + by + "0 0", by + "1 " + by + "0 0", by + "1 " + by + "1 0",
                by + "0 " + by + "1 0"},
               {"3 1 1 2 3 4"});
    return cell_quality(read_gmsh<2>(file, 1.)).volume[0];
  };
  EXPECT_NEAR(shifted("10000000"), 1., 1e-15);
  EXPECT_EQ(read_gmsh<2>(file, 1.).n_turned, 0U);
  try
    {
      shifted("1000000000");
      ADD_FAILURE() << "1e10 edges away from the origin";
    }
  catch (const UserError &error)
    {
      EXPECT_NE(std::string(error.what()).find("from the origin"), std::string::npos);
    }
}
