#ifndef mesoslip_localization_mesh_mesh_result_h
#define mesoslip_localization_mesh_mesh_result_h

#include "localization/localization_program.h"
#include "localization/mesh/mesh_input.h"
#include "localization/mesh/rank_work.h"

namespace mesoslip
{
/** The result of all ranks, from what each found in its cells, whose fields are used up. */
template <int dim>
LocalizationResult put_together(const MeshLocalizationInput<dim> &input,
                                std::vector<RankResult> &of_ranks);

/** What the results say of @p input, which must outlive it. */
template <int dim>
LocalizationOrigin origin_of(const MeshLocalizationInput<dim> &input);
} // namespace mesoslip

#endif
