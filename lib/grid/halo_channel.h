#ifndef mesoslip_grid_halo_channel_h
#define mesoslip_grid_halo_channel_h

#include "grid/halo.h"

#include <cstddef>
#include <memory>
#include <mpi.h>

namespace mesoslip
{
/** Numbers to and from one neighbour, in order. Internal to MPIHalo. */
class HaloChannel
{
public:
  virtual ~HaloChannel() = default;

  /** Where to write the next message; waits until there is room. */
  virtual double *room() = 0;

  /** Send the first @p n numbers written there. */
  virtual void send(const std::size_t n) = 0;

  /** Wait for the next message; it stays there until release(). */
  virtual const double *receive() = 0;

  /** The message of receive() may be overwritten. */
  virtual void release()
  {
  }

  /** Lets messages move that need this rank's help. */
  virtual void progress()
  {
  }
};

/** Nonblocking messages of at most @p capacity numbers to and from rank @p neighbour,
 *  which lies on @p side of this one. */
std::unique_ptr<HaloChannel> make_message_channel(MPI_Comm communicator,
                                                  const int neighbour,
                                                  const Halo::Side side,
                                                  const std::size_t capacity);

/**
 * Memory that the ranks of a node share: each has a segment with a mailbox for either
 * side. A message is then two copies, without a call to the system or waiting for the
 * other rank to help. Construction and destruction are collective, but for that by an
 * exception, which the other ranks may not have: it leaves the memory to the end of MPI.
 */
class SharedSegments
{
public:
  /** Room for messages of @p capacity numbers. */
  SharedSegments(MPI_Comm communicator, const std::size_t capacity);
  ~SharedSegments();

  SharedSegments(const SharedSegments &) = delete;

  /** Whether rank @p neighbour is on this node. */
  bool reaches(const int neighbour) const;

  /** To rank @p neighbour, which reaches() and lies on @p side. */
  std::unique_ptr<HaloChannel> channel(const int neighbour, const Halo::Side side);

private:
  int rank_on_node(const int rank) const;
  char *segment(const int rank) const;

  MPI_Comm communicator;
  MPI_Comm node;
  MPI_Win window;
  const std::size_t capacity;
  const int pending_exceptions;
};
} // namespace mesoslip

#endif
