#include "base/exchange.h"

#include "base/errors.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

namespace mesoslip
{
namespace
{
// Longest message (bytes); MPI counts are below 2^31.
constexpr std::size_t longest_message = 1 << 30;

void send(const MPI_Comm communicator, const int rank, const std::string &text)
{
  unsigned long long length = text.size();
  MPI_Send(&length, 1, MPI_UNSIGNED_LONG_LONG, rank, 0, communicator);
  for (std::size_t at = 0; at < text.size(); at += longest_message)
    MPI_Send(text.data() + at,
             static_cast<int>(std::min(longest_message, text.size() - at)), MPI_CHAR,
             rank, 0, communicator);
}

std::string receive(const MPI_Comm communicator, const int rank)
{
  unsigned long long length = 0;
  MPI_Recv(&length, 1, MPI_UNSIGNED_LONG_LONG, rank, 0, communicator, MPI_STATUS_IGNORE);
  std::string text(length, '\0');
  for (std::size_t at = 0; at < text.size(); at += longest_message)
    MPI_Recv(text.data() + at,
             static_cast<int>(std::min(longest_message, text.size() - at)), MPI_CHAR,
             rank, 0, communicator, MPI_STATUS_IGNORE);
  return text;
}
} // namespace

namespace mpi
{
namespace
{
template <typename Number>
MPI_Datatype type_of()
{
  if constexpr (std::is_same_v<Number, double>)
    return MPI_DOUBLE;
  else if constexpr (std::is_same_v<Number, int>)
    return MPI_INT;
  else if constexpr (std::is_same_v<Number, unsigned int>)
    return MPI_UNSIGNED;
  else
    return MPI_UINT64_T;
}

/**
 * Reduction over the ranks; returns @p value if there is one rank or MPI was not started.
 */
template <typename Number>
Number reduce(Number value, const MPI_Op operation, const MPI_Comm communicator)
{
  if (n_mpi_processes(communicator) > 1)
    MPI_Allreduce(MPI_IN_PLACE, &value, 1, type_of<Number>(), operation, communicator);
  return value;
}

bool is_running()
{
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started != 0 && ended == 0;
}
} // namespace

unsigned int n_mpi_processes(const MPI_Comm communicator)
{
  int n = 1;
  if (is_running())
    MPI_Comm_size(communicator, &n);
  return static_cast<unsigned int>(n);
}

unsigned int this_mpi_process(const MPI_Comm communicator)
{
  int rank = 0;
  if (is_running())
    MPI_Comm_rank(communicator, &rank);
  return static_cast<unsigned int>(rank);
}

template <typename Number>
Number sum(const Number &value, const MPI_Comm communicator)
{
  return reduce(value, MPI_SUM, communicator);
}

template <typename Number>
Number max(const Number &value, const MPI_Comm communicator)
{
  return reduce(value, MPI_MAX, communicator);
}

template <typename Number>
Number min(const Number &value, const MPI_Comm communicator)
{
  return reduce(value, MPI_MIN, communicator);
}

void internal::broadcast_bytes(void *bytes,
                               const std::size_t n,
                               const int owner,
                               const MPI_Comm communicator)
{
  if (n_mpi_processes(communicator) == 1)
    return;
  for (std::size_t at = 0; at < n; at += longest_message)
    MPI_Bcast(static_cast<char *>(bytes) + at,
              static_cast<int>(std::min(longest_message, n - at)), MPI_BYTE, owner,
              communicator);
}

std::vector<std::string> internal::all_gather(const MPI_Comm communicator,
                                              const std::string &text)
{
  std::vector<std::string> texts = mesoslip::gather(communicator, text);
  texts.resize(n_mpi_processes(communicator));
  for (std::string &one : texts)
    mesoslip::broadcast(communicator, one);
  return texts;
}

template double sum(const double &, const MPI_Comm);
template unsigned int sum(const unsigned int &, const MPI_Comm);
template std::uint64_t sum(const std::uint64_t &, const MPI_Comm);
template double max(const double &, const MPI_Comm);
template int max(const int &, const MPI_Comm);
template unsigned int max(const unsigned int &, const MPI_Comm);
template std::uint64_t max(const std::uint64_t &, const MPI_Comm);
template int min(const int &, const MPI_Comm);
template unsigned int min(const unsigned int &, const MPI_Comm);
template std::uint64_t min(const std::uint64_t &, const MPI_Comm);
} // namespace mpi

void broadcast(const MPI_Comm communicator, std::string &text, const int owner)
{
  text.resize(mpi::broadcast(text.size(), owner, communicator));
  mpi::internal::broadcast_bytes(text.data(), text.size(), owner, communicator);
}

void bring_to_root(const MPI_Comm communicator, std::string &text, const int owner)
{
  const int rank = static_cast<int>(mpi::this_mpi_process(communicator));
  if (owner == 0)
    return;
  if (rank == owner)
    send(communicator, 0, text);
  else if (rank == 0)
    text = receive(communicator, owner);
}

std::vector<std::string> gather(const MPI_Comm communicator, const std::string &text)
{
  std::vector<std::string> texts;
  if (mpi::this_mpi_process(communicator) > 0)
    send(communicator, 0, text);
  else
    {
      texts.push_back(text);
      const int n_ranks = static_cast<int>(mpi::n_mpi_processes(communicator));
      for (int r = 1; r < n_ranks; ++r)
        texts.push_back(receive(communicator, r));
    }
  return texts;
}

std::string scatter(const MPI_Comm communicator, const std::vector<std::string> &texts)
{
  if (mpi::this_mpi_process(communicator) > 0)
    return receive(communicator, 0);
  for (std::size_t r = 1; r < texts.size(); ++r)
    send(communicator, static_cast<int>(r), texts[r]);
  return texts.front();
}

void on_root(const MPI_Comm communicator, const std::function<void()> &work)
{
  on_all_ranks(communicator, [&]() {
    if (mpi::this_mpi_process(communicator) == 0)
      work();
  });
}

void on_all_ranks(const MPI_Comm communicator, const std::function<void()> &work)
{
  const unsigned int ranks = mpi::n_mpi_processes(communicator),
                     rank  = mpi::this_mpi_process(communicator);
  if (ranks == 1)
    return work();

  std::exception_ptr failure;
  bool lacks_memory = false;
  auto status       = ExitStatus::done;
  std::string message;
  try
    {
      work();
    }
  catch (const std::exception &error)
    {
      failure      = std::current_exception();
      message      = error.what();
      lacks_memory = dynamic_cast<const std::bad_alloc *>(&error) != nullptr;
      status       = dynamic_cast<const UserError *>(&error) ? ExitStatus::user_error
                     : dynamic_cast<const NumericalFailure *>(&error)
                       ? ExitStatus::numerical_failure
                     : dynamic_cast<const Interrupted *>(&error) ? ExitStatus::interrupted
                                                                 : ExitStatus::unexpected;
    }
  const unsigned int failed = mpi::min(failure ? rank : ranks, communicator);
  if (failed == ranks)
    return;
  const int owner = static_cast<int>(failed);
  status          = mpi::broadcast(status, owner, communicator);
  lacks_memory    = mpi::broadcast(lacks_memory, owner, communicator);
  broadcast(communicator, message, owner);
  if (rank == failed)
    std::rethrow_exception(failure);
  switch (status)
    {
    case ExitStatus::user_error:
      throw UserError(message);
    case ExitStatus::numerical_failure:
      throw NumericalFailure(message);
    case ExitStatus::interrupted:
      throw Interrupted(message);
    default:
      if (lacks_memory)
        throw std::bad_alloc();
      throw std::runtime_error(message);
    }
}

std::string scatter(const MPI_Comm communicator,
                    const std::function<std::string(unsigned int)> &make)
{
  const unsigned int rank    = mpi::this_mpi_process(communicator),
                     n_ranks = mpi::n_mpi_processes(communicator);
  std::string own;
  for (unsigned int r = 1; r < n_ranks; ++r)
    {
      std::string text;
      on_root(communicator, [&]() { text = make(r); });
      if (rank == 0)
        send(communicator, static_cast<int>(r), text);
      else if (rank == r)
        own = receive(communicator, 0);
    }
  return own;
}

void sum_over_ranks(double *values, const std::size_t n, const MPI_Comm communicator)
{
  if (mpi::n_mpi_processes(communicator) > 1)
    MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(n), MPI_DOUBLE, MPI_SUM,
                  communicator);
}

void sum_over_ranks(std::vector<double> &values, const MPI_Comm communicator)
{
  sum_over_ranks(values.data(), values.size(), communicator);
}

void all_gather(const std::vector<double> &own,
                const std::vector<int> &counts,
                const std::vector<int> &starts,
                std::vector<double> &all,
                const MPI_Comm communicator)
{
  if (counts.size() == 1)
    all = own;
  else
    MPI_Allgatherv(own.data(), static_cast<int>(own.size()), MPI_DOUBLE, all.data(),
                   counts.data(), starts.data(), MPI_DOUBLE, communicator);
}

void in_order_of_ranks(double *values,
                       const std::size_t n,
                       const std::function<void()> &add,
                       const MPI_Comm communicator)
{
  const int n_ranks = static_cast<int>(mpi::n_mpi_processes(communicator)),
            rank    = static_cast<int>(mpi::this_mpi_process(communicator)),
            length  = static_cast<int>(n);
  if (rank > 0)
    MPI_Recv(values, length, MPI_DOUBLE, rank - 1, 0, communicator, MPI_STATUS_IGNORE);
  add();
  if (rank + 1 < n_ranks)
    MPI_Send(values, length, MPI_DOUBLE, rank + 1, 0, communicator);
  if (n_ranks > 1)
    MPI_Bcast(values, length, MPI_DOUBLE, n_ranks - 1, communicator);
}

void wait_for_all(std::vector<MPI_Request> &requests)
{
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  requests.clear();
}

namespace
{
/**
 * Rank as set by mpirun in the environment; empty if mpirun did not start this process.
 */
std::string rank_by_mpirun()
{
  for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
    if (const char *rank = std::getenv(name))
      return rank;
  return "";
}
} // namespace

bool started_by_mpirun()
{
  return !rank_by_mpirun().empty();
}

bool is_first_process()
{
  const std::string rank = rank_by_mpirun();
  return rank.empty() || rank == "0";
}

void prepare_mpi_of_one_process()
{
  if (started_by_mpirun())
    return;
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  ::setenv("OMPI_MCA_pml", "ob1", 0);
  ::setenv("OMPI_MCA_btl", "self", 0);
}
} // namespace mesoslip
