#ifndef mesoslip_localization_probe_series_h
#define mesoslip_localization_probe_series_h

#include "localization/localization_program.h"
#include "localization/snapshot_pass.h"

#include <vector>

namespace mesoslip
{
/** Input for the stresses of probes. */
template <int dim>
struct ProbeHistories
{
  SnapshotHistories homogeneous;          ///< strains of the run that is localized
  SnapshotHistories direct;               ///< strains of the direct run
  std::vector<VoigtMatrix<dim>> matrices; ///< C L (Pa) in the cell of each probe
  std::vector<VoigtVector<dim>> thermal;  ///< thermal stress there (Pa)
};

/**
 * Computes the probes of all variants of @p result, and its window, from the records of
 * @p input and the histories; adds to the warnings of the input. On rank 0.
 */
template <int dim>
void evaluate_probes(LocalizationInput<dim> &input,
                     const ProbeHistories<dim> &histories,
                     LocalizationResult &result);

/** Adds a note on the difference between the mean normal stresses of recorded probes and
 * of their cells, @p of_field; both are averaged over different samples. */
template <int dim>
void note_sampling(LocalizationInput<dim> &input,
                   const VariantResult &variant,
                   const std::vector<double> &of_field);
} // namespace mesoslip

#endif
