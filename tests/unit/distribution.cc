// A mesh divided among ranks: who has what, sums at points of several ranks, fields that
// all ranks write to one file. Runs on any number of ranks.

#include "base/errors.h"
#include "base/exchange.h"
#include "io/parallel_rows.h"
#include "mesh/mesh_part.h"
#include "mesh/point_blocks.h"
#include "mesh/shared_points.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <set>
#include <unistd.h>

using namespace mesoslip;

namespace
{
namespace mpi = dealii::Utilities::MPI;

constexpr unsigned int n_edge = 16; // cells along an edge of the cube

/** A cube of 16^dim cells of size 1. */
template <int dim>
Mesh<dim> cube()
{
  dealii::Triangulation<dim> tria;
  dealii::GridGenerator::subdivided_hyper_cube(tria, n_edge, 0., n_edge);
  Mesh<dim> mesh;
  dealii::SubCellData faces;
  std::tie(mesh.points, mesh.cells, faces) =
    dealii::GridTools::get_coarse_mesh_description(tria);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    mesh.cells[k].material_id = k % 5;
  return mesh;
}

template <int dim>
MeshPart<dim> part_of(const Mesh<dim> &mesh)
{
  const bool is_root = mpi::this_mpi_process(MPI_COMM_WORLD) == 0;
  const auto ranks = is_root ? partition_cells(mesh, mpi::n_mpi_processes(MPI_COMM_WORLD))
                             : std::vector<unsigned int>();
  return distribute(is_root ? mesh : Mesh<dim>(), ranks, MPI_COMM_WORLD);
}

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
  const auto cells  = mpi::all_gather(MPI_COMM_WORLD, part.cell_in_mesh);
  const auto points = mpi::all_gather(MPI_COMM_WORLD, part.point_in_mesh);
  const auto owners = mpi::all_gather(MPI_COMM_WORLD, owned);
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
  const auto points = mpi::all_gather(MPI_COMM_WORLD, part.point_in_mesh);
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
  tria.create_triangulation(mesh.points, mesh.cells, SubCellData());
  DynamicSparsityPattern connections;
  GridTools::get_face_connectivity_of_cells(tria, connections);
  SparsityPattern graph;
  graph.copy_from(connections);
  std::vector<unsigned int> ranks(mesh.cells.size());
  SparsityTools::partition(graph, {}, n, ranks, SparsityTools::Partitioner::metis);
  return ranks;
}

/** What a field is at a point of the whole mesh. */
double value_at(const std::size_t point, const unsigned int c)
{
  return std::sqrt(3. * point + c);
}

/** A name that no other test has. */
std::string file_of_all_ranks()
{
  return (std::filesystem::temp_directory_path() /
          ("mesoslip_rows_" + mpi::broadcast(MPI_COMM_WORLD, std::to_string(getpid())) +
           ".h5"))
    .string();
}

/** All ranks write a field at the points of their parts, twice, into one file. */
template <int dim>
void expect_one_file()
{
  const std::size_t rank     = mpi::this_mpi_process(MPI_COMM_WORLD),
                    n        = mpi::n_mpi_processes(MPI_COMM_WORLD);
  const std::string path     = file_of_all_ranks();
  const Mesh<dim> mesh       = cube<dim>();
  const MeshPart<dim> part   = part_of(mesh);
  const std::size_t n_points = mesh.points.size();
  const PointBlocks<dim> blocks(part, n_points, MPI_COMM_WORLD);
  EXPECT_LE(blocks.size(), n_points / n + 1) << "points that rank " << rank << " writes";

  on_root(MPI_COMM_WORLD, [&]() {
    Hdf5File file = Hdf5File::create(path);
    file.write_header("mesoslip-dynamics-mesh", 1, dim, "abc");
    file.reserve_rows("/snapshots/displacement", {2, n_points, dim});
    file.leave();
  });
  std::array<std::vector<double>, dim> field;
  std::array<const double *, dim> owned;
  for (unsigned int c = 0; c < dim; ++c)
    {
      for (std::size_t i = 0; i < part.n_owned; ++i)
        field[c].push_back(value_at(part.point_in_mesh[i], c));
      owned[c] = field[c].data();
    }
  {
    ParallelRows rows(path, "/snapshots/displacement", MPI_COMM_WORLD);
    rows.write(1, blocks.first(), blocks.gather(owned));
    for (std::vector<double> &component : field)
      for (double &x : component)
        x = -x;
    rows.write(0, blocks.first(), blocks.gather(owned));
    rows.sync();
    // One number on one rank stops all.
    if (rank == n - 1)
      field[0].back() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(rows.write(0, blocks.first(), blocks.gather(owned)), NumericalFailure);
  }
  on_root(MPI_COMM_WORLD, [&]() {
    Hdf5File::resume(path).close();
    const Hdf5File file = Hdf5File::open(path);
    EXPECT_EQ(file.change_note("contact_dynamics"), "");
    const auto found = file.read<double>("/snapshots/displacement", {2, n_points, dim});
    for (std::size_t p = 0; p < n_points; ++p)
      for (unsigned int c = 0; c < dim; ++c)
        {
          ASSERT_EQ(found[p * dim + c], -value_at(p, c));
          ASSERT_EQ(found[(n_points + p) * dim + c], value_at(p, c));
        }
    std::filesystem::remove(path);
  });
}
} // namespace

// Tensors of things in any order: each rank writes a block of rows, some of them none.
TEST(Distribution, RowsOfNumberedThings)
{
  const std::string path  = file_of_all_ranks();
  const unsigned int n    = mpi::n_mpi_processes(MPI_COMM_WORLD),
                     rank = mpi::this_mpi_process(MPI_COMM_WORLD);
  for (const std::size_t n_all : {std::size_t{1}, std::size_t{57}})
    {
      std::vector<std::uint64_t> own;
      std::vector<double> values;
      for (std::uint64_t k = n_all; k-- > 0;)
        if (k * 7 % 5 % n == rank)
          {
            own.push_back(k);
            values.push_back(10. * k);
          }
      const NumberedBlocks blocks(own, n_all, MPI_COMM_WORLD);
      std::vector<double> block, rows_of_block;
      blocks.gather(values.data(), block);
      ASSERT_EQ(block.size(), blocks.size());
      for (const double x : block)
        rows_of_block.insert(rows_of_block.end(), {x, x + 1., x + 2.});
      on_root(MPI_COMM_WORLD, [&]() {
        Hdf5File file = Hdf5File::create(path);
        file.reserve_rows("/rows", {n_all, 3}, 16);
        file.leave();
      });
      {
        ParallelRows rows(path, "/rows", MPI_COMM_WORLD);
        rows.write_rows(blocks.first(), rows_of_block);
        EXPECT_ANY_THROW(rows.write_rows(n_all, {1., 2., 3.}));
      }
      on_root(MPI_COMM_WORLD, [&]() {
        Hdf5File::resume(path).close();
        const auto found = Hdf5File::open(path).read<double>("/rows", {n_all, 3});
        for (std::size_t k = 0; k < found.size(); ++k)
          ASSERT_EQ(found[k], 10. * (k / 3) + k % 3);
        std::filesystem::remove(path);
      });
    }
}

TEST(Distribution, GivesAwayEverythingOnce)
{
  expect_whole_mesh<2>();
  expect_whole_mesh<3>();
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

TEST(Distribution, AllRanksWriteOneFile)
{
  expect_one_file<2>();
  expect_one_file<3>();
}
