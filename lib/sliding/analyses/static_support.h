#ifndef mesoslip_sliding_analyses_static_support_h
#define mesoslip_sliding_analyses_static_support_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "sliding/contact_parameters.h"

#include <functional>
#include <string>

namespace mesoslip
{
class RunContext;

/** What sides and top hold, of a platen u_x and u_y. */
DofMask held_by_supports(const UniformMaterial &material,
                         const SideConstraints &sides,
                         const TopSetup &top);

/**
 * To be called between the solves of the static analyses, which leave nothing behind when
 * stopped. @throws Interrupted
 */
std::function<void(unsigned int)> stop_or_report(RunContext &context,
                                                 const std::string &activity);

/** Runs @p action. @throws NumericalFailure instead of NotConverged, with @p advice. */
void with_advice(const std::string &advice, const std::function<void()> &action);
} // namespace mesoslip

#endif
