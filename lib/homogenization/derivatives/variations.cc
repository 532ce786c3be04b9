#include "homogenization/derivatives/variations.h"

#include "base/exchange.h"
#include "material/engineering_constants.h"

#include <algorithm>
#include <utility>

namespace mesoslip
{
template <int dim>
std::vector<Variation<dim>> variations_of(const std::vector<PhaseParameters> &phases,
                                          const bool wanted)
{
  const std::vector<VoigtMatrix<dim>> none(phases.size(), VoigtMatrix<dim>::Zero());
  const auto has_deviations = [](const PhaseParameters &phase) {
    return !phase.deviations.empty();
  };
  std::vector<Variation<dim>> variations;
  if (wanted || std::any_of(phases.begin(), phases.end(), has_deviations))
    for (std::size_t p = 0; p < phases.size(); ++p)
      for (const PhaseConstant<dim> &constant : phases[p].template constants<dim>())
        {
          variations.push_back({phases[p].name, constant, none});
          variations.back().stiffness[p] = constant.derivative;
        }
  Variation<dim> loss = {{}, {"loss", "1", 0., 0., VoigtMatrix<dim>::Zero()}, none};
  for (std::size_t p = 0; p < phases.size(); ++p)
    loss.stiffness[p] = phases[p].loss_factor * phases[p].template stiffness<dim>();
  if (std::any_of(phases.begin(), phases.end(),
                  [](const PhaseParameters &phase) { return phase.loss_factor > 0.; }))
    variations.push_back(loss);
  return variations;
}

template <int dim>
std::vector<VoigtMatrix<dim>>
stiffness_derivatives(const VolumeElement<dim> &volume,
                      const HomogenizedResponse<dim> &response,
                      const std::vector<StiffnessChanges<dim>> &changes,
                      const std::size_t n_variations)
{
  std::vector<VoigtMatrix<dim>> means(n_variations, VoigtMatrix<dim>::Zero());
  if (n_variations == 0)
    return means;
  volume.for_each_sample(
    [&](const unsigned int material, const double part, const UnitStrains<dim> &strains) {
      const VoigtMatrix<dim> strain = strains.template leftCols<n_voigt<dim>>();
      for (const auto &[k, change] : changes[material])
        means[k].noalias() += part * (strain.transpose() * (change * strain).eval());
    });
  sum_over_ranks(means[0].data(),
                 means.size() * static_cast<std::size_t>(means[0].size()),
                 volume.communicator());
  for (VoigtMatrix<dim> &mean : means)
    {
      mean /= response.volume;
      if (response.condition == BoundaryCondition::SUBC)
        mean = response.stiffness * mean * response.stiffness;
      else if (response.condition == BoundaryCondition::MUBC)
        mean = orthotropic_part<dim>(mean);
    }
  return means;
}

#define MESOSLIP_INSTANTIATE(dim)                                    \
  template std::vector<Variation<dim>> variations_of<dim>(           \
    const std::vector<PhaseParameters> &, const bool);               \
  template std::vector<VoigtMatrix<dim>> stiffness_derivatives<dim>( \
    const VolumeElement<dim> &, const HomogenizedResponse<dim> &,    \
    const std::vector<StiffnessChanges<dim>> &, const std::size_t);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
