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
/** One of the paper's boundary conditions and the modes under it. */
template <int dim>
struct ModalCase
{
  std::string bottom;        ///< "free" (BC1) or "held" (BC2: along the normal)
  VibrationModes<dim> modes; ///< lowest first
};

/** Those that are asked for: "free", "held". */
std::vector<std::string> modal_bottoms(const ContactParameters &parameters);

/** The top of the transient run as long as it is loaded. */
TopSetup top_at_start(const ContactParameters &parameters);

/** @throws UserError naming the key if that many free degrees of freedom have not the
 * modes that are wanted */
void require_modes(const std::size_t n_free, const ContactParameters &parameters);

/** The modes of a bottom that is held or not. */
template <int dim>
using ModesOfBottom = std::function<VibrationModes<dim>(const bool bottom_held,
                                                        const VibrationModesOptions &)>;

/** The modes for each bottom, as @p find has them, and under @p platens; with lines for the log. Collective. @throws NumericalFailure */
template <int dim>
std::vector<ModalCase<dim>> compute_modes(const ModesOfBottom<dim> &find,
                                          const std::vector<Platen> &platens,
                                          const ContactParameters &parameters,
                                          RunContext &context);

/** On rank 0: modes.csv, and the keys of summary.json that are about the modes. */
template <int dim>
void write_modes(const std::vector<ModalCase<dim>> &cases, RunContext &context);

/** Writes /modes without the shapes. */
template <int dim>
void write_frequencies(Hdf5File &file, const std::vector<ModalCase<dim>> &cases);

} // namespace mesoslip

#endif
