#include "grid/halo_channel.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <new>
#include <sched.h>

namespace mesoslip
{
namespace
{
constexpr std::size_t cache_line = 64, n_slots = 2;

using Counter = std::atomic<std::uint64_t>;
static_assert(Counter::is_always_lock_free, "counters are shared by processes");

/** Messages from the rank that owns it to one neighbour: counters, each on a cache line
 * of its own, and room for two messages. */
class Mailbox
{
public:
  explicit Mailbox(char *memory, const std::size_t capacity)
    : memory(memory)
    , capacity(capacity)
  {
  }

  static std::size_t bytes(const std::size_t capacity)
  {
    return 2 * cache_line + n_slots * padded(capacity);
  }

  void initialize()
  {
    new (memory) Counter(0);
    new (memory + cache_line) Counter(0);
  }

  Counter &written() const
  {
    return *std::launder(reinterpret_cast<Counter *>(memory));
  }

  Counter &read() const
  {
    return *std::launder(reinterpret_cast<Counter *>(memory + cache_line));
  }

  /** Room of message number @p n. */
  double *slot(const std::uint64_t n) const
  {
    return reinterpret_cast<double *>(memory + 2 * cache_line +
                                      n % n_slots * padded(capacity));
  }

private:
  static std::size_t padded(const std::size_t capacity)
  {
    return (capacity * sizeof(double) + cache_line - 1) / cache_line * cache_line;
  }

  char *memory;
  std::size_t capacity;
};

/** Spins for some microseconds, then lets others run: there may be more ranks than cores.
 */
template <typename Condition>
void wait_until(const Condition &condition)
{
  for (unsigned int tries = 0; !condition(); ++tries)
    if (tries < 2000)
      __builtin_ia32_pause();
    else
      sched_yield();
}

class SharedChannel : public HaloChannel
{
public:
  SharedChannel(const Mailbox &out, const Mailbox &in)
    : out(out)
    , in(in)
  {
  }

  double *room() override
  {
    wait_until(
      [&]() { return n_sent - out.read().load(std::memory_order_acquire) < n_slots; });
    return out.slot(n_sent);
  }

  void send(const std::size_t) override
  {
    out.written().store(++n_sent, std::memory_order_release);
  }

  const double *receive() override
  {
    wait_until(
      [&]() { return in.written().load(std::memory_order_acquire) > n_received; });
    return in.slot(n_received);
  }

  void release() override
  {
    in.read().store(++n_received, std::memory_order_release);
  }

private:
  const Mailbox out, in;
  std::uint64_t n_sent = 0, n_received = 0;
};
} // namespace

SharedSegments::SharedSegments(MPI_Comm communicator, const std::size_t capacity)
  : communicator(communicator)
  , capacity(capacity)
  , pending_exceptions(std::uncaught_exceptions())
{
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
  char *own = nullptr;
  MPI_Win_allocate_shared(
    static_cast<MPI_Aint>(2 * Mailbox::bytes(capacity) + cache_line), 1, MPI_INFO_NULL,
    node, &own, &window);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window);
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  for (const std::size_t side : {0, 1})
    Mailbox(segment(rank) + side * Mailbox::bytes(capacity), capacity).initialize();
  MPI_Win_sync(window);
  MPI_Barrier(node);
}

SharedSegments::~SharedSegments()
{
  if (std::uncaught_exceptions() > pending_exceptions)
    return;
  MPI_Win_unlock_all(window);
  MPI_Win_free(&window);
  MPI_Comm_free(&node);
}

int SharedSegments::rank_on_node(const int rank) const
{
  MPI_Group all, here;
  MPI_Comm_group(communicator, &all);
  MPI_Comm_group(node, &here);
  int result = MPI_UNDEFINED;
  MPI_Group_translate_ranks(all, 1, &rank, here, &result);
  MPI_Group_free(&all);
  MPI_Group_free(&here);
  return result;
}

bool SharedSegments::reaches(const int neighbour) const
{
  return rank_on_node(neighbour) != MPI_UNDEFINED;
}

/** Where the mailboxes of a rank start, on a cache line. */
char *SharedSegments::segment(const int rank) const
{
  MPI_Aint size    = 0;
  int displacement = 0;
  char *start      = nullptr;
  MPI_Win_shared_query(window, rank_on_node(rank), &size, &displacement, &start);
  void *aligned     = start;
  std::size_t space = static_cast<std::size_t>(size);
  return static_cast<char *>(
    std::align(cache_line, 2 * Mailbox::bytes(capacity), aligned, space));
}

std::unique_ptr<HaloChannel> SharedSegments::channel(const int neighbour,
                                                     const Halo::Side side)
{
  int rank = 0;
  MPI_Comm_rank(communicator, &rank);
  // What goes up leaves by the upper mailbox of one and comes from below for the other.
  const std::size_t bytes = Mailbox::bytes(capacity);
  const std::size_t out = side == Halo::upper ? bytes : 0, in = bytes - out;
  return std::make_unique<SharedChannel>(Mailbox(segment(rank) + out, capacity),
                                         Mailbox(segment(neighbour) + in, capacity));
}
} // namespace mesoslip
