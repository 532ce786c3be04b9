#include "sliding/complex/complex_cases.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "eigenvalues/complex/sliding_pencil.h"
#include "material/plausibility.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/body_analysis.h"
#include "sliding/friction/rate_weakening.h"

#include <boost/serialization/complex.hpp>

#include <cmath>
#include <exception>

namespace mesoslip
{
namespace
{
/** A sample of a shape to compare shapes with, independent of the free nodes: some
 * thousand of the body's displacements, multiplied by the root of their mass,
 * normalized. */
template <int dim>
std::vector<std::complex<float>> sample(const ElasticBody<dim> &body,
                                        const FreeDofs<dim> &dofs,
                                        const std::vector<double> &mass,
                                        const ComplexVector &shape)
{
  constexpr std::size_t most          = 2000; // nodes
  typename FreeDofs<dim>::Vector real = dofs.zero(), imaginary = dofs.zero();
  for (std::size_t k = 0; k < dofs.size(); ++k)
    {
      real[k]      = shape[static_cast<Eigen::Index>(k)].real();
      imaginary[k] = shape[static_cast<Eigen::Index>(k)].imag();
    }
  NodalField<double> re = body.zero_field();
  NodalField<double> im = re;
  dofs.scatter(re, real);
  dofs.scatter(im, imaginary);
  std::vector<std::complex<float>> result;
  double size = 0.;
  for (std::size_t k = 0; k < mass.size(); k += 1 + mass.size() / most)
    for (unsigned int c = 0; c < dim; ++c)
      {
        const NodeIndex node{static_cast<unsigned int>(k % body.n_columns()),
                             static_cast<unsigned int>(k / body.n_columns())};
        const std::complex<double> x =
          std::sqrt(mass[k]) * std::complex<double>(re(c, node), im(c, node));
        size += std::norm(x);
        result.emplace_back(x);
      }
  for (std::complex<float> &x : result)
    x /= static_cast<float>(std::sqrt(size));
  return result;
}

ComplexCase numbers_of(const SlidingPencil &pencil,
                       const SlidingState &state,
                       const ContactParts &parts,
                       const ComplexModes &found)
{
  ComplexCase result;
  result.delta               = pencil.law.delta;
  result.n_sliding           = state.contact.nodes.size();
  result.n_separated         = state.n_separated;
  result.n_missing           = found.n_missing;
  result.fastest_counted     = found.fastest_counted;
  result.steepest_fall       = state.steepest_fall;
  result.nothing_grows_above = found.nothing_grows_above / (2. * M_PI);
  for (const ComplexMode &mode : found.modes)
    result.modes.push_back({mode.frequency(), mode.s.real(), mode.residual,
                            mode.growth_by_friction.sum(), mode.growth_by_damping,
                            parts.of_mode(mode, state)});
  return result;
}

/** Warns if friction falls with the slip rate by more than waves radiate. */
void warn_of_weakening(const RateWeakening &friction,
                       const std::string &place,
                       RunContext &context)
{
  if (!friction.is_too_steep())
    return;
  const double growth = friction.fastest_growth();
  context.warn(
    "Friction " + friction.text("in the static state" + place) + ": " +
    (std::isfinite(growth)
       ? "motion that does not vibrate grows as well, by up to " +
           quantity_text(growth, "1/s") + ", and need not be among the modes listed"
       : std::string("short vibrations and motion that does not vibrate grow without a "
                     "limit as cells become smaller, and are not among the modes "
                     "listed; use a regularization (Friction/Law)")));
}

/** Factor of the coefficients at a value of the sweep; coefficients by phase are all
 * scaled. */
double friction_factor(const ContactParameters &parameters, const double value)
{
  return parameters.complex_modes.sweep == ModeSweep::coefficient &&
             parameters.friction.coefficient_by_phase
           ? value
           : 1.;
}

/** Throws on all ranks if one rank has thrown. Collective. */
void agree(const std::exception_ptr &problem,
           const bool interrupted,
           const MPI_Comm communicator)
{
  const int own   = problem == nullptr ? 0 : (interrupted ? 2 : 1);
  const int worst = mpi::max(own, communicator);
  if (problem != nullptr)
    std::rethrow_exception(problem);
  if (worst == 2)
    throw Interrupted("stopped on request in the search for complex modes; there is no "
                      "result yet");
  if (worst == 1)
    throw NumericalFailure("another process could not compute its complex modes");
}
} // namespace

double highest_frequency_of(const ContactParameters &parameters,
                            const double wave_speed,
                            const double height)
{
  const double given = parameters.complex_modes.highest_frequency;
  return std::isnan(given) ? wave_speed / height : given;
}

double complex_modes_memory(const double n_dofs, const unsigned int dim)
{
  // As measured: complex factors with METIS' ordering, matrices, and Arnoldi vectors.
  const double factors =
    dim == 2 ? 42. * n_dofs * std::log2(n_dofs) : 26. * std::pow(n_dofs, 4. / 3.);
  const double vectors = 110. * 2.1 * n_dofs;
  return 16. * (factors + vectors) + 600. * n_dofs;
}

template <int dim>
ComplexCases<dim> compute_complex_modes(const ElasticBody<dim> &body,
                                        const ContactParameters &parameters,
                                        const double highest_frequency,
                                        const StateAtRest &at_rest,
                                        const ContactParts &parts,
                                        const double shear_impedance,
                                        const DampingByPhase &damping,
                                        RunContext &context)
{
  const MPI_Comm communicator        = context.communicator();
  const ComplexModesParameters &keys = parameters.complex_modes;
  if (!(keys.lowest_frequency < highest_frequency))
    throw UserError("Complex modes/Lowest frequency is not below the highest, " +
                    to_text(highest_frequency) + " Hz; reduce it");
  const RealMatrix all = whole_stiffness(body, communicator);

  ComplexModesOptions options;
  options.lowest_frequency     = keys.lowest_frequency;
  options.highest_frequency    = highest_frequency;
  options.least_growth         = keys.least_growth;
  options.tolerance            = keys.tolerance;
  options.count                = keys.count;
  options.timer                = &context.timer();
  const char *shown            = "";
  options.before_factorization = [&](const char *activity, const double share) {
    constexpr std::uint64_t whole = 100;
    if (context.root() && shown != activity)
      context.progress().start(shown = activity, whole);
    if (context.root())
      context.progress().update(1 + static_cast<std::uint64_t>(share * (whole - 1)));
    if (context.stop_requested_here())
      throw Interrupted("stopped on request in the search for complex modes; there is no "
                        "result yet");
  };

  constexpr std::size_t fewest_unknowns = 40; // least size that the iterations support
  ComplexCases<dim> result;
  result.highest_frequency  = highest_frequency;
  result.parts              = parts;
  result.shear_impedance    = shear_impedance;
  const std::size_t n_cases = 1 + keys.values.size();
  const auto n_ranks        = static_cast<std::size_t>(context.n_ranks());
  std::vector<ContactParameters> parameters_of;
  std::vector<SlidingState> states;
  std::vector<FreeDofs<dim>> free; // masses are collective
  for (std::size_t k = 0; k < n_cases; ++k)
    {
      parameters_of.push_back(k == 0 ? parameters
                                     : with_swept(parameters, keys.values[k - 1]));
      const auto scope = context.timer().scope("Static state");
      states.push_back(
        at_rest(parameters_of.back(),
                k == 0 ? 1. : friction_factor(parameters, keys.values[k - 1])));
      free.emplace_back(body, states.back().held, states.back().platens);
      if (free.back().size() < fewest_unknowns)
        throw UserError("Analysis: complex modes are sought among " +
                        std::to_string(fewest_unknowns) +
                        " free degrees of freedom or more, and the body has " +
                        std::to_string(free.back().size()) + "; take more cells");
      if (context.root())
        warn_of_weakening(
          {states.back().steepest_fall, shear_impedance,
           sliding_law(parameters_of.back()).delta, parameters.step.least_beta(),
           parameters.contact.tangential_stiffness},
          k == 0 ? "" : brief_text(6, " at ", keys.values[k - 1]), context);
    }
  result.state = states[0];
  result.dofs.push_back(free[0]);
  const std::vector<double> mass = body.lumped_mass();
  std::vector<ComplexCase> cases(n_cases);
  std::exception_ptr problem;
  bool interrupted = false;
  for (auto k = static_cast<std::size_t>(context.rank());
       k < n_cases && problem == nullptr; k += n_ranks)
    {
      const ContactParameters &of_case = parameters_of[k];
      const SlidingState &state        = states[k];
      try
        {
          const FreeDofs<dim> &dofs = free[k];
          SlidingLaw law            = sliding_law(of_case);
          law.state_time            = state.state_time;
          const SlidingPencil pencil =
            make_sliding_pencil<dim>(body, all, dofs, state.contact, law, damping);
          const RateWeakening weakening{state.steepest_fall, shear_impedance, law.delta,
                                        law.beta, of_case.contact.tangential_stiffness};
          options.steep = weakening.is_too_steep();
          ComplexModes found =
            find_complex_modes(pencil, friction_radius(pencil), options);
          cases[k] = numbers_of(pencil, state, parts, found);
          cases[k].all_counted =
            std::isfinite(pencil.largest_response()) &&
            (!options.steep || weakening.fastest_growth() <= found.fastest_counted);
          if (k == 0)
            {
              result.modes = std::move(found);
              continue;
            }
          cases[k].value = keys.values[k - 1];
          for (const ComplexMode &mode : found.modes)
            cases[k].samples.push_back(sample<dim>(body, dofs, mass, mode.shape));
        }
      catch (const NotConverged &e)
        {
          problem = std::make_exception_ptr(NumericalFailure(
            std::string(e.what()) +
            "; reduce Time/Rayleigh beta if a vibration of some kHz is overdamped by it, "
            "set Complex modes/Lowest frequency if friction relaxes slowly, change "
            "Highest "
            "frequency or Tolerance, and check that sides and top hold the body against "
            "friction"));
        }
      catch (const Interrupted &)
        {
          problem     = std::current_exception();
          interrupted = true;
        }
      catch (...)
        {
          problem = std::current_exception();
        }
    }
  context.progress().finish();
  agree(problem, interrupted, communicator);
  for (std::size_t k = 0; k < n_cases; ++k)
    bring_object_to_root(communicator, cases[k], static_cast<int>(k % n_ranks));
  result.base = cases[0];
  result.sweep.assign(cases.begin() + 1, cases.end());
  return result;
}

template ComplexCases<2> compute_complex_modes(const ElasticBody<2> &,
                                               const ContactParameters &,
                                               const double,
                                               const StateAtRest &,
                                               const ContactParts &,
                                               const double,
                                               const DampingByPhase &,
                                               RunContext &);
template ComplexCases<3> compute_complex_modes(const ElasticBody<3> &,
                                               const ContactParameters &,
                                               const double,
                                               const StateAtRest &,
                                               const ContactParts &,
                                               const double,
                                               const DampingByPhase &,
                                               RunContext &);
} // namespace mesoslip
