#include "homogenization/ensemble.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Sums over the cells of one phase: of the local strain and stress tensors' columns. */
struct PhaseSums
{
  VoigtMatrix<2> strain = VoigtMatrix<2>::Zero();
  VoigtMatrix<2> stress = VoigtMatrix<2>::Zero();
  double cells          = 0.; ///< volume in mean cell volumes
};

std::vector<PhaseSums> sum_over_phases(const ElasticBody<2> &body,
                                       const LoadCaseSolutions &solutions,
                                       std::vector<double> *concentration)
{
  const bool stresses = solutions.condition == BoundaryCondition::SUBC;
  std::vector<PhaseSums> sums(body.phases().size());
  std::array<ElasticBody<2>::Cells, 3> cells;
  for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
    {
      for (unsigned int k = 0; k < 3; ++k)
        body.evaluate(solutions.displacement[k], group, cells[k]);
      std::vector<PhaseSums> part(sums.size());
      for (std::size_t i = 0; i < cells[0].phase.size(); ++i)
        {
          const unsigned int phase = cells[0].phase[i];
          VoigtMatrix<2> local;
          for (unsigned int k = 0; k < 3; ++k)
            local.col(k) = cells[k].strain[i];
          part[phase].strain += local * cells[0].volume[i];
          part[phase].cells += cells[0].volume[i];
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
          sums[p].cells += part[p].cells;
        }
    }
  for (std::size_t p = 0; p < sums.size(); ++p)
    sums[p].stress = body.phases()[p].stiffness * sums[p].strain;
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
std::optional<double> two_phase_residual(const ElasticBody<2> &body,
                                         const HomogenizedResponse &response,
                                         const std::vector<PhaseSums> &sums)
{
  std::vector<std::size_t> present;
  for (std::size_t p = 0; p < sums.size(); ++p)
    if (sums[p].cells > 0)
      present.push_back(p);
  if (present.size() != 2)
    return {};
  const bool stresses = response.condition == BoundaryCondition::SUBC;
  const auto tensor   = [stresses](const VoigtMatrix<2> &C) {
    return stresses ? VoigtMatrix<2>(C.inverse()) : C;
  };
  const VoigtMatrix<2> C_m = tensor(body.phases()[present[0]].stiffness),
                       C_i = tensor(body.phases()[present[1]].stiffness),
                       D   = tensor(response.stiffness);
  // The difference has to be invertible, with digits to spare.
  const VoigtMatrix<2> inverse = (C_i - C_m).inverse();
  if (!(inverse.norm() * C_m.norm() < 1e6))
    return {};
  const double f                = sums[present[1]].cells / body.n_cells();
  const VoigtMatrix<2> expected = inverse * (D - C_m) / f;
  return (response.phase_means[present[1]] - expected).norm() / expected.norm();
}

VoigtMatrix<2> symmetric_part(const VoigtMatrix<2> &A)
{
  return 0.5 * (A + A.transpose());
}

/** @p mean: of the stress per unit strain, or (SUBC) of the strain per unit stress. @p
 * energy: u_k.K u_l / V. */
void set_stiffness(HomogenizedResponse &response,
                   const VoigtMatrix<2> &mean,
                   const VoigtMatrix<2> &energy)
{
  const bool stresses          = response.condition == BoundaryCondition::SUBC;
  const VoigtMatrix<2> D       = stresses ? VoigtMatrix<2>(mean.inverse()) : mean;
  response.stiffness_from_mean = symmetric_part(D);
  response.stiffness           = symmetric_part(
              stresses ? VoigtMatrix<2>((2. * symmetric_part(mean) - energy).inverse()) : energy);
  response.hill_mandel_residual =
    scaled_difference(response.stiffness_from_mean, response.stiffness);
  response.symmetry_residual = scaled_difference(D, D.transpose());
}
} // namespace

double scaled_difference(const VoigtMatrix<2> &a, const VoigtMatrix<2> &b)
{
  double largest = 0.;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        const double d = std::fabs(a(i, j) - b(i, j)) / std::sqrt(b(i, i) * b(j, j));
        if (std::isnan(d))
          return d;
        largest = std::max(largest, d);
      }
  return largest;
}

HomogenizedResponse homogenize(const ElasticBody<2> &body,
                               const LoadCaseSolutions &solutions,
                               const bool keep_concentration)
{
  const bool stresses = solutions.condition == BoundaryCondition::SUBC;
  HomogenizedResponse response;
  response.condition = solutions.condition;
  response.reports   = solutions.reports;
  if (keep_concentration)
    response.concentration.reserve(9 * body.n_cells());
  const std::vector<PhaseSums> sums = sum_over_phases(
    body, solutions, keep_concentration ? &response.concentration : nullptr);

  VoigtMatrix<2> strain = VoigtMatrix<2>::Zero(), stress = VoigtMatrix<2>::Zero();
  for (const PhaseSums &phase : sums)
    {
      strain += phase.strain / body.n_cells();
      stress += phase.stress / body.n_cells();
      const VoigtMatrix<2> &mean = stresses ? phase.stress : phase.strain;
      response.phase_means.push_back(phase.cells > 0
                                       ? VoigtMatrix<2>(mean / phase.cells)
                                       : VoigtMatrix<2>(VoigtMatrix<2>::Zero()));
    }
  response.mean_residual =
    ((stresses ? stress : strain) - VoigtMatrix<2>(VoigtMatrix<2>::Identity())).norm();
  set_stiffness(response, stresses ? strain : stress, energy_products(body, solutions));
  response.two_phase_residual = two_phase_residual(body, response, sums);
  return response;
}
} // namespace mesoslip
