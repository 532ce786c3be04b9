#ifndef mesoslip_base_exchange_h
#define mesoslip_base_exchange_h

#include <cstddef>
#include <cstring>
#include <functional>
#include <mpi.h>
#include <string>
#include <type_traits>
#include <vector>

namespace mesoslip
{
/** The texts of all ranks on rank 0, in their order; elsewhere empty. */
std::vector<std::string> gather(const MPI_Comm communicator, const std::string &text);

/**
 * The few questions of dealii::Utilities::MPI that are asked here, without its header and the archives of Boost, which
 * each source that includes them takes seconds to compile.
 */
namespace mpi
{
/** Number of ranks. */
unsigned int n_mpi_processes(const MPI_Comm communicator);

/** Number of this rank. */
unsigned int this_mpi_process(const MPI_Comm communicator);

/** Sum over the ranks: of double and unsigned integers. Collective. */
template <typename Number>
Number sum(const Number &value, const MPI_Comm communicator);

/** Largest of the ranks: of double and integers. Collective. */
template <typename Number>
Number max(const Number &value, const MPI_Comm communicator);

/** Smallest of the ranks: of int and unsigned integers. Collective. */
template <typename Number>
Number min(const Number &value, const MPI_Comm communicator);

namespace internal
{
/** Replaces the @p n @p bytes, which may be more than 2^31, by those of rank @p owner. Collective. */
void broadcast_bytes(void *bytes,
                     const std::size_t n,
                     const int owner,
                     const MPI_Comm communicator);

/** The texts of all ranks, in their order, on each of them. Collective. */
std::vector<std::string> all_gather(const MPI_Comm communicator, const std::string &text);

template <typename T>
std::string bytes_of(const std::vector<T> &values)
{
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char *>(values.data()), values.size() * sizeof(T)};
}

template <typename T>
std::vector<std::vector<T>> values_of(const std::vector<std::string> &texts)
{
  std::vector<std::vector<T>> values;
  for (const std::string &bytes : texts)
    {
      values.emplace_back(bytes.size() / sizeof(T));
      if (!bytes.empty())
        std::memcpy(values.back().data(), bytes.data(), bytes.size());
    }
  return values;
}
} // namespace internal

/** The @p value of rank @p owner, a plain number or struct. Collective. */
template <typename T>
T broadcast(T value, const int owner, const MPI_Comm communicator)
{
  static_assert(std::is_trivially_copyable_v<T>);
  internal::broadcast_bytes(&value, sizeof(T), owner, communicator);
  return value;
}

/** The @p values of rank @p owner, plain numbers or structs. Collective. */
template <typename T>
std::vector<T>
broadcast(std::vector<T> values, const int owner, const MPI_Comm communicator)
{
  static_assert(std::is_trivially_copyable_v<T>);
  values.resize(broadcast(values.size(), owner, communicator));
  internal::broadcast_bytes(values.data(), values.size() * sizeof(T), owner,
                            communicator);
  return values;
}

/** The values of each rank on rank 0, elsewhere empty. Collective. */
template <typename T>
std::vector<std::vector<T>> gather(const std::vector<T> &own, const MPI_Comm communicator)
{
  return internal::values_of<T>(mesoslip::gather(communicator, internal::bytes_of(own)));
}

/** The values of each rank on all. Collective. */
template <typename T>
std::vector<std::vector<T>> all_gather(const std::vector<T> &own,
                                       const MPI_Comm communicator)
{
  return internal::values_of<T>(
    internal::all_gather(communicator, internal::bytes_of(own)));
}
} // namespace mpi

/**
 * Runs @p work on rank 0 while the others wait; what it throws is thrown on all ranks
 * (UserError, NumericalFailure and Interrupted as such, others as std::runtime_error).
 * For reading files and anything else that only one rank does and that may fail.
 */
void on_root(const MPI_Comm communicator, const std::function<void()> &work);

/**
 * Runs @p work on every rank; what one of them throws, of several the lowest, is thrown on
 * all as by on_root(). Within @p work ranks may need each other only where none can have failed.
 */
void on_all_ranks(const MPI_Comm communicator, const std::function<void()> &work);

/** Gives every rank the text of rank @p owner. */
void broadcast(const MPI_Comm communicator, std::string &text, const int owner = 0);

/** Gives rank 0 the text of rank @p owner; the other ranks keep theirs. */
void bring_to_root(const MPI_Comm communicator, std::string &text, const int owner);

/** Gives rank r the text r of rank 0. */
std::string scatter(const MPI_Comm communicator, const std::vector<std::string> &texts);

/**
 * Gives each rank but the first the text that @p make (its number) returns on rank 0, made
 * one after the other so that rank 0 never has all of them; on rank 0 empty.
 */
std::string scatter(const MPI_Comm communicator,
                    const std::function<std::string(unsigned int)> &make);

/** Replaces the @p n @p values, as many on all ranks, by their sums over the ranks. Collective. */
void sum_over_ranks(double *values, const std::size_t n, const MPI_Comm communicator);

/** Replaces each of the @p values, as many on all ranks, by its sum over the ranks. Collective. */
void sum_over_ranks(std::vector<double> &values, const MPI_Comm communicator);

/** Fills @p all with the @p own values of each rank, whose @p counts and @p starts there all ranks know. Collective. */
void all_gather(const std::vector<double> &own,
                const std::vector<int> &counts,
                const std::vector<int> &starts,
                std::vector<double> &all,
                const MPI_Comm communicator);

/**
 * Lets the ranks, one after the other, @p add what they have to @p values, so that a sum has the same
 * bits on any number of ranks; then all have what the last one made. @p n values, whose start is that
 * of rank 0. Collective.
 */
void in_order_of_ranks(double *values,
                       const std::size_t n,
                       const std::function<void()> &add,
                       const MPI_Comm communicator);

/** Waits for @p requests and forgets them. */
void wait_for_all(std::vector<MPI_Request> &requests);

/** Whether mpirun (of Open MPI, or one with PMI) started this process. */
bool started_by_mpirun();

/** Whether this is the first of its processes, or the only one; known before MPI_Init. */
bool is_first_process();

/**
 * What a process without mpirun does not need of Open MPI is left out of its start; call
 * before MPI_Init. No daemon for ranks that are spawned: a quarter of the time to start,
 * and it outlives a run that is killed. No session folder: processes that start and end
 * side by side share one and remove it under each other (one start of 200 fails). No search for
 * networks between machines, which waits for 0.2 s.
 */
void prepare_mpi_of_one_process();

} // namespace mesoslip

#endif
