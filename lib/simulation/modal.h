#ifndef mesoslip_simulation_modal_h
#define mesoslip_simulation_modal_h

#include "dynamics/vibration_modes.h"
#include "simulation/contact_parameters.h"
#include "simulation/scene.h"

#include <string>
#include <vector>

namespace mesoslip
{
class RunContext;

/** One of the paper's boundary conditions and the modes under it. */
struct ModalCase
{
  std::string bottom;   ///< "free" (BC1) or "held" (BC2: u_y = 0)
  VibrationModes modes; ///< lowest first
};

/**
 * The degrees of freedom that sides, top and bottom hold; a platen's u_y is among them,
 * and modal_options() lets it move.
 */
DofMask modal_constraints(const ContactParameters &parameters,
                          const UniformMaterial &material,
                          const bool bottom_held);

/** Number of modes, tolerance, solver, and the platen if the run has one at its start. */
VibrationModesOptions modal_options(const ContactParameters &parameters);

/** @throws UserError if there are not as many modes as Modal/Number of modes. */
void check_modal(const ContactParameters &parameters, const Scene &scene);

/** Modes under the boundary conditions that section Modal asks for. */
std::vector<ModalCase> compute_modes(const ContactParameters &parameters,
                                     const Scene &scene,
                                     RunContext &context);

/**
 * Whether the body is that of the paper's figure 8: 56 x 16 mm, a top that is held or
 * under a platen without mass, sides free, the stiffness of eq. (10) (homogeneous) or the
 * phases of table 1 (heterogeneous), to 5 %.
 */
bool is_paper_body(const ContactParameters &parameters, const Scene &scene);

/** Analysis "modal": frequencies and shapes in modes.csv, modal.h5 and modal.xdmf. */
void run_modal(const ContactParameters &parameters,
               const Scene &scene,
               RunContext &context);
} // namespace mesoslip

#endif
