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
/** Texts of all ranks on rank 0, in rank order; empty on other ranks. */
std::vector<std::string> gather(const MPI_Comm communicator, const std::string &text);

/**
 * Replacements of some functions of dealii::Utilities::MPI. They avoid its header, which
 * brings Boost's archives and takes seconds to compile.
 */
namespace mpi
{
/** Number of ranks. */
unsigned int n_mpi_processes(const MPI_Comm communicator);

/** Number of this rank. */
unsigned int this_mpi_process(const MPI_Comm communicator);

/** Sum over the ranks, for double and unsigned integers. Collective. */
template <typename Number>
Number sum(const Number &value, const MPI_Comm communicator);

/** Maximum over the ranks, for double and integers. Collective. */
template <typename Number>
Number max(const Number &value, const MPI_Comm communicator);

/** Minimum over the ranks, for int and unsigned integers. Collective. */
template <typename Number>
Number min(const Number &value, const MPI_Comm communicator);

namespace internal
{
/**
 * Replaces the @p n @p bytes (@p n may exceed 2^31) by the bytes of rank @p owner.
 * Collective.
 */
void broadcast_bytes(void *bytes,
                     const std::size_t n,
                     const int owner,
                     const MPI_Comm communicator);

/** Texts of all ranks, in rank order, on every rank. Collective. */
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

/** The values of each rank, on all ranks. Collective. */
template <typename T>
std::vector<std::vector<T>> all_gather(const std::vector<T> &own,
                                       const MPI_Comm communicator)
{
  return internal::values_of<T>(
    internal::all_gather(communicator, internal::bytes_of(own)));
}
} // namespace mpi

/**
 * Runs @p work on rank 0 while the other ranks wait. An exception is rethrown on all
 * ranks (UserError, NumericalFailure and Interrupted as such, any other as
 * std::runtime_error). Use it for reading files and for other work of a single rank that
 * may fail.
 */
void on_root(const MPI_Comm communicator, const std::function<void()> &work);

/**
 * Runs @p work on every rank. If ranks throw, the exception of the lowest one is rethrown
 * on all ranks as by on_root(). Within @p work, ranks may communicate only where none of
 * them can have failed.
 */
void on_all_ranks(const MPI_Comm communicator, const std::function<void()> &work);

/** Gives every rank the text of rank @p owner. */
void broadcast(const MPI_Comm communicator, std::string &text, const int owner = 0);

/** Gives rank 0 the text of rank @p owner; other ranks keep theirs. */
void bring_to_root(const MPI_Comm communicator, std::string &text, const int owner);

/** Sends text r of rank 0 to rank r; returns the text of this rank. */
std::string scatter(const MPI_Comm communicator, const std::vector<std::string> &texts);

/**
 * Sends to each rank r > 0 the text that @p make (r) returns on rank 0; empty on rank 0.
 * Rank 0 makes the texts one after another, so that it never stores all of them.
 */
std::string scatter(const MPI_Comm communicator,
                    const std::function<std::string(unsigned int)> &make);

/**
 * Replaces the @p n @p values (same @p n on all ranks) by their sums over the ranks.
 * Collective.
 */
void sum_over_ranks(double *values, const std::size_t n, const MPI_Comm communicator);

/**
 * Replaces each of the @p values (same size on all ranks) by its sum over the ranks.
 * Collective.
 */
void sum_over_ranks(std::vector<double> &values, const MPI_Comm communicator);

/**
 * Fills @p all with the @p own values of every rank. All ranks know @p counts and
 * @p starts, the length and the position of the values of each rank in @p all.
 * Collective.
 */
void all_gather(const std::vector<double> &own,
                const std::vector<int> &counts,
                const std::vector<int> &starts,
                std::vector<double> &all,
                const MPI_Comm communicator);

/**
 * Reduction in rank order: each rank calls @p add, which adds its contribution to the
 * @p n @p values; the result is broadcast. The bits of a sum then do not depend on the
 * number of ranks. Begins with the @p values of rank 0. Collective.
 */
void in_order_of_ranks(double *values,
                       const std::size_t n,
                       const std::function<void()> &add,
                       const MPI_Comm communicator);

/** Waits for @p requests and clears the list. */
void wait_for_all(std::vector<MPI_Request> &requests);

/** Whether mpirun (of Open MPI, or one with PMI) started this process. */
bool started_by_mpirun();

/** Whether this process has rank 0 or is the only process; works before MPI_Init. */
bool is_first_process();

/**
 * Switches off parts of Open MPI that a process without mpirun does not need; call it
 * before MPI_Init. No daemon for spawned ranks: it takes a quarter of the start time and
 * outlives a killed run. No session folder: concurrent processes share one and remove it
 * from one another. No search for networks between machines: it waits for 0.2 s.
 */
void prepare_mpi_of_one_process();

} // namespace mesoslip

#endif
