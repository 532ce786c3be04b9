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
 * Reads the snapshots of a range in batches; a thread reads the next batch while the
 * caller works on the current one. Only one thread may use HDF5: between the first and
 * the last next() nothing else may read.
 */
template <typename Snapshots>
class ReadAhead
{
public:
  /** @p reader reads the snapshots of a range; @p most: size of a batch. */
  ReadAhead(const IndexRange &range,
            const std::size_t most,
            std::function<Snapshots(const IndexRange &)> reader)
    : rest(range)
    , n_most(most)
    , read(std::move(reader))
  {
  }

  /** The number of snapshots that next() returns; 0 after the last one. */
  std::size_t n_next() const
  {
    return std::min(rest.count, n_most);
  }

  /** The next snapshots; n_next() has to be positive.
   * @throws any exception of the reader */
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

  IndexRange rest;    ///< snapshots not yet returned by next()
  std::size_t n_most; ///< snapshots per batch
  std::function<Snapshots(const IndexRange &)> read; ///< the reader
  std::future<Snapshots> waiting;                    ///< batch being read, if any
};
} // namespace mesoslip

#endif
