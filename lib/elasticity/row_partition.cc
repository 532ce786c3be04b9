#include "elasticity/row_partition.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesoslip
{
namespace
{
constexpr int upward_tag = 71, downward_tag = 72, gather_tag = 73, scatter_tag = 74;

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

NodeRows
rows_of(const unsigned int n_rows, const unsigned int rank, const unsigned int size)
{
  const auto begin = [&](const unsigned int r) {
    return static_cast<unsigned int>(static_cast<unsigned long long>(n_rows) * r / size);
  };
  return {n_rows, begin(rank), begin(rank + 1)};
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
} // namespace

NodeRows partition_rows(const unsigned int n_rows, MPI_Comm communicator)
{
  const unsigned int size = size_of(communicator);
  if (size > 1 && n_rows < 2 * size)
    throw std::invalid_argument(std::to_string(n_rows) + " node rows are too few for " +
                                std::to_string(size) + " ranks; use at most " +
                                std::to_string(n_rows / 2));
  return rows_of(n_rows, rank_of(communicator), size);
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
  exchange(upper, rank + 1, high - 1, lower, rank - 1, 0, upward_tag);
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
      const NodeRows other = rows_of(rows.n_global, r, size);
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
          const NodeRows other             = rows_of(rows.n_global, r, size);
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

/** One neighbour: a message out and a message in, each four rows. */
struct MPIHalo::Side
{
  MPI_Comm communicator;
  int neighbour;
  int send_tag, receive_tag;
  unsigned int n;
  std::vector<double> out, in;
  MPI_Request sending   = MPI_REQUEST_NULL;
  MPI_Request receiving = MPI_REQUEST_NULL;

  Side(MPI_Comm comm,
       const int rank,
       const int s_tag,
       const int r_tag,
       const unsigned int n_columns)
    : communicator(comm)
    , neighbour(rank)
    , send_tag(s_tag)
    , receive_tag(r_tag)
    , n(n_columns)
    , out(4 * std::size_t(n_columns))
    , in(4 * std::size_t(n_columns))
  {
  }

  /** A message out announces one in: the neighbour runs the same number of steps. */
  void send(const RowState &row)
  {
    MPI_Wait(&sending, MPI_STATUS_IGNORE);
    double *o = out.data();
    for (const double *values : {row.ux, row.uy, row.wx, row.wy})
      o = std::copy_n(values, n, o);
    MPI_Isend(out.data(), static_cast<int>(out.size()), MPI_DOUBLE, neighbour, send_tag,
              communicator, &sending);
    post();
  }

  void post()
  {
    if (receiving == MPI_REQUEST_NULL)
      MPI_Irecv(in.data(), static_cast<int>(in.size()), MPI_DOUBLE, neighbour,
                receive_tag, communicator, &receiving);
  }

  void receive(const RowState &row)
  {
    post();
    MPI_Wait(&receiving, MPI_STATUS_IGNORE);
    const double *i = in.data();
    for (double *values : {row.ux, row.uy, row.wx, row.wy})
      {
        std::copy_n(i, n, values);
        i += n;
      }
  }

  void progress()
  {
    int done = 0;
    MPI_Test(&sending, &done, MPI_STATUS_IGNORE);
  }

  /** Every message sent has been received when all ranks have done their last step. */
  ~Side()
  {
    if (receiving != MPI_REQUEST_NULL)
      {
        MPI_Cancel(&receiving);
        MPI_Wait(&receiving, MPI_STATUS_IGNORE);
      }
    MPI_Wait(&sending, MPI_STATUS_IGNORE);
  }
};

MPIHalo::MPIHalo(const unsigned int columns, MPI_Comm communicator)
  : n_columns(columns)
{
  const int rank = rank_of(communicator), size = size_of(communicator);
  if (rank > 0)
    lower =
      std::make_unique<Side>(communicator, rank - 1, downward_tag, upward_tag, n_columns);
  if (rank + 1 < size)
    upper =
      std::make_unique<Side>(communicator, rank + 1, upward_tag, downward_tag, n_columns);
}

MPIHalo::~MPIHalo() = default;

void MPIHalo::send_lower(const RowState &own_lowest)
{
  lower->send(own_lowest);
}

void MPIHalo::send_upper(const RowState &own_highest)
{
  upper->send(own_highest);
}

void MPIHalo::receive_lower(const RowState &ghost)
{
  lower->receive(ghost);
}

void MPIHalo::receive_upper(const RowState &ghost)
{
  upper->receive(ghost);
}

void MPIHalo::progress()
{
  for (Side *side : {lower.get(), upper.get()})
    if (side)
      side->progress();
}
} // namespace mesoslip
