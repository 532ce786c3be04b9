#include "homogenization/response.h"

#include "material/engineering_constants.h"
#include "material/stiffness.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Integrals of the strain in the phases; their unit of volume is that of a mean cell. */
std::vector<PhaseSums<2>> sum_over_cells(const ElasticBody<2> &body,
                                         const LoadCaseSolutions &solutions,
                                         std::vector<double> *concentration)
{
  const bool stresses = solutions.condition == BoundaryCondition::SUBC;
  std::vector<PhaseSums<2>> sums(body.phases().size());
  std::array<ElasticBody<2>::Cells, 3> cells;
  for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
    {
      for (unsigned int k = 0; k < 3; ++k)
        body.evaluate(solutions.displacement[k], group, cells[k]);
      std::vector<PhaseSums<2>> part(sums.size());
      for (std::size_t i = 0; i < cells[0].phase.size(); ++i)
        {
          const unsigned int phase = cells[0].phase[i];
          VoigtMatrix<2> local;
          for (unsigned int k = 0; k < 3; ++k)
            local.col(k) = cells[k].strain[i];
          part[phase].strain += local * cells[0].volume[i];
          part[phase].volume += cells[0].volume[i];
          if (concentration != nullptr)
            {
              if (stresses)
                local = body.phases()[phase].stiffness * local;
              concentration->insert(concentration->end(), local.data(), local.data() + 9);
            }
        }
      for (std::size_t p = 0; p < sums.size(); ++p)
        {
          sums[p].strain += part[p].strain;
          sums[p].volume += part[p].volume;
        }
    }
  return sums;
}

// u_k.K u_l / V
VoigtMatrix<2> energy_products(const ElasticBody<2> &body,
                               const LoadCaseSolutions &solutions)
{
  VoigtMatrix<2> products;
  const auto &u         = solutions.displacement;
  NodalField<double> Ku = body.zero_field();
  for (unsigned int l = 0; l < 3; ++l)
    {
      body.vmult(Ku, u[l]);
      for (unsigned int k = 0; k < 3; ++k)
        {
          double sum = 0.;
          for (unsigned int c = 0; c < 2; ++c)
            for (unsigned int j = 0; j < Ku.n_rows(); ++j)
              {
                double row = 0.;
                for (unsigned int i = 0; i < Ku.n_columns(); ++i)
                  row += u[k].row(c, j)[i] * Ku.row(c, j)[i];
                sum += row;
              }
          products(k, l) = sum;
        }
    }
  return products / body.volume();
}

// Means of the tensors over two phases against what the stiffness says they are.
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
  // Of MUBC the orthotropic part of the means alone is known beforehand.
  if (mixed && !(is_orthotropic<dim>(phases[present[0]].stiffness) &&
                 is_orthotropic<dim>(phases[present[1]].stiffness)))
    return {};
  const auto tensor = [stresses](const Tensor &C) {
    return stresses ? Tensor(C.inverse()) : C;
  };
  const Tensor C_m = tensor(phases[present[0]].stiffness),
               C_i = tensor(phases[present[1]].stiffness), D = tensor(response.stiffness);
  // The difference has to be invertible, with digits to spare.
  const Tensor inverse = (C_i - C_m).inverse();
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

/** @p mean: of the stress per unit strain, or (SUBC) of the strain per unit stress. @p
 * energy: u_k.K u_l / V. */
template <int dim>
void set_stiffness(HomogenizedResponse<dim> &response,
                   const VoigtMatrix<dim> &mean,
                   const VoigtMatrix<dim> &energy)
{
  const bool stresses          = response.condition == BoundaryCondition::SUBC;
  const VoigtMatrix<dim> D     = stresses ? VoigtMatrix<dim>(mean.inverse()) : mean;
  response.stiffness_from_mean = symmetric_part<dim>(D);
  response.stiffness           = symmetric_part<dim>(
    stresses ? VoigtMatrix<dim>((2. * symmetric_part<dim>(mean) - energy).inverse())
                       : energy);
  response.hill_mandel_residual =
    scaled_difference<dim>(response.stiffness_from_mean, response.stiffness);
  response.symmetry_residual = scaled_difference<dim>(D, D.transpose());
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
      const Tensor stress_sum     = phases[p].stiffness * phase.strain;
      strain += phase.strain / sums.volume;
      stress += stress_sum / sums.volume;
      const Tensor &mean = stresses ? stress_sum : phase.strain;
      response.phase_means.push_back(phase.volume > 0 ? Tensor(mean / phase.volume)
                                                      : Tensor(Tensor::Zero()));
    }
  response.energy = sums.energy;
  Tensor energy   = sums.energy;
  if (sums.condition == BoundaryCondition::MUBC)
    {
      // The energies of cases with different constraints say nothing of a stiffness.
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
  return response;
}

HomogenizedResponse<2> homogenize(const ElasticBody<2> &body,
                                  const LoadCaseSolutions &solutions,
                                  const bool keep_concentration)
{
  std::vector<double> concentration;
  if (keep_concentration)
    concentration.reserve(9 * body.n_cells());
  VolumeSums<2> sums;
  sums.condition = solutions.condition;
  sums.reports   = solutions.reports;
  sums.phases =
    sum_over_cells(body, solutions, keep_concentration ? &concentration : nullptr);
  sums.volume                     = body.n_cells();
  sums.energy                     = energy_products(body, solutions);
  HomogenizedResponse<2> response = homogenize<2>(sums, body.phases());
  response.concentration          = std::move(concentration);
  return response;
}

template double scaled_difference<2>(const VoigtMatrix<2> &, const VoigtMatrix<2> &);
template double scaled_difference<3>(const VoigtMatrix<3> &, const VoigtMatrix<3> &);
template HomogenizedResponse<2> homogenize<2>(const VolumeSums<2> &,
                                              const std::vector<ElasticPhase<2>> &);
template HomogenizedResponse<3> homogenize<3>(const VolumeSums<3> &,
                                              const std::vector<ElasticPhase<3>> &);
} // namespace mesoslip
