#ifndef mesoslip_base_exchange_h
#define mesoslip_base_exchange_h

#include "base/archive.h"
#include "base/collective.h"

#include <algorithm>
#include <type_traits>

namespace mesoslip
{
namespace internal
{
/** Numbers and structs of numbers as they are in memory, others by their serialize(). */
template <typename T>
std::string to_message(const T &object)
{
  static_assert(!std::is_pointer_v<T>, "addresses mean nothing to another process");
  if constexpr (std::is_trivially_copyable_v<T>)
    return std::string(reinterpret_cast<const char *>(&object), sizeof(T));
  else
    return save_state(object);
}

/** The inverse. */
template <typename T>
void from_message(const std::string &message, T &object)
{
  if constexpr (std::is_trivially_copyable_v<T>)
    std::copy_n(message.data(), sizeof(T), reinterpret_cast<char *>(&object));
  else
    load_state(message, object, "the message of another process");
}
} // namespace internal

/**
 * Gives every rank the @p object of rank @p owner. Objects travel whole, so that no
 * member can be left behind: their serialize() is best made of serialize_members().
 */
template <typename T>
void broadcast_object(const MPI_Comm communicator, T &object, const int owner = 0)
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  if (n_ranks == 1)
    return;
  std::string message = rank == owner ? internal::to_message(object) : std::string();
  broadcast(communicator, message, owner);
  if (rank != owner)
    internal::from_message(message, object);
}

/** Gives rank 0 the @p object of rank @p owner, whole; the other ranks keep theirs. */
template <typename T>
void bring_object_to_root(const MPI_Comm communicator, T &object, const int owner)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  std::string message = rank == owner ? internal::to_message(object) : std::string();
  bring_to_root(communicator, message, owner);
  if (rank == 0 && owner != 0)
    internal::from_message(message, object);
}
} // namespace mesoslip

#endif
