#ifndef mesoslip_localization_strain_read_ahead_h
#define mesoslip_localization_strain_read_ahead_h

#include "exchange/time_window.h"

#include <algorithm>
#include <functional>
#include <future>
#include <utility>

namespace mesoslip
{
/**
 * Reads the snapshots of a range some at a time, the next ones in a thread of its own while the
 * caller treats those at hand. HDF5 is used by one thread at a time: from the first next() to the
 * last one nobody else may read.
 */
template <typename Snapshots>
class ReadAhead
{
public:
  /** @p reader reads some snapshots; @p most of them at a time. */
  ReadAhead(const IndexRange &range,
            const std::size_t most,
            std::function<Snapshots(const IndexRange &)> reader)
    : rest(range)
    , n_most(most)
    , read(std::move(reader))
  {
  }

  /** The number of snapshots that next() returns; 0 behind the last one. */
  std::size_t n_next() const
  {
    return std::min(rest.count, n_most);
  }

  /** The next snapshots, of which there is one at least. @throws what reading throws */
  Snapshots next()
  {
    if (!waiting.valid())
      start();
    Snapshots now       = waiting.get();
    const std::size_t n = n_next();
    rest.first += n;
    rest.count -= n;
    if (rest.count > 0)
      start();
    return now;
  }

private:
  void start()
  {
    waiting = std::async(std::launch::async, read, IndexRange{rest.first, n_next()});
  }

  IndexRange rest;    ///< those that next() has not returned
  std::size_t n_most; ///< at a time
  std::function<Snapshots(const IndexRange &)> read; ///< the reader
  std::future<Snapshots> waiting; ///< those that are being read, if any
};
} // namespace mesoslip

#endif
