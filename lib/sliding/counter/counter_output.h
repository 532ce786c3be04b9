#ifndef mesoslip_sliding_counter_counter_output_h
#define mesoslip_sliding_counter_counter_output_h

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
/** counter_body.h5 and .xdmf: snapshots of the second body at the times of those of the first one. Rank 0 alone has it. */
template <int dim>
class CounterOutput : public StepObserver
{
public:
  /** Of the @p body, whose rows @p displacement returns, before these @p steps of length @p dt (s); all but @p dt are kept or
   * referred to. */
  CounterOutput(const std::string &path,
                const GivenBody<dim> &body,
                const std::function<FieldRows()> &displacement,
                const std::vector<std::uint64_t> &steps,
                const double dt);

  /** Makes place for snapshots, of which the first @p n_done are in the file of the run that is continued. @throws UserError
   * if they are not */
  void begin(const std::uint64_t n_done);

  /** The first step >= @p n before which a snapshot is taken. */
  std::uint64_t next_step(const std::uint64_t n) const override;

  /** Writes a snapshot. */
  void before_step(const std::uint64_t n) override;

  /** Waits until the snapshots are on the disk. */
  void sync();

  /** Completes the file. */
  void end();

private:
  Shape shape(const std::size_t n) const;

  const std::string path;
  const GivenBody<dim> &body;
  const std::function<FieldRows()> displacement;
  const std::vector<std::uint64_t> steps;
  const double dt;
  std::uint64_t n_written = 0;
  std::unique_ptr<ParallelRows> rows; ///< between begin() and end()
};
} // namespace mesoslip

#endif
