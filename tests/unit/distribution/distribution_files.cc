// What all ranks write to one file and read from it. Runs on any number of ranks.

#include "base/errors.h"
#include "base/exchange.h"
#include "distribution_testing.h"
#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <unistd.h>

using namespace distribution_testing;

namespace
{
/** What a field is at a point of the whole mesh. */
double value_at(const std::size_t point, const unsigned int c)
{
  return std::sqrt(3. * point + c);
}

/** A name that no other test has. */
std::string file_of_all_ranks()
{
  return (std::filesystem::temp_directory_path() /
          ("mesoslip_rows_" +
           dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, std::to_string(getpid())) +
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

TEST(Distribution, AllRanksWriteOneFile)
{
  expect_one_file<2>();
  expect_one_file<3>();
}

// Each rank reads another block, the last one none; what is wrong with the block of one rank all
// ranks tell.
TEST(Distribution, AllRanksReadOneFile)
{
  const std::string path  = file_of_all_ranks();
  const unsigned int n    = mpi::n_mpi_processes(MPI_COMM_WORLD),
                     r    = mpi::this_mpi_process(MPI_COMM_WORLD);
  const std::size_t n_all = 57, n_of_rank = n_all / n;
  on_root(MPI_COMM_WORLD, [&]() {
    std::vector<double> values(n_all * 3);
    std::iota(values.begin(), values.end(), 0.);
    Hdf5File file = Hdf5File::create(path);
    file.reserve_rows("/in pieces", {n_all, 3}, 16);
    file.write_row("/in pieces", 0, values);
    file.write("/as one", {n_all, 3}, values);
    file.write("/names", {2}, std::vector<std::string>{"a", "longer"});
  });
  {
    on_root(MPI_COMM_WORLD, [&]() { Hdf5File::open(path); });
    const Hdf5File file = Hdf5File::open_too(path);
    EXPECT_EQ(file.read<std::string>("/names")[1], "longer");
    const std::size_t count = n > 1 && r == n - 1 ? 0 : n_of_rank;
    for (const std::string name : {"/in pieces", "/as one"})
      {
        const auto found = file.read_block<double>(name, {r * n_of_rank, 0}, {count, 3});
        ASSERT_EQ(found.size(), 3 * count);
        for (std::size_t k = 0; k < found.size(); ++k)
          ASSERT_EQ(found[k], 3. * r * n_of_rank + k);
        const auto read_badly_on_one = [&]() {
          file.read_block<double>(name, {r + 1 == n ? n_all : 0, 0}, {1, 3});
        };
        EXPECT_THROW(on_all_ranks(MPI_COMM_WORLD, read_badly_on_one), UserError);
      }
  }
  on_root(MPI_COMM_WORLD, [&]() { std::filesystem::remove(path); });
  EXPECT_THROW(on_all_ranks(MPI_COMM_WORLD, [&]() { Hdf5File::open_too(path); }),
               UserError);
}

TEST(Distribution, WhatOneRankFindsWrongStopsAll)
{
  const unsigned int n = mpi::n_mpi_processes(MPI_COMM_WORLD),
                     r = mpi::this_mpi_process(MPI_COMM_WORLD);
  try
    {
      on_all_ranks(MPI_COMM_WORLD, [&]() {
        if (r + 1 == n)
          throw UserError("of the last rank");
      });
      FAIL() << "on rank " << r;
    }
  catch (const UserError &error)
    {
      EXPECT_EQ(std::string(error.what()), "of the last rank");
    }
  EXPECT_THROW(on_all_ranks(MPI_COMM_WORLD, [&]() { throw NumericalFailure("all"); }),
               NumericalFailure);
  unsigned int calls = 0;
  on_all_ranks(MPI_COMM_WORLD, [&]() { ++calls; });
  EXPECT_EQ(calls, 1U);
}
