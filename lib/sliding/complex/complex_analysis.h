#ifndef mesoslip_sliding_complex_complex_analysis_h
#define mesoslip_sliding_complex_complex_analysis_h

#include "sliding/body_analysis.h"
#include "sliding/complex/complex_output.h"
#include "sliding/complex/sliding_state.h"

#include <memory>
#include <optional>
#include <string>

namespace mesoslip
{
/** Analysis "complex modes": complex_modes.csv, complex_modes.h5 and complex_modes.xdmf. */
template <int dim>
class ComplexModesAnalysis : public BodyAnalysis<dim>
{
public:
  /** @throws UserError if there is no steady sliding state */
  explicit ComplexModesAnalysis(std::unique_ptr<GivenBody<dim>> given);

  void run(RunContext &context) override;

private:
  using BodyAnalysis<dim>::body;
  using BodyAnalysis<dim>::facts;
  using BodyAnalysis<dim>::parameters;

  /** Whether the static state follows from a load; else the top is held, see
   * sliding_state(). */
  bool is_pressed() const;

  DampingByPhase damping(const MPI_Comm communicator) const;

  /** Static sliding state, see StateAtRest. */
  SlidingState at_rest(const ContactParameters &of_case,
                       const double friction_factor,
                       RunContext &context) const;

  void write_shapes(std::optional<Hdf5File> &file,
                    const std::string &path,
                    const ComplexShapes &shapes,
                    RunContext &context) const;
};
} // namespace mesoslip

#endif
