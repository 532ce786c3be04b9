#include "base/errors.h"
#include "mesh/boundary.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"
#include "mesh/read_gmsh.h"

#include <gtest/gtest.h>

#include <gmsh.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

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
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
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
  gmsh::finalize();
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

/** A mesh in Gmsh's format 2.2, line by line: "x y z", "type group corner...". */
std::string refusal(const int dim,
                    const std::vector<std::string> &points,
                    const std::vector<std::string> &cells)
{
  std::ofstream out(file);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << points.size() << "\n";
  for (std::size_t k = 0; k < points.size(); ++k)
    out << k + 1 << ' ' << points[k] << '\n';
  out << "$EndNodes\n$Elements\n" << cells.size() << "\n";
  for (std::size_t k = 0; k < cells.size(); ++k)
    {
      int type = 0, group = 0, n = 0;
      std::sscanf(cells[k].c_str(), "%d %d%n", &type, &group, &n);
      out << k + 1 << ' ' << type << " 2 " << group << ' ' << group << cells[k].substr(n)
          << '\n';
    }
  out << "$EndElements\n";
  out.close();
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
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      EXPECT_NEAR(total(sides[2 * axis])[axis], -area, 1e-12);
      EXPECT_NEAR(total(sides[2 * axis + 1])[axis], area, 1e-12);
      const auto lower    = boundary_points(mesh, sides[2 * axis]).points,
                 upper    = boundary_points(mesh, sides[2 * axis + 1]).points;
      const auto opposite = opposite_points(mesh, lower, upper, axis, 0.1);
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

TEST(Mesh, RefusalsSayWhatToDo)
{
  const auto contains = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << "'" << text << "' has no '" << part << "'";
  };
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
  EXPECT_TRUE(contains(refusal(3, square, {"3 1 1 2 3 4"}), "0 cells of dimension 3"));
  EXPECT_TRUE(
    contains(refusal(2, square, {"2 1 1 2 3", "4 2 1 2 3 4"}), "others of dimension 3"));
  EXPECT_TRUE(contains(refusal(3, {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1"},
                               {"6 1 1 2 3 4 5 6"}),
                       "cells of the kind 'Prism 6'"));
  EXPECT_TRUE(contains(refusal(2, {"0 0 0", "1 0 0", "2 1 0", "0 1 0"}, {"3 1 1 2 3 4"}),
                       "no side of the bounding box"));
  EXPECT_THROW(read_gmsh<2>(testing::TempDir() + "no_such_file.msh", 1.), UserError);
  EXPECT_THROW(read_gmsh<2>("mesh.vtu", 1.), UserError);
  std::ofstream(file) << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n7";
  EXPECT_THROW(read_gmsh<2>(file, 1.), UserError);
}

TEST(Mesh, PointsThatAreNotOppositeAreRefused)
{
  Mesh<2> mesh;
  mesh.points = {{0., 0.}, {0., .5}, {0., 1.}, {1., 0.}, {1., .500001}, {1., 1.}};
  EXPECT_NEAR(opposite_points(mesh, {0, 1, 2}, {3, 4, 5}, 0, 2.).largest_mismatch, 1e-6,
              1e-12);
  EXPECT_THROW(opposite_points(mesh, {0, 1, 2}, {3, 4, 5}, 0, .5), UserError);
  EXPECT_THROW(opposite_points(mesh, {0, 2}, {3, 4, 5}, 0, .5), UserError);
}
