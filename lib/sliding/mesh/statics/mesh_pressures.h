#ifndef mesoslip_sliding_mesh_statics_mesh_pressures_h
#define mesoslip_sliding_mesh_statics_mesh_pressures_h

#include "body/mesh/mesh_body.h"
#include "morphology/mesh_morphology.h"
#include "sliding/analyses/phase_pressures.h"

namespace mesoslip
{
/**
 * Pressures of the phases at the contact boundary: mean of minus the normal stress in the
 * cells behind it, weighted with the areas of their faces as seen along the normal of the
 * flat. @p u is the displacement of @p elastic, @p normal_force (N, in 2D N/m) that of the
 * flat. Rank 0 has the @p morphology and gets the pressures. Collective.
 */
template <int dim>
PhasePressures mesh_phase_pressures(const MeshMorphology<dim> &morphology,
                                    const ContactParameters &parameters,
                                    const MeshBody<dim> &elastic,
                                    const NodalField<double> &u,
                                    const double normal_force);
} // namespace mesoslip

#endif
