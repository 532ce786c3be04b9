#include "grid/mpi_halo.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
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
                 MPI_Comm communicator,
                 const Transport transport)
  : n_columns(n_columns)
{
  int rank = 0, size = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &size);
  const std::size_t capacity = 4 * std::size_t(n_columns) * max_rows;
  if (transport == Transport::automatic && size > 1)
    shared = std::make_unique<SharedSegments>(communicator, capacity);
  for (const Side side : {lower, upper})
    {
      const int neighbour = side == lower ? rank - 1 : rank + 1;
      if (neighbour < 0 || neighbour >= size)
        continue;
      if (shared && shared->reaches(neighbour))
        channels[side] = shared->channel(neighbour, side);
      else
        channels[side] = make_message_channel(communicator, neighbour, side, capacity);
    }
}

MPIHalo::~MPIHalo() = default;

void MPIHalo::send(const Side side, const RowBlock &own)
{
  double *const room = channels[side]->room();
  double *next       = room;
  for_each_row(own, [&](const double *row) { next = std::copy_n(row, n_columns, next); });
  channels[side]->send(next - room);
}

void MPIHalo::receive(const Side side, const RowBlock &ghosts)
{
  const double *next = channels[side]->receive();
  for_each_row(ghosts, [&](double *row) {
    std::copy_n(next, n_columns, row);
    next += n_columns;
  });
  channels[side]->release();
}

void MPIHalo::progress()
{
  for (const auto &channel : channels)
    if (channel)
      channel->progress();
}
} // namespace mesoslip
