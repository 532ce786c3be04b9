#include "homogenization/response.h"

#include "material/engineering_constants.h"
#include "material/stiffness.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
// Compares the mean tensors of two phases with the exact relation to the stiffness.
template <int dim>
std::optional<double> two_phase_residual(const VolumeSums<dim> &sums,
                                         const std::vector<ElasticPhase<dim>> &phases,
                                         const HomogenizedResponse<dim> &response)
{
  using Tensor = VoigtMatrix<dim>;
  std::vector<std::size_t> present;
  for (std::size_t p = 0; p < sums.phases.size(); ++p)
    if (sums.phases[p].volume > 0)
      present.push_back(p);
  if (present.size() != 2)
    return {};
  const bool stresses = response.condition == BoundaryCondition::SUBC,
             mixed    = response.condition == BoundaryCondition::MUBC;
  // For MUBC only the orthotropic part of the means is known beforehand.
  if (mixed && !(is_orthotropic<dim>(phases[present[0]].stiffness) &&
                 is_orthotropic<dim>(phases[present[1]].stiffness)))
    return {};
  const auto tensor = [stresses](const Tensor &C) {
    return stresses ? mesoslip::inverse<dim>(C) : C;
  };
  const Tensor C_m = tensor(phases[present[0]].stiffness),
               C_i = tensor(phases[present[1]].stiffness), D = tensor(response.stiffness);
  // The difference has to be invertible with a margin.
  const Tensor inverse = mesoslip::inverse<dim>(C_i - C_m);
  if (!(inverse.norm() * C_m.norm() < 1e6))
    return {};
  const double f        = sums.phases[present[1]].volume / sums.volume;
  const Tensor expected = inverse * (D - C_m) / f;
  const Tensor &mean    = response.phase_means[present[1]];
  const Tensor found    = mixed ? orthotropic_part<dim>(mean) : mean;
  return (found - expected).norm() / expected.norm();
}

template <int dim>
VoigtMatrix<dim> symmetric_part(const VoigtMatrix<dim> &A)
{
  return 0.5 * (A + A.transpose());
}

/** @p mean: stress per unit strain, or (SUBC) strain per unit stress. @p energy: u_k.K
 * u_l / V. */
template <int dim>
void set_stiffness(HomogenizedResponse<dim> &response,
                   const VoigtMatrix<dim> &mean,
                   const VoigtMatrix<dim> &energy)
{
  const bool stresses          = response.condition == BoundaryCondition::SUBC;
  const VoigtMatrix<dim> D     = stresses ? inverse<dim>(mean) : mean;
  response.stiffness_from_mean = symmetric_part<dim>(D);
  response.stiffness           = symmetric_part<dim>(
    stresses ? inverse<dim>(2. * symmetric_part<dim>(mean) - energy) : energy);
  response.hill_mandel_residual =
    scaled_difference<dim>(response.stiffness_from_mean, response.stiffness);
  response.symmetry_residual = scaled_difference<dim>(D, D.transpose());
}
/** Computes all members except ThermalResponse::held. */
template <int dim>
ThermalResponse<dim> thermal_response(const VolumeSums<dim> &sums,
                                      const std::vector<ElasticPhase<dim>> &phases,
                                      const HomogenizedResponse<dim> &response)
{
  const bool stresses = response.condition == BoundaryCondition::SUBC;
  ThermalResponse<dim> heat;
  double scale            = 0.;
  heat.exists             = true;
  VoigtVector<dim> strain = VoigtVector<dim>::Zero(), // means of the solved case
    stress                = VoigtVector<dim>::Zero();
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      const PhaseSums<dim> &phase    = sums.phases[p];
      const VoigtVector<dim> &beta   = phases[p].thermal_stress;
      const VoigtVector<dim> of_heat = phase.strain.col(n_voigt<dim>);
      heat.work += phase.strain.transpose() * beta / sums.volume;
      strain += of_heat / sums.volume;
      stress += (phases[p].stiffness * of_heat - phase.volume * beta) / sums.volume;
      // The scale sums absolute values, which cannot cancel.
      if (phase.volume > 0. && !beta.isZero(0.))
        scale +=
          phase.volume / sums.volume *
          (stresses ? VoigtVector<dim>(inverse<dim>(phases[p].stiffness) * beta) : beta)
            .cwiseAbs()
            .maxCoeff();
    }
  const VoigtMatrix<dim> &D       = response.stiffness;
  VoigtVector<dim> by_reciprocity = heat.work.template head<n_voigt<dim>>(),
                   by_mean        = stresses ? strain : VoigtVector<dim>(-stress);
  if (response.condition == BoundaryCondition::MUBC)
    for (VoigtVector<dim> *one : {&by_reciprocity, &by_mean})
      one->template tail<n_voigt<dim> - dim>().setZero();
  heat.stress = stresses ? VoigtVector<dim>(D * by_reciprocity) : by_reciprocity;
  heat.expansion =
    stresses ? by_reciprocity : VoigtVector<dim>(inverse<dim>(D) * by_reciprocity);
  const double distance = (by_reciprocity - by_mean).cwiseAbs().maxCoeff();
  heat.residual         = scale > 0. ? distance / scale : distance;
  return heat;
}
} // namespace

template <int dim>
double scaled_difference(const VoigtMatrix<dim> &a, const VoigtMatrix<dim> &b)
{
  double largest = 0.;
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    for (unsigned int j = 0; j < n_voigt<dim>; ++j)
      {
        const double d = std::fabs(a(i, j) - b(i, j)) / std::sqrt(b(i, i) * b(j, j));
        if (std::isnan(d))
          return d;
        largest = std::max(largest, d);
      }
  return largest;
}

template <int dim>
HomogenizedResponse<dim> homogenize(const VolumeSums<dim> &sums,
                                    const std::vector<ElasticPhase<dim>> &phases)
{
  using Tensor        = VoigtMatrix<dim>;
  const bool stresses = sums.condition == BoundaryCondition::SUBC;
  HomogenizedResponse<dim> response;
  response.condition = sums.condition;
  response.reports   = sums.reports;
  Tensor strain = Tensor::Zero(), stress = Tensor::Zero();
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      const PhaseSums<dim> &phase = sums.phases[p];
      const Tensor strain_sum     = phase.strain.template leftCols<n_voigt<dim>>(),
                   stress_sum     = phases[p].stiffness * strain_sum;
      strain += strain_sum / sums.volume;
      stress += stress_sum / sums.volume;
      const Tensor &mean = stresses ? stress_sum : strain_sum;
      response.phase_means.push_back(phase.volume > 0 ? Tensor(mean / phase.volume)
                                                      : Tensor(Tensor::Zero()));
    }
  response.energy = sums.energy;
  response.volume = sums.volume;
  Tensor energy   = sums.energy;
  if (sums.condition == BoundaryCondition::MUBC)
    {
      // Energies between cases with different constraints are no stiffness entries.
      energy = orthotropic_part<dim>(energy);
      strain = orthotropic_part<dim>(strain);
      response.coupling =
        scaled_difference<dim>(energy + (stress - orthotropic_part<dim>(stress)), energy);
      stress = orthotropic_part<dim>(stress);
    }
  response.mean_residual =
    ((stresses ? stress : strain) - Tensor(Tensor::Identity())).norm();
  set_stiffness<dim>(response, stresses ? strain : stress, energy);
  response.two_phase_residual = two_phase_residual(sums, phases, response);
  if (has_expansion(phases))
    response.heat = thermal_response(sums, phases, response);
  return response;
}

template <int dim>
void gather_parts(HomogenizedResponse<dim> &response,
                  const VolumeSums<dim> &sums,
                  const std::vector<unsigned int> &part,
                  const std::size_t n_parts)
{
  if (part.size() == n_parts)
    return; // each phase is one material
  std::vector<VoigtMatrix<dim>> means(n_parts, VoigtMatrix<dim>::Zero());
  std::vector<double> volumes(n_parts, 0.);
  for (std::size_t m = 0; m < part.size(); ++m)
    {
      means[part[m]] += sums.phases[m].volume * response.phase_means[m];
      volumes[part[m]] += sums.phases[m].volume;
    }
  for (std::size_t p = 0; p < n_parts; ++p)
    if (volumes[p] > 0.)
      means[p] /= volumes[p];
  response.phase_means = std::move(means);
}

#define MESOSLIP_INSTANTIATE(dim)                                                      \
  template double scaled_difference<dim>(const VoigtMatrix<dim> &,                     \
                                         const VoigtMatrix<dim> &);                    \
  template HomogenizedResponse<dim> homogenize<dim>(                                   \
    const VolumeSums<dim> &, const std::vector<ElasticPhase<dim>> &);                  \
  template void gather_parts<dim>(HomogenizedResponse<dim> &, const VolumeSums<dim> &, \
                                  const std::vector<unsigned int> &, const std::size_t);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
