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

/** Displacements of a body at some steps, in a file that all ranks that share the body write as the run goes on. */
template <int dim>
class Snapshots : public StepObserver
{
public:
  /** Of the @p body, of whose rows @p displacement returns those of a rank, before these @p steps of length @p dt (s). The @p
   * timer gets the time of writing; references are kept. */
  Snapshots(const GivenBody<dim> &body,
            const std::function<FieldRows()> &displacement,
            const std::vector<std::uint64_t> &steps,
            const double dt,
            Timer &timer);

  /** Whether there are some. */
  bool are_wanted() const
  {
    return !steps.empty();
  }

  /** How many were written so far. */
  std::uint64_t n_written() const
  {
    return written;
  }

  /** On one rank: the @p file at @p path of a run that is continued after @p n_done of them. @throws UserError if it has not as
   * many */
  static Hdf5File continued(const std::string &path, const std::uint64_t n_done);

  /** On one rank: makes place in the @p file for all of them. */
  void reserve(Hdf5File &file) const;

  /** Begins to write into the file at @p path, which the rank that reserved has left, after @p n_done of them. Collective over
   * the @p communicator. */
  void
  open(const std::string &path, const std::uint64_t n_done, const MPI_Comm communicator);

  /** The first step >= @p n before which one is taken. */
  std::uint64_t next_step(const std::uint64_t n) const override;

  /** Writes one. Collective. */
  void before_step(const std::uint64_t n) override;

  /** Waits until they are on the disk. Collective. */
  void sync();

  /** There are no more. Collective. */
  void close();

  /** On one rank, after close(): writes their times (s). */
  void complete(Hdf5File &file) const;

  /** On one rank: lets ParaView show what is in the file at @p path. */
  void show(const std::string &path) const;

private:
  Shape shape(const std::size_t n) const;
  std::vector<double> times() const;

  const GivenBody<dim> &body;
  const std::function<FieldRows()> displacement;
  const std::vector<std::uint64_t> steps; ///< of all of them, those to come as well
  const double dt;
  Timer &timer;
  std::uint64_t written = 0;
  std::unique_ptr<ParallelRows> rows; ///< between open() and close()
};
} // namespace mesoslip

#endif
