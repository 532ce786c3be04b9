#include "grid/row_partition.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace mesoslip
{
namespace
{
using mpi::n_mpi_processes;
using mpi::this_mpi_process;

constexpr int upward_tag = 73, downward_tag = 74, gather_tag = 75;

NodeRows rows_of(const unsigned int n_rows,
                 const unsigned int rank,
                 const unsigned int size,
                 const unsigned int ghosts)
{
  // Kernels advance three rows at once, from row 1 on; remaining rows cost twice as much.
  const bool many  = n_rows / size >= 12;
  const auto begin = [&](const unsigned int r) {
    const unsigned int even =
      static_cast<unsigned int>(static_cast<unsigned long long>(n_rows) * r / size);
    return many && 0 < r && r < size ? even + 1 - even % 3 : even;
  };
  return {n_rows, begin(rank), begin(rank + 1), ghosts};
}

/** Number of values in @p n_rows contiguous rows, padding included. */
int count(const NodalField<double> &field, const unsigned int n_rows)
{
  return static_cast<int>(n_rows * field.stride());
}

/**
 * Copies @p n_rows rows of @p from, starting at row @p first_from, to rows of @p to,
 * starting at @p first_to.
 */
void copy_rows(const NodalField<double> &from,
               const unsigned int first_from,
               NodalField<double> &to,
               const unsigned int first_to,
               const unsigned int n_rows)
{
  AssertDimension(from.stride(), to.stride());
  std::copy_n(from.row(0, first_from), count(from, n_rows), to.row(0, first_to));
}

constexpr std::size_t row_bytes_per_node = 4 * sizeof(double);

std::size_t second_level_cache()
{
#ifdef _SC_LEVEL2_CACHE_SIZE // glibc only
  const long size = sysconf(_SC_LEVEL2_CACHE_SIZE);
  if (size > 0)
    return size;
#endif
  return 1 << 20;
}

std::size_t
suggested(const unsigned int n_columns, const unsigned int n_rows, const bool is_slab)
{
  const std::size_t cache = second_level_cache(), row = n_columns * row_bytes_per_node;
  if (row * n_rows < (is_slab ? cache / 8 * 7 : cache / 2))
    return 1;
  // A stage reads the rows that the previous one has just written. More stages therefore
  // pay off even if they do not all fit into the cache (measured on rows of 0.6 to 36
  // kB). A stage works on five rows.
  const std::size_t stages = std::clamp<std::size_t>(cache / 2 / (5 * row), 8, 16);
  if (!is_slab)
    return stages;
  // (n - 1) / 2 additional rows per step on each side.
  return std::min<std::size_t>(stages, 1 + n_rows * 3 / 100);
}
} // namespace

unsigned int choose_steps_at_once(const unsigned int n_columns,
                                  const unsigned int n_rows,
                                  const unsigned int n_ranks,
                                  const unsigned int requested)
{
  const unsigned int of_a_rank = n_rows / n_ranks;
  // Every rank must own the rows that its neighbours need; slabs differ by two rows.
  const unsigned int most = n_ranks > 1 ? std::clamp(of_a_rank, 3u, 66u) - 2 : 64u;
  if (n_rows < 3)
    return 1;
  const std::size_t n =
    requested > 0 ? requested : suggested(n_columns, of_a_rank, n_ranks > 1);
  return std::min<std::size_t>(n, most);
}

unsigned int largest_number_of_ranks(const unsigned int n_rows)
{
  return std::max(1u, n_rows / 2);
}

NodeRows partition_rows(const unsigned int n_rows,
                        MPI_Comm communicator,
                        const unsigned int ghosts)
{
  const unsigned int size = n_mpi_processes(communicator);
  if (size > largest_number_of_ranks(n_rows))
    throw std::invalid_argument(std::to_string(n_rows) + " node rows are too few for " +
                                std::to_string(size) + " ranks; use at most " +
                                std::to_string(largest_number_of_ranks(n_rows)));
  return rows_of(n_rows, this_mpi_process(communicator), size, ghosts);
}

NodeRows partition_rows(const unsigned int n_columns,
                        const unsigned int n_rows,
                        MPI_Comm communicator,
                        const SweepOptions &options)
{
  return partition_rows(n_rows, communicator,
                        choose_steps_at_once(n_columns, n_rows,
                                             n_mpi_processes(communicator),
                                             options.steps_at_once));
}

void update_ghost_rows(NodalField<double> &field,
                       const NodeRows &rows,
                       MPI_Comm communicator)
{
  const int rank  = static_cast<int>(this_mpi_process(communicator));
  const int below = rows.has_lower_ghost() ? rank - 1 : MPI_PROC_NULL,
            above = rows.has_upper_ghost() ? rank + 1 : MPI_PROC_NULL;
  const int low   = static_cast<int>(rows.local(rows.begin)),
            high  = static_cast<int>(rows.local(rows.end));
  // While one neighbour is sent to, the other one is received from.
  const auto exchange = [&](const int sent, const int to, const int received,
                            const int from, const int tag) {
    MPI_Sendrecv(field.row(0, sent), count(field, 1), MPI_DOUBLE, to, tag,
                 field.row(0, received), count(field, 1), MPI_DOUBLE, from, tag,
                 communicator, MPI_STATUS_IGNORE);
  };
  exchange(high - 1, above, low - 1, below, upward_tag);
  exchange(low, below, high, above, downward_tag);
}

NodalField<double>
gather_rows(const NodalField<double> &field, const NodeRows &rows, MPI_Comm communicator)
{
  const unsigned int n_own = rows.end - rows.begin;
  if (this_mpi_process(communicator) > 0)
    {
      MPI_Send(field.row(0, rows.local(rows.begin)), count(field, n_own), MPI_DOUBLE, 0,
               gather_tag, communicator);
      return NodalField<double>();
    }
  NodalField<double> whole(field.n_columns(), rows.n_global);
  copy_rows(field, rows.local(rows.begin), whole, rows.begin, n_own);
  const unsigned int size = n_mpi_processes(communicator);
  for (unsigned int r = 1; r < size; ++r)
    {
      const NodeRows other = rows_of(rows.n_global, r, size, rows.ghosts);
      MPI_Recv(whole.row(0, other.begin), count(whole, other.end - other.begin),
               MPI_DOUBLE, r, gather_tag, communicator, MPI_STATUS_IGNORE);
    }
  return whole;
}
} // namespace mesoslip
