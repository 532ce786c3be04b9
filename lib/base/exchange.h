#ifndef mesoslip_base_exchange_h
#define mesoslip_base_exchange_h

#include "base/errors.h"

#include <deal.II/base/mpi.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/stream.hpp>

#include <exception>
#include <functional>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
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

/** The texts of all ranks on rank 0, in their order; elsewhere empty. */
std::vector<std::string> gather(const MPI_Comm communicator, const std::string &text);

/** Gives rank r the text r of rank 0. */
std::string scatter(const MPI_Comm communicator, const std::vector<std::string> &texts);

/**
 * Gives each rank but the first the text that @p make (its number) returns on rank 0, made
 * one after the other so that rank 0 never has all of them; on rank 0 empty.
 */
std::string scatter(const MPI_Comm communicator,
                    const std::function<std::string(unsigned int)> &make);

/** Replaces @p values, as many on all ranks, by their sums over the ranks. */
void sum_over_ranks(std::vector<double> &values, const MPI_Comm communicator);

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

/**
 * What a process without mpirun does not need of Open MPI is left out of its start; call
 * before MPI_Init. No daemon for ranks that are spawned: a quarter of the time to start,
 * and it outlives a run that is killed. No session folder: processes that start and end
 * side by side share one and remove it under each other (one start of 200 fails). No search for
 * networks between machines, which waits for 0.2 s.
 */
void prepare_mpi_of_one_process();

/**
 * What the serialize() of @p object saves, bit by bit, for the same program on the same
 * kind of machine.
 */
template <typename T>
std::string save_state(const T &object)
{
  std::string bytes;
  {
    boost::iostreams::stream<boost::iostreams::back_insert_device<std::string>> out(
      boost::iostreams::back_inserter(bytes));
    boost::archive::binary_oarchive(out) << object;
  }
  return bytes;
}

/**
 * Restores @p object from the bytes that save_state() gave; whoever stores them in a file
 * stores a checksum with them. More may follow them.
 * @throws UserError "<source>: ..." if they are no such state.
 */
template <typename T>
void load_state(const std::string &bytes, T &object, const std::string &source)
{
  try
    {
      boost::iostreams::stream<boost::iostreams::array_source> in(bytes.data(),
                                                                  bytes.size());
      boost::archive::binary_iarchive(in) >> object;
    }
  catch (const std::exception &error)
    {
      throw UserError(source + " is damaged: the state in it cannot be read (" +
                      error.what() + ")");
    }
}

/** Gives each rank the object that @p make (its number) returns on rank 0, made one after the
 * other so that rank 0 never has all of them. */
template <typename Make>
auto scatter_objects(const MPI_Comm communicator, const Make &make)
{
  const std::string text = scatter(
    communicator, [&](const unsigned int rank) { return save_state(make(rank)); });
  if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    return make(0U);
  decltype(make(0U)) object;
  load_state(text, object, "the message of another process");
  return object;
}

/**
 * Gives every rank the @p object of rank @p owner. Objects travel whole, so that no
 * member can be left behind: their serialize() is best made of serialize_members().
 */
template <typename T>
void broadcast_object(const MPI_Comm communicator, T &object, const int owner = 0)
{
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
    object = dealii::Utilities::MPI::broadcast(communicator, object, owner);
}

/** Gives rank 0 the @p object of rank @p owner, whole; the other ranks keep theirs. */
template <typename T>
void bring_object_to_root(const MPI_Comm communicator, T &object, const int owner)
{
  const int rank =
    static_cast<int>(dealii::Utilities::MPI::this_mpi_process(communicator));
  std::string message = rank == owner ? save_state(object) : std::string();
  bring_to_root(communicator, message, owner);
  if (rank == 0 && owner != 0)
    load_state(message, object, "the message of another process");
}
} // namespace mesoslip

#endif
