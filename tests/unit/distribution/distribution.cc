// A mesh divided among ranks: who has what, sums at points of several ranks. Runs on any
// number of ranks.

#include "base/exchange.h"
#include "distribution_testing.h"
#include "mesh/point_blocks.h"
#include "mesh/shared_points.h"

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <gtest/gtest.h>

#include <set>

using namespace distribution_testing;

namespace
{
template <int dim>
void expect_whole_mesh()
{
  const Mesh<dim> mesh     = cube<dim>();
  const MeshPart<dim> part = part_of(mesh);
  for (std::size_t i = 0; i < part.points.size(); ++i)
    ASSERT_EQ(part.points[i], mesh.points[part.point_in_mesh[i]]);
  for (std::size_t k = 0; k < part.cells.size(); ++k)
    {
      const auto &cell = mesh.cells[part.cell_in_mesh[k]];
      ASSERT_EQ(part.cells[k].material_id, cell.material_id);
      for (std::size_t v = 0; v < cell.vertices.size(); ++v)
        ASSERT_EQ(part.point_in_mesh[part.cells[k].vertices[v]], cell.vertices[v]);
    }

  // Each cell once, each point owned once, by the lowest rank that has it.
  std::vector<unsigned int> owned(part.point_in_mesh.begin(),
                                  part.point_in_mesh.begin() + part.n_owned);
  const auto cells =
    dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, part.cell_in_mesh);
  const auto points =
    dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, part.point_in_mesh);
  const auto owners = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, owned);
  std::set<unsigned int> seen_cells, seen_points;
  for (std::size_t rank = 0; rank < cells.size(); ++rank)
    {
      for (const unsigned int k : cells[rank])
        ASSERT_TRUE(seen_cells.insert(k).second);
      std::set<unsigned int> first;
      for (const unsigned int p : points[rank])
        if (seen_points.insert(p).second)
          first.insert(p);
      EXPECT_EQ(first, std::set<unsigned int>(owners[rank].begin(), owners[rank].end()));
      const double share = double(cells[rank].size()) * cells.size() / mesh.cells.size();
      EXPECT_NEAR(share, 1., 0.05) << "of the cells, on rank " << rank;
    }
  EXPECT_EQ(seen_cells.size(), mesh.cells.size());
  EXPECT_EQ(seen_points.size(), mesh.points.size());
}

template <int dim>
void expect_sums()
{
  const Mesh<dim> mesh          = cube<dim>();
  const MeshPart<dim> part      = part_of(mesh);
  constexpr unsigned int stride = dim + 1;
  const auto term               = [](const std::size_t rank, const unsigned int p,
                       const unsigned int c) {
    return 1. / (1. + p + 7. * rank + 0.1 * c);
  };
  const unsigned int rank = mpi::this_mpi_process(MPI_COMM_WORLD);
  std::vector<double> field(part.points.size() * stride, 3.);
  for (std::size_t i = 0; i < part.points.size(); ++i)
    for (unsigned int c = 0; c < dim; ++c)
      field[i * stride + c] = term(rank, part.point_in_mesh[i], c);
  SharedPoints<dim> shared(part, stride, MPI_COMM_WORLD);
  shared.start(field.data());
  shared.finish(field.data());

  // In the order of the ranks, bit for bit.
  std::vector<double> expected(mesh.points.size() * dim, 0.);
  const auto points =
    dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, part.point_in_mesh);
  for (std::size_t r = 0; r < points.size(); ++r)
    for (const unsigned int p : points[r])
      for (unsigned int c = 0; c < dim; ++c)
        expected[p * dim + c] += term(r, p, c);
  for (std::size_t i = 0; i < part.points.size(); ++i)
    {
      for (unsigned int c = 0; c < dim; ++c)
        ASSERT_EQ(field[i * stride + c], expected[part.point_in_mesh[i] * dim + c]);
      ASSERT_EQ(field[i * stride + dim], 3.);
    }
}

/** Cells of a whole mesh on the ranks, by way of deal.II's triangulation. */
template <int dim>
std::vector<unsigned int> parts_of_triangulation(const Mesh<dim> &mesh,
                                                 const unsigned int n)
{
  using namespace dealii;
  Triangulation<dim> tria;
  tria.create_triangulation(mesh.points, to_dealii<dim>(mesh.cells), SubCellData());
  DynamicSparsityPattern connections;
  GridTools::get_face_connectivity_of_cells(tria, connections);
  SparsityPattern graph;
  graph.copy_from(connections);
  std::vector<unsigned int> ranks(mesh.cells.size());
  SparsityTools::partition(graph, {}, n, ranks, SparsityTools::Partitioner::metis);
  return ranks;
}

} // namespace

TEST(Distribution, GivesAwayEverythingOnce)
{
  expect_whole_mesh<2>();
  expect_whole_mesh<3>();
}

// Every rank reads a block, and needs some things of all blocks.
TEST(Distribution, BringsWhatWasReadInBlocks)
{
  const unsigned int rank = mpi::this_mpi_process(MPI_COMM_WORLD);
  const std::size_t n_all = 3 * 19;
  std::vector<unsigned int> needed;
  for (unsigned int k = 0; k < n_all; ++k)
    if ((k * 5 + rank) % 3 != 0)
      needed.push_back(k);
  const NumbersFromBlocks numbers(needed, n_all, MPI_COMM_WORLD);
  EXPECT_EQ(mpi::sum(numbers.size(), MPI_COMM_WORLD), n_all);
  std::vector<double> block;
  for (std::size_t k = numbers.first(); k < numbers.first() + numbers.size(); ++k)
    block.insert(block.end(), {10. * k, 10. * k + 1.});
  const std::vector<double> found = numbers.bring(block, 2);
  ASSERT_EQ(found.size(), 2 * needed.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(found[i], 10. * needed[i / 2] + i % 2);
}

// A sum of numbers in their order, whatever the ranks, bit for bit.
TEST(Distribution, SumsInTheOrderOfTheRanks)
{
  const std::size_t n_all = 1000;
  const auto term         = [](const std::size_t k) { return std::sqrt(1. + k) / 3.; };
  double expected = 0., found = 0.;
  for (std::size_t k = 0; k < n_all; ++k)
    expected += term(k);
  const auto [begin, end] = block_of_rank(n_all, MPI_COMM_WORLD);
  in_order_of_ranks(
    &found, 1,
    [&found, &term, first = begin, last = end]() {
      for (std::size_t k = first; k < last; ++k)
        found += term(k);
    },
    MPI_COMM_WORLD);
  EXPECT_EQ(found, expected);
}

TEST(Distribution, SumsAreTheSameBitsOnAllRanks)
{
  expect_sums<2>();
  expect_sums<3>();
}

// Hilbert's curve goes from each cell to one beside it.
TEST(Distribution, CellsFollowTheCurve)
{
  const auto expect_steps = [](const auto &mesh) {
    const std::vector<unsigned int> one_rank(mesh.cells.size(), 0);
    const auto part = distribute(mesh, one_rank, MPI_COMM_SELF);
    for (std::size_t k = 1; k < part.cells.size(); ++k)
      {
        const auto corner = [&](const std::size_t cell) {
          return part.points[part.cells[cell].vertices[0]];
        };
        ASSERT_NEAR(corner(k).distance(corner(k - 1)), 1., 1e-12);
      }
  };
  expect_steps(cube<2>());
  expect_steps(cube<3>());
}

TEST(Distribution, PartsAreThoseOfTheTriangulation)
{
  EXPECT_EQ(partition_cells(cube<2>(), 5), parts_of_triangulation(cube<2>(), 5));
  EXPECT_EQ(partition_cells(cube<3>(), 4), parts_of_triangulation(cube<3>(), 4));
}
