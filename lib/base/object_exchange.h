#ifndef mesoslip_base_object_exchange_h
#define mesoslip_base_object_exchange_h

#include "base/archives.h"
#include "base/errors.h"
#include "base/exchange.h"

#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/stream.hpp>

#include <exception>
#include <string>
#include <type_traits>

namespace mesoslip
{
/**
 * Bytes that serialize() of @p object saves; readable by the same program on the same
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
 * Restores @p object from the bytes of save_state(). A caller that stores the bytes in a
 * file adds a checksum. Further bytes may follow. @throws UserError "<source>: ..." if
 * the bytes are not such a state.
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

/**
 * Sends to each rank r > 0 the object that @p make (r) returns on rank 0. Rank 0 makes
 * the objects one after another, so that it never stores all of them.
 */
template <typename Make>
auto scatter_objects(const MPI_Comm communicator, const Make &make)
{
  const std::string text = scatter(
    communicator, [&](const unsigned int rank) { return save_state(make(rank)); });
  if (mpi::this_mpi_process(communicator) == 0)
    return make(0U);
  decltype(make(0U)) object;
  load_state(text, object, "the message of another process");
  return object;
}

/**
 * Broadcasts the @p object of rank @p owner. Its serialize() best uses
 * serialize_members(), which covers all members.
 */
template <typename T>
void broadcast_object(const MPI_Comm communicator, T &object, const int owner = 0)
{
  if constexpr (std::is_trivially_copyable_v<T>)
    object = mpi::broadcast(object, owner, communicator);
  else if (mpi::n_mpi_processes(communicator) > 1)
    {
      const bool is_owner =
        static_cast<int>(mpi::this_mpi_process(communicator)) == owner;
      std::string message = is_owner ? save_state(object) : std::string();
      broadcast(communicator, message, owner);
      if (!is_owner)
        load_state(message, object, "the message of another process");
    }
}

/** Gives rank 0 the @p object of rank @p owner; other ranks keep theirs. */
template <typename T>
void bring_object_to_root(const MPI_Comm communicator, T &object, const int owner)
{
  const int rank      = static_cast<int>(mpi::this_mpi_process(communicator));
  std::string message = rank == owner ? save_state(object) : std::string();
  bring_to_root(communicator, message, owner);
  if (rank == 0 && owner != 0)
    load_state(message, object, "the message of another process");
}
} // namespace mesoslip

#endif
