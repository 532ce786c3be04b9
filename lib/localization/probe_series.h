#ifndef mesoslip_localization_probe_series_h
#define mesoslip_localization_probe_series_h

#include "localization/localization_program.h"
#include "localization/snapshot_pass.h"

#include <vector>

namespace mesoslip
{
/** What the stresses of probes follow from. */
template <int dim>
struct ProbeHistories
{
  SnapshotHistories homogeneous;          ///< of the run whose strains are localized
  SnapshotHistories direct;               ///< of the run to compare with
  std::vector<VoigtMatrix<dim>> matrices; ///< C L (Pa) in the cell of each probe
  std::vector<VoigtVector<dim>> thermal;  ///< stress of heat there (Pa)
};

/**
 * Sets the probes of the variants of @p result, and its window, from what @p input has recorded and
 * these histories; adds to the warnings of the input. On rank 0.
 */
template <int dim>
void evaluate_probes(LocalizationInput<dim> &input,
                     const ProbeHistories<dim> &histories,
                     LocalizationResult &result);

/** Notes how far apart the mean normal stresses of recorded probes are from those of their cells,
 * @p of_field, which have other samples. */
template <int dim>
void note_sampling(LocalizationInput<dim> &input,
                   const VariantResult &variant,
                   const std::vector<double> &of_field);
} // namespace mesoslip

#endif
