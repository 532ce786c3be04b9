#ifndef mesoslip_localization_localization_needs_h
#define mesoslip_localization_localization_needs_h

#include "localization/localization_input.h"

namespace mesoslip
{
/** Peak memory per rank of a localization (bytes). */
struct RankMemory
{
  double root;  ///< rank 0, which has the meshes
  double other; ///< each other rank; 0 without any
};

/**
 * Memory estimate from the numbers of cells and points, their data, and the libraries.
 * Rank 0 has all meshes; all other data are divided among the ranks.
 */
template <int dim>
RankMemory memory_need(const LocalizationInput<dim> &input, const unsigned int n_ranks);

/** Disk space of localization.h5. */
template <int dim>
ResourceNeed disk_need(const LocalizationInput<dim> &input);
} // namespace mesoslip

#endif
