#ifndef mesoslip_sliding_transient_snapshots_h
#define mesoslip_sliding_transient_snapshots_h

#include "dynamics/stepper.h"
#include "io/parallel_rows.h"
#include "sliding/given_body.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
class Timer;

/** Displacements of a body at some steps, written during the run by all ranks that share
 * the body. */
template <int dim>
class Snapshots : public StepObserver
{
public:
  /** @p displacement returns the rows of @p body on a rank. Snapshots are taken before
   * @p steps of length @p dt (s). The @p timer gets the time of writing; references are
   * kept. */
  Snapshots(const GivenBody<dim> &body,
            const std::function<FieldRows()> &displacement,
            const std::vector<std::uint64_t> &steps,
            const double dt,
            Timer &timer);

  /** Whether there are any. */
  bool are_wanted() const
  {
    return !steps.empty();
  }

  /** Number of snapshots written so far. */
  std::uint64_t n_written() const
  {
    return written;
  }

  /** On one rank: the file at @p path of a run that is continued after @p n_done
   * snapshots.
   * @throws UserError if the file has fewer */
  static Hdf5File continued(const std::string &path, const std::uint64_t n_done);

  /** On one rank: reserves space in @p file for all snapshots. */
  void reserve(Hdf5File &file) const;

  /** Opens the file at @p path for writing after @p n_done snapshots; the rank that
   * reserved has closed it. Collective over the @p communicator. */
  void
  open(const std::string &path, const std::uint64_t n_done, const MPI_Comm communicator);

  /** First step >= @p n before which a snapshot is taken. */
  std::uint64_t next_step(const std::uint64_t n) const override;

  /** Writes a snapshot. Collective. */
  void before_step(const std::uint64_t n) override;

  /** Waits until the snapshots are on the disk. Collective. */
  void sync();

  /** Ends the snapshots. Collective. */
  void close();

  /** On one rank, after close(): writes the snapshot times (s). */
  void complete(Hdf5File &file) const;

  /** On one rank: writes the XDMF file for the file at @p path. */
  void show(const std::string &path) const;

private:
  Shape shape(const std::size_t n) const;
  std::vector<double> times() const;

  const GivenBody<dim> &body;
  const std::function<FieldRows()> displacement;
  const std::vector<std::uint64_t> steps; ///< steps of all snapshots, past and future
  const double dt;
  Timer &timer;
  std::uint64_t written = 0;
  std::unique_ptr<ParallelRows> rows; ///< between open() and close()
};
} // namespace mesoslip

#endif
