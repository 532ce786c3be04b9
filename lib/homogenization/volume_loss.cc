#include "homogenization/derivatives/variations.h"
#include "homogenization/volume_analysis.h"
#include "program/run_context.h"

namespace mesoslip
{
template <int dim>
void VolumeAnalysis<dim>::solve_loss(const unsigned int m,
                                     EnsembleMember<dim> &member,
                                     RunContext &context)
{
  const auto scope = context.timer().scope("Complex stiffness");
  const std::vector<LoadedPhase<dim>> of_cells = materials();
  const double distance = distance_of_loss(largest_loss_factor(parameters));
  std::uint64_t done    = m * n_cases() + n_first_cases();
  const auto case_done  = [&]() { context.progress().update(++done); };
  std::vector<StiffnessAt<dim>> above;
  for (const double z : {distance, -distance})
    {
      std::vector<ElasticPhase<dim>> phases;
      std::vector<StiffnessChanges<dim>> changes;
      for (const LoadedPhase<dim> &material : of_cells)
        {
          const double loss = parameters.microstructure.phases[material.part].loss_factor;
          changes.push_back({{0, loss * material.stiffness}});
          phases.push_back(
            {(1. + z * loss) * material.stiffness, 0.,
             has_mean_dilatation<dim>(material.stiffness, parameters.mean_dilatation)});
        }
      const auto volume = make_volume(phases, case_done, context.timer());
      for (std::size_t c = 0; c < parameters.conditions.size(); ++c)
        {
          const VolumeSums<dim> sums =
            volume->solve(parameters.conditions[c], parameters.tolerance, case_done);
          if (!volume->is_here())
            continue;
          const HomogenizedResponse<dim> response = homogenize<dim>(sums, phases);
          const StiffnessAt<dim> here             = {
                        response.stiffness, stiffness_derivatives(*volume, response, changes, 1)[0]};
          const HomogenizedResponse<dim> &first = member.responses[c];
          if (z > 0.)
            above.push_back(here);
          else
            member.complex.push_back(complex_stiffness<dim>(
              {first.stiffness, first.derivatives.back()}, above[c], here, distance));
        }
    }
}

template void
VolumeAnalysis<2>::solve_loss(const unsigned int, EnsembleMember<2> &, RunContext &);
template void
VolumeAnalysis<3>::solve_loss(const unsigned int, EnsembleMember<3> &, RunContext &);
} // namespace mesoslip
