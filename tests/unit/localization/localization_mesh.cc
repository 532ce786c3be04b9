// Strains and cells of meshes, as localization uses them.
#include "exchange/mesh_datasets.h"
#include "localization/strain/cell_set.h"
#include "localization/strain/cell_strain.h"
#include "localization/strain/grid_strain.h"
#include "mesh/cell_locator.h"
#include "mesh/cell_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

using namespace mesoslip;

namespace
{
/** The unit box in n^dim cubes, or these in simplices (one for each order of the axes); points inside are moved by up to
 * @p distortion of a cell. */
template <int dim>
Mesh<dim> box(const unsigned int n, const bool simplices, const double distortion = 0.)
{
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> move(-distortion / n, distortion / n);
  const auto number = [n](const std::array<unsigned int, dim> &at) {
    unsigned int result = 0;
    for (unsigned int d = dim; d-- > 0;)
      result = result * (n + 1) + at[d];
    return result;
  };
  const auto place = [](unsigned int k, const unsigned int width) {
    std::array<unsigned int, dim> at;
    for (unsigned int d = 0; d < dim; ++d, k /= width)
      at[d] = k % width;
    return at;
  };
  Mesh<dim> mesh;
  for (unsigned int k = 0; k < std::pow(n + 1, dim); ++k)
    {
      auto &point = mesh.points.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int at = place(k, n + 1)[d];
          point[d] = static_cast<double>(at) / n + (at % n == 0 ? 0. : move(generator));
        }
    }
  for (unsigned int k = 0; k < std::pow(n, dim); ++k)
    {
      std::array<unsigned int, dim> axes;
      for (unsigned int d = 0; d < dim; ++d)
        axes[d] = d;
      do
        {
          auto corner = place(k, n);
          auto &vertices =
            mesh.cells.emplace_back(simplices ? dim + 1 : 1U << dim).vertices;
          if (simplices)
            {
              vertices[0] = number(corner);
              for (unsigned int d = 0; d < dim; ++d)
                {
                  ++corner[axes[d]];
                  vertices[d + 1] = number(corner);
                }
              if (cell_measure(mesh, vertices).volume < 0.)
                std::swap(vertices[0], vertices[1]);
              continue;
            }
          for (unsigned int v = 0; v < vertices.size(); ++v)
            {
              auto at = corner;
              for (unsigned int d = 0; d < dim; ++d)
                at[d] += v >> d & 1;
              vertices[v] = number(at);
            }
        }
      while (simplices && std::next_permutation(axes.begin(), axes.end()));
    }
  return mesh;
}

template <int dim>
dealii::Point<dim> random_point(std::mt19937 &generator)
{
  dealii::Point<dim> point;
  for (unsigned int d = 0; d < dim; ++d)
    point[d] = std::uniform_real_distribution<double>(0., 1.)(generator);
  return point;
}

/** u_0 = f(x), the other components zero. */
template <int dim, typename Function>
std::vector<double> displacement(const Mesh<dim> &mesh, const Function &f)
{
  std::vector<double> u(mesh.points.size() * dim, 0.);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    u[k * dim] = f(mesh.points[k]);
  return u;
}

/** Largest error of du_0/dx_(dim - 1), the engineering shear, at some places. */
template <int dim, typename Function, typename Derivative>
double shear_error(const Mesh<dim> &mesh, const Function &f, const Derivative &derivative)
{
  std::vector<unsigned int> all;
  for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
    all.push_back(cell);
  CellStrain<dim> strain(mesh, all);
  strain.set_displacement(displacement(mesh, f));
  const CellLocator<dim> locator(mesh);
  std::mt19937 generator(1);
  double error = 0.;
  for (unsigned int k = 0; k < 200; ++k)
    {
      const auto point = random_point<dim>(generator);
      const double at =
        strain.at(*locator.find(point), point)(voigt_index<dim>(0, dim - 1));
      error = std::max(error, std::fabs(at - derivative(point)));
    }
  return error;
}

template <int dim>
void check_linear()
{
  for (const bool simplices : {false, true})
    EXPECT_LT(shear_error<dim>(
                box<dim>(4, simplices, 0.2),
                [](const auto &x) { return 3. * x[dim - 1] - 2. * x[0]; },
                [](const auto &) { return 3.; }),
              1e-12);
}

/** Errors of a smooth field on meshes of n and 2 n cells along an axis, order from both. */
template <int dim>
double order(const unsigned int n, const bool simplices, const double distortion)
{
  const auto f = [](const auto &x) { return std::sin(2. * x[0] + 3. * x[dim - 1]); };
  const auto derivative = [](const auto &x) {
    return 3. * std::cos(2. * x[0] + 3. * x[dim - 1]);
  };
  return std::log2(
    shear_error<dim>(box<dim>(n, simplices, distortion), f, derivative) /
    shear_error<dim>(box<dim>(2 * n, simplices, distortion), f, derivative));
}

/** Somewhere in the grid, now and then on a face: outside CellLocator takes any cell near by. */
template <int dim>
dealii::Point<dim> random_place(const UniformGrid<dim> &grid, std::mt19937 &generator)
{
  dealii::Point<dim> place;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double n = grid.cells[d];
      double x       = std::uniform_real_distribution<double>(0., n)(generator);
      if (generator() % 4 == 0)
        x = std::round(x);
      place[d] = grid.origin[d] + x * grid.spacing[d];
    }
  return place;
}

/** The displacement of the nodes of @p block, from that of all nodes. */
template <int dim>
std::vector<double> part_of(const std::vector<double> &u,
                            const UniformGrid<dim> &grid,
                            const CellBlock<dim> &block)
{
  std::vector<double> part;
  for (unsigned int k = 0; k < grid.n_nodes(); ++k)
    {
      bool inside       = true;
      unsigned int rest = k;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int at = rest % (grid.cells[d] + 1);
          inside =
            inside && at >= block.first[d] && at <= block.first[d] + block.cells[d];
          rest /= grid.cells[d] + 1;
        }
      if (inside)
        part.insert(part.end(), &u[k * dim], &u[k * dim] + dim);
    }
  return part;
}

/** Strains at places in a grid as CellLocator and CellStrain find them in a mesh of its cells. */
template <int dim>
void check_grid(const std::array<unsigned int, dim> &cells, const unsigned int seed)
{
  std::mt19937 generator(seed);
  UniformGrid<dim> grid = {cells, {}, {}};
  for (unsigned int d = 0; d < dim; ++d)
    {
      grid.spacing[d] = 0.5 + 0.25 * d;
      grid.origin[d]  = -1. + d;
    }
  const Mesh<dim> mesh = mesh_of_cells(grid);
  std::vector<double> u(mesh.points.size() * dim);
  for (double &value : u)
    value = std::uniform_real_distribution<double>(-1., 1.)(generator);
  std::vector<unsigned int> all(mesh.cells.size());
  std::iota(all.begin(), all.end(), 0U);
  CellStrain<dim> expected(mesh, all);
  expected.set_displacement(u);
  const CellLocator<dim> locator(mesh);
  for (unsigned int k = 0; k < 25; ++k)
    {
      const auto place  = random_place(grid, generator);
      const auto cell   = cell_at(grid, place);
      const auto number = locator.find(place);
      ASSERT_TRUE(cell && number) << place << " seed " << seed;
      ASSERT_EQ((CellBlock<dim>{{}, grid.cells}.number_of(*cell)), *number)
        << place << " seed " << seed;
      GridStrain<dim> strain(grid, block_around<dim>(grid, *cell, *cell, 2));
      strain.set_displacement(part_of(u, grid, strain.block()));
      const VoigtVector<dim> found = strain.at(strain.block().number_of(*cell), place);
      ASSERT_LT((found - expected.at(*number, place)).norm(), 1e-12)
        << place << " seed " << seed;
    }
  auto outside = middle_of<dim>(grid, std::array<unsigned int, dim>());
  outside[0]   = grid.origin[0] - dim * grid.spacing[dim - 1];
  EXPECT_FALSE(cell_at(grid, outside));
  EXPECT_FALSE(locator.find(outside));
}
} // namespace

TEST(CellMeasures, VolumesAndCentroids)
{
  const Mesh<3> tetrahedra = box<3>(2, true, 0.2), cubes = box<3>(2, false, 0.2);
  for (const Mesh<3> *mesh : {&tetrahedra, &cubes})
    {
      double volume = 0.;
      dealii::Point<3> moment;
      for (const auto &cell : mesh->cells)
        {
          const auto measure = cell_measure(*mesh, cell.vertices);
          volume += measure.volume;
          moment += measure.volume * dealii::Tensor<1, 3>(measure.centroid);
        }
      EXPECT_NEAR(volume, 1., 1e-14);
      EXPECT_LT(moment.distance(dealii::Point<3>(.5, .5, .5)), 1e-14);
    }
  const auto &corners = tetrahedra.cells[5].vertices;
  dealii::Point<3> mean;
  for (const unsigned int v : corners)
    mean += dealii::Tensor<1, 3>(tetrahedra.points[v]) / 4.;
  EXPECT_LT(cell_measure(tetrahedra, corners).centroid.distance(mean), 1e-15);
}

TEST(CellLocators, FindTheCellThatHoldsAPoint)
{
  const Mesh<3> mesh = box<3>(3, true, 0.2);
  const CellLocator<3> locator(mesh);
  std::mt19937 generator(2);
  for (unsigned int k = 0; k < 300; ++k)
    {
      const auto point = random_point<3>(generator);
      const auto &v    = mesh.cells[*locator.find(point)].vertices;
      // Barycentric coordinates from the volumes of the parts.
      dealii::Tensor<2, 3> edges;
      for (unsigned int e = 0; e < 3; ++e)
        for (unsigned int d = 0; d < 3; ++d)
          edges[d][e] = (mesh.points[v[e + 1]] - mesh.points[v[0]])[d];
      const auto share = invert(edges) * (point - mesh.points[v[0]]);
      EXPECT_GE(
        std::min({share[0], share[1], share[2], 1. - share[0] - share[1] - share[2]}),
        -1e-12);
    }
  const Mesh<2> squares = box<2>(4, false);
  const CellLocator<2> of_squares(squares);
  EXPECT_EQ(of_squares.find({0.25, 0.1}), 1u); // of two neighbours the upper one
  EXPECT_EQ(of_squares.find({0.5, 0.5}), 10u);
  EXPECT_EQ(of_squares.find({1., 1.}), 15u);
  EXPECT_EQ(of_squares.find({1.05, 0.9}), 15u); // a boundary that another mesh rounds off
  EXPECT_FALSE(of_squares.find({1.2, 0.9}));
}

TEST(CellStrains, LinearDisplacementsAreExactOnAnyMesh)
{
  check_linear<2>();
  check_linear<3>();
}

TEST(CellStrains, LinearStrainsAreExactOnEqualCells)
{
  const auto f          = [](const auto &x) { return x[0] * x[1] + 2. * x[1] * x[1]; };
  const auto derivative = [](const auto &x) { return x[0] + 4. * x[1]; };
  EXPECT_LT(shear_error<2>(box<2>(3, false), f, derivative), 1e-12);
  EXPECT_LT(shear_error<3>(
              box<3>(2, false),
              [](const auto &x) { return x[0] * x[2] + 2. * x[2] * x[2]; },
              [](const auto &x) { return x[0] + 4. * x[2]; }),
            1e-12);
}

TEST(CellStrains, OrderTwoOnQuadrilateralsAndOneOnSimplices)
{
  EXPECT_GT(order<2>(16, false, 0.), 1.8);
  EXPECT_GT(order<3>(8, false, 0.), 1.6);
  EXPECT_GT(order<2>(16, true, 0.), 0.8);
  EXPECT_GT(order<3>(6, true, 0.), 0.7);
}

TEST(GridStrains, AreThoseOfAMeshOfTheSameCells)
{
  for (unsigned int seed = 1; seed < 4; ++seed)
    {
      check_grid<3>({{7, 6, 8}}, seed);
      check_grid<3>({{5, 4, 3}}, seed);
      check_grid<3>({{6, 1, 2}}, seed); // one layer: slopes also from second neighbours
      check_grid<3>({{1, 1, 1}}, seed);
      check_grid<2>({{9, 4}}, seed);
      check_grid<2>({{1, 7}}, seed);
    }
}

TEST(CellStrains, MeanOverTheBodyIsThatOfItsBoundary)
{
  for (const bool simplices : {false, true})
    {
      const Mesh<3> mesh = box<3>(3, simplices, 0.2);
      // Mean of du_0/dx_2 over the unit box: difference of the means over two faces.
      const auto u = displacement(
        mesh, [](const auto &x) { return x[2] * (3. + x[0] * (1. - x[2])); });
      // In two parts.
      const MeanStrain<3> mean(mesh);
      const std::size_t n = mesh.points.size(), half = n / 3;
      const auto middle    = u.begin() + static_cast<std::ptrdiff_t>(3 * half);
      VoigtVector<3> found = VoigtVector<3>::Zero();
      mean.part(0, half).add({u.begin(), middle}, found);
      mean.part(half, n - half).add({middle, u.end()}, found);
      EXPECT_NEAR(found(voigt_index<3>(0, 2)), 3., 1e-12);
    }
}
