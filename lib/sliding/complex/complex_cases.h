#ifndef mesoslip_sliding_complex_complex_cases_h
#define mesoslip_sliding_complex_complex_cases_h

#include "base/serialize_members.h"
#include "eigenvalues/complex/complex_modes.h"
#include "eigenvalues/free_dofs.h"
#include "program/run_context.h"
#include "sliding/complex/contact_parts.h"
#include "sliding/complex/sliding_state.h"
#include "sliding/contact_parameters.h"

#include <complex>
#include <functional>
#include <vector>

namespace mesoslip
{
/** Results of a mode without its shape. */
struct ModeNumbers
{
  double frequency          = 0.; ///< Hz
  double growth_rate        = 0.; ///< 1/s
  double residual           = 0.; ///< relative residual of the eigenpair
  double growth_by_friction = 0.; ///< contribution of friction at all nodes (1/s)
  double growth_by_damping  = 0.; ///< contribution of damping (1/s)
  std::vector<PartOfMode> parts;  ///< per phase of the contact; empty: one phase

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<6>(archive, *this);
  }
};

/** Modes for one value of the swept parameter. */
struct ComplexCase
{
  double value               = 0.;   ///< value of the swept parameter; 0 without a sweep
  double delta               = 0.;   ///< regularization time (s)
  std::uint64_t n_sliding    = 0;    ///< number of sliding contact nodes
  std::uint64_t n_separated  = 0;    ///< number of contact nodes without contact
  std::int64_t n_missing     = 0;    ///< ComplexModes::n_missing
  double fastest_counted     = 0.;   ///< ComplexModes::fastest_counted (1/s)
  bool all_counted           = true; ///< whether all growing vibrations were counted
  double nothing_grows_above = 0.;   ///< Hz
  double steepest_fall       = 0.;   ///< SlidingState::steepest_fall (Pa s/m)
  std::vector<ModeNumbers> modes;    ///< fastest growing first
  std::vector<std::vector<std::complex<float>>> samples; ///< mode shapes, of equal length

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<11>(archive, *this);
  }
};

/** Results of a complex-modes analysis. */
template <int dim>
struct ComplexCases
{
  SlidingState state;              ///< static state of the first case
  ComplexModes modes;              ///< modes of the first case, on rank 0
  std::vector<FreeDofs<dim>> dofs; ///< free dofs of the first case: one entry
  ComplexCase base;                ///< mode numbers of the first case, on rank 0
  std::vector<ComplexCase> sweep;  ///< cases of the sweep, on rank 0
  ContactParts parts;              ///< phases of the contact
  double shear_impedance   = 0.;   ///< BodyScales::shear_impedance (Pa s/m)
  double highest_frequency = 0.;   ///< upper end of the search (Hz)
};

/** Computes the static sliding state for parameters changed by a sweep; the coefficients
 * of all nodes are multiplied by @p friction_factor. Collective. */
using StateAtRest =
  std::function<SlidingState(const ContactParameters &, const double friction_factor)>;

/** Highest requested frequency (Hz); @p wave_speed (m/s) and @p height (m) are the
 * body's. */
double highest_frequency_of(const ContactParameters &parameters,
                            const double wave_speed,
                            const double height);

/** Memory per rank (bytes) for the modes of a body of @p n_dofs degrees of freedom. */
double complex_modes_memory(const double n_dofs, const unsigned int dim);

/**
 * Modes for the given parameters and for each value of the sweep. Each case is computed
 * by one rank, with the contact @p parts and @p damping by phase. Warns if friction
 * falls with the slip rate by more than @p shear_impedance, see BodyScales. Collective.
 * @throws NumericalFailure
 */
template <int dim>
ComplexCases<dim> compute_complex_modes(const ElasticBody<dim> &body,
                                        const ContactParameters &parameters,
                                        const double highest_frequency,
                                        const StateAtRest &at_rest,
                                        const ContactParts &parts,
                                        const double shear_impedance,
                                        const DampingByPhase &damping,
                                        RunContext &context);

} // namespace mesoslip

#endif
