#include "sliding/complex/complex_cases.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "material/plausibility.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/body_analysis.h"

#include <deal.II/base/mpi.h>

#include <cmath>
#include <exception>

namespace mesoslip
{
namespace
{
/** A part of each shape that tells it from others: some thousand unknowns, with the root of
 * their mass. */
std::vector<std::complex<float>> sample(const SlidingPencil &pencil,
                                        const ComplexVector &shape)
{
  constexpr Eigen::Index most = 4000;
  std::vector<std::complex<float>> result;
  double size = 0.;
  for (Eigen::Index k = 0; k < pencil.size(); k += 1 + pencil.size() / most)
    {
      const std::complex<double> x = std::sqrt(pencil.mass[k]) * shape[k];
      size += std::norm(x);
      result.emplace_back(x);
    }
  for (std::complex<float> &x : result)
    x /= static_cast<float>(std::sqrt(size));
  return result;
}

ComplexCase numbers_of(const SlidingPencil &pencil,
                       const SlidingState &state,
                       const ComplexModes &found,
                       const bool with_samples)
{
  ComplexCase result;
  result.delta               = pencil.law.delta;
  result.n_sliding           = state.contact.nodes.size();
  result.n_separated         = state.n_separated;
  result.n_missing           = found.n_missing;
  result.nothing_grows_above = found.nothing_grows_above / (2. * M_PI);
  for (const ComplexMode &mode : found.modes)
    {
      result.modes.push_back({mode.frequency(), mode.s.real(), mode.residual,
                              mode.growth_by_friction.sum(), mode.growth_by_damping});
      if (with_samples)
        result.samples.push_back(sample(pencil, mode.shape));
    }
  return result;
}

/** What one rank throws ends all of them. Collective. */
void agree(const std::exception_ptr &problem, const MPI_Comm communicator)
{
  const int failed =
    dealii::Utilities::MPI::max(problem != nullptr ? 1 : 0, communicator);
  if (problem != nullptr)
    std::rethrow_exception(problem);
  if (failed != 0)
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

ResourceNeed complex_modes_memory(const double n_dofs, const unsigned int dim)
{
  // Complex factors as measured with METIS' ordering, matrices, and Arnoldi vectors.
  const double factors =
    dim == 2 ? 42. * n_dofs * std::log2(n_dofs) : 26. * std::pow(n_dofs, 4. / 3.);
  const double vectors = 110. * 2.1 * n_dofs;
  return {16. * (factors + vectors) + 600. * n_dofs,
          "reduce Body/Cells, or take a coarser mesh"};
}

template <int dim>
FreeDofs<dim> vibrating_dofs(const ElasticBody<dim> &body,
                             const ContactParameters &parameters,
                             const SlidingState &state)
{
  return FreeDofs<dim>(body, state.held, modal_options(parameters).platen_mass);
}

template <int dim>
ComplexCases<dim> compute_complex_modes(const ElasticBody<dim> &body,
                                        const ContactParameters &parameters,
                                        const double highest_frequency,
                                        const StateAtRest &at_rest,
                                        RunContext &context)
{
  const MPI_Comm communicator        = context.communicator();
  const ComplexModesParameters &keys = parameters.complex_modes;
  const RealMatrix all               = whole_stiffness(body, communicator);

  ComplexModesOptions options;
  options.highest_frequency    = highest_frequency;
  options.least_growth         = keys.least_growth;
  options.tolerance            = keys.tolerance;
  options.count                = keys.count;
  options.before_factorization = [&context](const std::string &) {
    if (context.stop_requested())
      throw Interrupted("stopped on request in the search for complex modes; there is no "
                        "result yet");
  };

  ComplexCases<dim> result;
  result.highest_frequency  = highest_frequency;
  const std::size_t n_cases = 1 + keys.values.size();
  std::vector<ComplexCase> cases(n_cases);
  std::exception_ptr problem;
  for (std::size_t k = 0; k < n_cases; ++k)
    {
      const ContactParameters of_case =
        k == 0 ? parameters : with_swept(parameters, keys.values[k - 1]);
      const SlidingState state = at_rest(of_case);
      if (k == 0)
        result.state = state;
      if (static_cast<int>(k % static_cast<std::size_t>(context.n_ranks())) !=
            context.rank() ||
          problem != nullptr)
        continue;
      try
        {
          const SlidingPencil pencil =
            make_sliding_pencil<dim>(body, all, vibrating_dofs(body, of_case, state),
                                     state.contact, sliding_law(of_case));
          ComplexModes found =
            find_complex_modes(pencil, friction_radius(pencil), options);
          cases[k] = numbers_of(pencil, state, found, keys.sweep != ModeSweep::none);
          if (k > 0)
            cases[k].value = keys.values[k - 1];
          else
            result.modes = std::move(found);
        }
      catch (const NotConverged &e)
        {
          problem = std::make_exception_ptr(NumericalFailure(
            std::string(e.what()) +
            "; change Complex modes/Highest frequency or Tolerance, and check that sides "
            "and top hold the body against friction"));
        }
      catch (...)
        {
          problem = std::current_exception();
        }
    }
  agree(problem, communicator);
  for (std::size_t k = 0; k < n_cases; ++k)
    bring_object_to_root(
      communicator, cases[k],
      static_cast<int>(k % static_cast<std::size_t>(context.n_ranks())));
  result.base = cases[0];
  result.sweep.assign(cases.begin() + 1, cases.end());
  return result;
}

#define MESOSLIP_INSTANTIATE(dim)                                               \
  template FreeDofs<dim> vibrating_dofs(                                        \
    const ElasticBody<dim> &, const ContactParameters &, const SlidingState &); \
  template ComplexCases<dim> compute_complex_modes(                             \
    const ElasticBody<dim> &, const ContactParameters &, const double,          \
    const StateAtRest &, RunContext &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
