#ifndef mesoslip_sliding_analyses_modal_cases_h
#define mesoslip_sliding_analyses_modal_cases_h

#include "eigenvalues/vibration_modes.h"
#include "io/hdf5_file.h"
#include "program/run_context.h"
#include "sliding/contact_parameters.h"

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Modes under one of the paper's boundary conditions. */
template <int dim>
struct ModalCase
{
  std::string bottom;        ///< "free" (BC1) or "held" (BC2: along the normal)
  VibrationModes<dim> modes; ///< lowest first
};

/** Names of the requested boundary conditions: "free", "held". */
std::vector<std::string> modal_bottoms(const ContactParameters &parameters);

/** The top support of the transient run in its loaded state. */
TopSetup top_at_start(const ContactParameters &parameters);

/** @throws UserError naming the key if @p n_free degrees of freedom have fewer modes than
 * requested */
void require_modes(const std::size_t n_free, const ContactParameters &parameters);

/** Function that computes the modes with the bottom held or free. */
template <int dim>
using ModesOfBottom = std::function<VibrationModes<dim>(const bool bottom_held,
                                                        const VibrationModesOptions &)>;

/** Modes for each bottom condition by @p find, with the motion of @p platens, and lines
 * for the log. Collective.
 * @throws NumericalFailure */
template <int dim>
std::vector<ModalCase<dim>> compute_modes(const ModesOfBottom<dim> &find,
                                          const std::vector<Platen> &platens,
                                          const ContactParameters &parameters,
                                          RunContext &context);

/** On rank 0: writes modes.csv and the modes in summary.json. */
template <int dim>
void write_modes(const std::vector<ModalCase<dim>> &cases, RunContext &context);

/** Writes /modes without mode shapes. */
template <int dim>
void write_frequencies(Hdf5File &file, const std::vector<ModalCase<dim>> &cases);

} // namespace mesoslip

#endif
