#ifndef mesoslip_sliding_analyses_modal_h
#define mesoslip_sliding_analyses_modal_h

#include "sliding/analyses/modal_cases.h"
#include "sliding/body_analysis.h"

namespace mesoslip
{
/**
 * The degrees of freedom that sides, top and bottom hold; a platen's u_y is among them,
 * and modal_options() lets it move.
 */
DofMask modal_constraints(const ContactParameters &parameters,
                          const UniformMaterial &material,
                          const bool bottom_held);

/** Analysis "modal" on a grid: frequencies and shapes in modes.csv, modal.h5 and
 * modal.xdmf. */
class ModalAnalysis : public BodyAnalysis
{
public:
  /** @throws UserError if there are not as many modes as Modal/Number of modes. */
  explicit ModalAnalysis(const ContactParameters &parameters);

  void run(RunContext &context) override;
};
} // namespace mesoslip

#endif
