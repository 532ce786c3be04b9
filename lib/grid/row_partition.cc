#include "grid/row_partition.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesoslip
{
namespace
{
constexpr int upward_tag = 73, downward_tag = 74, gather_tag = 75, scatter_tag = 76;

int rank_of(MPI_Comm communicator)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  return rank;
}

int size_of(MPI_Comm communicator)
{
  int size = 1;
  MPI_Comm_size(communicator, &size);
  return size;
}

NodeRows rows_of(const unsigned int n_rows,
                 const unsigned int rank,
                 const unsigned int size,
                 const unsigned int ghosts)
{
  // Kernels advance three rows at once, from row 1 on: odd ones cost twice as much.
  const bool many  = n_rows / size >= 12;
  const auto begin = [&](const unsigned int r) {
    const unsigned int even =
      static_cast<unsigned int>(static_cast<unsigned long long>(n_rows) * r / size);
    return many && 0 < r && r < size ? even + 1 - even % 3 : even;
  };
  return {n_rows, begin(rank), begin(rank + 1), ghosts};
}

/** Rows [first, last) of both components, one after the other. */
std::vector<double>
pack(const NodalField<double> &field, const unsigned int first, const unsigned int last)
{
  std::vector<double> values;
  values.reserve(2 * std::size_t(last - first) * field.n_columns());
  for (unsigned int l = first; l < last; ++l)
    for (const unsigned int c : {0u, 1u})
      values.insert(values.end(), field.row(c, l), field.row(c, l) + field.n_columns());
  return values;
}

void unpack(const std::vector<double> &values,
            NodalField<double> &field,
            const unsigned int first,
            const unsigned int last)
{
  const double *v = values.data();
  for (unsigned int l = first; l < last; ++l)
    for (const unsigned int c : {0u, 1u})
      {
        std::copy_n(v, field.n_columns(), field.row(c, l));
        v += field.n_columns();
      }
}

/** Rows from @p first_from of @p from to rows from @p first_to of @p to. */
void copy_rows(const NodalField<double> &from,
               const unsigned int first_from,
               NodalField<double> &to,
               const unsigned int first_to,
               const unsigned int n_rows)
{
  for (const unsigned int c : {0u, 1u})
    std::copy_n(from.row(c, first_from), n_rows * from.stride(), to.row(c, first_to));
}
} // namespace

unsigned int largest_number_of_ranks(const unsigned int n_rows)
{
  return std::max(1u, n_rows / 2);
}

NodeRows partition_rows(const unsigned int n_rows,
                        MPI_Comm communicator,
                        const unsigned int ghosts)
{
  const unsigned int size = size_of(communicator);
  if (size > largest_number_of_ranks(n_rows))
    throw std::invalid_argument(std::to_string(n_rows) + " node rows are too few for " +
                                std::to_string(size) + " ranks; use at most " +
                                std::to_string(largest_number_of_ranks(n_rows)));
  return rows_of(n_rows, rank_of(communicator), size, ghosts);
}

NodeRows partition_rows(const unsigned int n_columns,
                        const unsigned int n_rows,
                        MPI_Comm communicator,
                        const SweepOptions &options)
{
  return partition_rows(
    n_rows, communicator,
    steps_in_flight(n_columns, n_rows, size_of(communicator), options.wavefront));
}

void update_ghost_rows(NodalField<double> &field,
                       const NodeRows &rows,
                       MPI_Comm communicator)
{
  const int rank         = rank_of(communicator);
  const unsigned int low = rows.local(rows.begin), high = rows.local(rows.end);
  // The neighbour of one direction sends while that of the other receives.
  const auto exchange = [&](const bool send, const int to, const unsigned int sent,
                            const bool receive, const int from,
                            const unsigned int received, const int tag) {
    std::vector<double> out;
    if (send)
      out = pack(field, sent, sent + 1);
    std::vector<double> in(receive ? 2 * std::size_t(field.n_columns()) : 0);
    MPI_Sendrecv(out.data(), static_cast<int>(out.size()), MPI_DOUBLE,
                 send ? to : MPI_PROC_NULL, tag, in.data(), static_cast<int>(in.size()),
                 MPI_DOUBLE, receive ? from : MPI_PROC_NULL, tag, communicator,
                 MPI_STATUS_IGNORE);
    if (receive)
      unpack(in, field, received, received + 1);
  };
  const bool lower = rows.has_lower_ghost(), upper = rows.has_upper_ghost();
  exchange(upper, rank + 1, high - 1, lower, rank - 1, low - 1, upward_tag);
  exchange(lower, rank - 1, low, upper, rank + 1, high, downward_tag);
}

NodalField<double>
gather_rows(const NodalField<double> &field, const NodeRows &rows, MPI_Comm communicator)
{
  const std::vector<double> own =
    pack(field, rows.local(rows.begin), rows.local(rows.end));
  if (rank_of(communicator) > 0)
    {
      MPI_Send(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, 0, gather_tag,
               communicator);
      return NodalField<double>();
    }
  NodalField<double> whole(field.n_columns(), rows.n_global);
  unpack(own, whole, rows.begin, rows.end);
  const unsigned int size = size_of(communicator);
  for (unsigned int r = 1; r < size; ++r)
    {
      const NodeRows other = rows_of(rows.n_global, r, size, rows.ghosts);
      std::vector<double> values(2 * std::size_t(other.end - other.begin) *
                                 field.n_columns());
      MPI_Recv(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, r, gather_tag,
               communicator, MPI_STATUS_IGNORE);
      unpack(values, whole, other.begin, other.end);
    }
  return whole;
}

NodalField<double> scatter_rows(const NodalField<double> &whole,
                                const unsigned int n_columns,
                                const NodeRows &rows,
                                MPI_Comm communicator)
{
  NodalField<double> field(n_columns, rows.n_local());
  if (rank_of(communicator) == 0)
    {
      const unsigned int size = size_of(communicator);
      for (unsigned int r = 1; r < size; ++r)
        {
          const NodeRows other             = rows_of(rows.n_global, r, size, rows.ghosts);
          const std::vector<double> values = pack(whole, other.first(), other.last());
          MPI_Send(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, r,
                   scatter_tag, communicator);
        }
      unpack(pack(whole, rows.first(), rows.last()), field, 0, rows.n_local());
    }
  else
    {
      std::vector<double> values(2 * std::size_t(rows.n_local()) * n_columns);
      MPI_Recv(values.data(), static_cast<int>(values.size()), MPI_DOUBLE, 0, scatter_tag,
               communicator, MPI_STATUS_IGNORE);
      unpack(values, field, 0, rows.n_local());
    }
  return field;
}

NodalField<double> own_rows(const NodalField<double> &field, const NodeRows &rows)
{
  const unsigned int n = rows.end - rows.begin;
  NodalField<double> own(field.n_columns(), n);
  copy_rows(field, rows.local(rows.begin), own, 0, n);
  return own;
}

NodalField<double> with_ghost_rows(const NodalField<double> &own, const NodeRows &rows)
{
  NodalField<double> field(own.n_columns(), rows.n_local());
  copy_rows(own, 0, field, rows.local(rows.begin), own.n_rows());
  return field;
}
} // namespace mesoslip
