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
/** The numbers of a mode without its shape. */
struct ModeNumbers
{
  double frequency          = 0.; ///< Hz
  double growth_rate        = 0.; ///< 1/s
  double residual           = 0.; ///< relative
  double growth_by_friction = 0.; ///< of all nodes (1/s)
  double growth_by_damping  = 0.; ///< 1/s
  std::vector<PartOfMode> parts;  ///< of each phase of the contact; empty: one phase

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<6>(archive, *this);
  }
};

/** Modes for one value of what is swept. */
struct ComplexCase
{
  double value               = 0.;   ///< in its unit; 0 without a sweep
  double delta               = 0.;   ///< s
  std::uint64_t n_sliding    = 0;    ///< contact nodes that slide
  std::uint64_t n_separated  = 0;    ///< contact nodes that do not touch
  std::int64_t n_missing     = 0;    ///< ComplexModes::n_missing
  double fastest_counted     = 0.;   ///< ComplexModes::fastest_counted (1/s)
  bool all_counted           = true; ///< whether nothing that vibrates grows faster
  double nothing_grows_above = 0.;   ///< Hz
  double steepest_fall       = 0.;   ///< SlidingState::steepest_fall (Pa s/m)
  std::vector<ModeNumbers> modes;    ///< fastest growing first
  std::vector<std::vector<std::complex<float>>> samples; ///< of shapes, of equal length

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<11>(archive, *this);
  }
};

/** All of an analysis. */
template <int dim>
struct ComplexCases
{
  SlidingState state;              ///< of the first case
  ComplexModes modes;              ///< of the first case, on rank 0
  std::vector<FreeDofs<dim>> dofs; ///< of the first case: one
  ComplexCase base;                ///< its numbers, on rank 0
  std::vector<ComplexCase> sweep;  ///< on rank 0
  ContactParts parts;              ///< phases of the contact
  double shear_impedance   = 0.;   ///< BodyScales::shear_impedance (Pa s/m)
  double highest_frequency = 0.;   ///< up to which modes were looked for (Hz)
};

/** Static states for parameters that a sweep may have changed, the coefficients of all nodes
 * times @p friction_factor. Collective. */
using StateAtRest =
  std::function<SlidingState(const ContactParameters &, const double friction_factor)>;

/** Highest frequency (Hz) that is asked for; @p wave_speed (m/s) and @p height (m) are the
 * body's. */
double highest_frequency_of(const ContactParameters &parameters,
                            const double wave_speed,
                            const double height);

/** Bytes of memory that modes of a body of @p n_dofs degrees of freedom need on each rank. */
double complex_modes_memory(const double n_dofs, const unsigned int dim);

/**
 * The modes for the parameters, and for each value of the sweep; each case is computed by one
 * rank, which knows the @p parts of the contact and the @p damping by phase. Warns where friction falls with the slip rate by
 * more than @p shear_impedance, that of BodyScales. Collective. @throws NumericalFailure
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
