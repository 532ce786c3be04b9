#ifndef mesoslip_sliding_analyses_modal_h
#define mesoslip_sliding_analyses_modal_h

#include "sliding/body_analysis.h"

#include <memory>

namespace mesoslip
{
/** Analysis "modal": frequencies and shapes in modes.csv, modal.h5 and modal.xdmf. */
template <int dim>
class ModalAnalysis : public BodyAnalysis<dim>
{
public:
  /** @throws UserError if the body has fewer modes than Modal/Number of modes. */
  explicit ModalAnalysis(std::unique_ptr<GivenBody<dim>> given);

  void run(RunContext &context) override;

private:
  using BodyAnalysis<dim>::body;
  using BodyAnalysis<dim>::parameters;
};
} // namespace mesoslip

#endif
