// Meshes that are written line by line: what is wrong with them, groups, seams.

#include "mesh/boundary.h"
#include "mesh/boundary/open_seams.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"
#include "mesh/read_gmsh.h"
#include "mesh_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

using namespace mesoslip;
using namespace mesh_files;

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
