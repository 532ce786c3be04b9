#include "grid/halo.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace mesoslip
{
namespace
{
/**
 * Numbers per message. MPI libraries send up to 4 kB eagerly; longer messages wait for
 * the receiver.
 */
constexpr std::size_t message_size = 480;

constexpr int halo_tags[2] = {71, 72}; // downward, upward

/** Calls copy(values) for the four components of every row. */
template <typename Copy>
void for_each_row(const RowBlock &block, const Copy &copy)
{
  for (unsigned int l = 0; l < block.n_rows; ++l)
    for (double *values : {block.ux, block.uy, block.wx, block.wy})
      copy(values + l * block.stride);
}
} // namespace

MPIHalo::MPIHalo(const unsigned int n_columns,
                 const unsigned int max_rows,
                 const MPI_Comm communicator)
  : n_columns(n_columns)
  , communicator(communicator)
{
  MPI_Comm_rank(communicator, &rank);
  for (Neighbour &neighbour : neighbours)
    {
      neighbour.out.resize(4 * std::size_t(n_columns) * max_rows);
      neighbour.in.resize(neighbour.out.size());
    }
}

MPIHalo::~MPIHalo()
{
  for (Neighbour &neighbour : neighbours)
    {
      for (MPI_Request &request : neighbour.receiving)
        MPI_Cancel(&request);
      wait_for_all(neighbour.receiving);
      wait_for_all(neighbour.sending);
    }
}

// The neighbour runs the same steps, so each send announces one receive of the same size.
void MPIHalo::send(const Side side, const RowBlock &own)
{
  Neighbour &to = neighbours[side];
  Assert(to.receiving.empty(),
         dealii::ExcMessage("rows were sent that are not received"));
  wait_for_all(to.sending);
  double *next = to.out.data();
  for_each_row(own, [&](const double *row) { next = std::copy_n(row, n_columns, next); });
  const std::size_t n = next - to.out.data();
  const int other     = side == lower ? rank - 1 : rank + 1;
  for (std::size_t first = 0; first < n; first += message_size)
    {
      const int count = static_cast<int>(std::min(message_size, n - first));
      MPI_Irecv(&to.in[first], count, MPI_DOUBLE, other, halo_tags[1 - side],
                communicator, &to.receiving.emplace_back());
      MPI_Isend(&to.out[first], count, MPI_DOUBLE, other, halo_tags[side], communicator,
                &to.sending.emplace_back());
    }
}

void MPIHalo::receive(const Side side, const RowBlock &ghosts)
{
  Neighbour &from = neighbours[side];
  AssertDimension(from.receiving.size(),
                  (4 * std::size_t(n_columns) * ghosts.n_rows + message_size - 1) /
                    message_size);
  wait_for_all(from.receiving);
  const double *next = from.in.data();
  for_each_row(ghosts, [&](double *row) {
    std::copy_n(next, n_columns, row);
    next += n_columns;
  });
}

void MPIHalo::progress()
{
  for (Neighbour &neighbour : neighbours)
    {
      int done = 0;
      MPI_Testall(static_cast<int>(neighbour.sending.size()), neighbour.sending.data(),
                  &done, MPI_STATUSES_IGNORE);
    }
}
} // namespace mesoslip
