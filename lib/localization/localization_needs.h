#ifndef mesoslip_localization_localization_needs_h
#define mesoslip_localization_localization_needs_h

#include "localization/localization_input.h"

namespace mesoslip
{
/** Most memory at a time of the ranks of a localization (bytes). */
struct RankMemory
{
  double root;  ///< of rank 0, which has the meshes
  double other; ///< of each other rank; 0 without any
};

/**
 * From the numbers of cells and points, of what is kept of each, and of the libraries. Rank
 * 0 has all meshes; of the rest, and of grids everything, each rank has its share.
 */
template <int dim>
RankMemory memory_need(const LocalizationInput<dim> &input, const unsigned int n_ranks);

/** What localization.h5 takes. */
template <int dim>
ResourceNeed disk_need(const LocalizationInput<dim> &input);
} // namespace mesoslip

#endif
