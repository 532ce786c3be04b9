#ifndef mesoslip_sliding_complex_grid_complex_h
#define mesoslip_sliding_complex_grid_complex_h

#include "sliding/body_analysis.h"

namespace mesoslip
{
/** Analysis "complex modes" on a grid: complex_modes.csv, complex_modes.h5 and
 * complex_modes.xdmf. */
class ComplexModesAnalysis : public BodyAnalysis
{
public:
  /** @throws UserError without steady sliding about which a body could vibrate */
  explicit ComplexModesAnalysis(const ContactParameters &given);

  void run(RunContext &context) override;
};

/** The same of a body on a mesh or a box in 3D. @throws UserError */
std::unique_ptr<Analysis> make_mesh_complex(const ContactParameters &parameters);
} // namespace mesoslip

#endif
