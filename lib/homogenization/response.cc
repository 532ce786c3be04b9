#include "homogenization/response.h"

#include "elasticity/uniform_grid_operator.h"

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
  std::size_t cells     = 0;
};

std::vector<PhaseSums> sum_over_phases(const UniformMaterial &material,
                                       const LoadCaseSolutions &solutions,
                                       std::vector<double> *concentration)
{
  const UniformGrid<2> &grid = material.grid();
  const UniformGridOperator op(material);
  const std::size_t nx = grid.cells[0], ny = grid.cells[1];
  const bool stresses = solutions.condition == BoundaryCondition::SUBC;
  std::vector<PhaseSums> sums(material.classes().size());
  std::vector<double> exx(3 * nx), eyy(3 * nx), gxy(3 * nx);
  if (concentration != nullptr)
    concentration->resize(9 * grid.n_cells());

  for (unsigned int j = 0; j < ny; ++j)
    {
      for (unsigned int k = 0; k < 3; ++k)
        op.strain(solutions.displacement[k], j, &exx[k * nx], &eyy[k * nx], &gxy[k * nx]);
      std::vector<PhaseSums> row(sums.size());
      for (unsigned int i = 0; i < nx; ++i)
        {
          const unsigned int phase = material.class_of(i, j);
          VoigtMatrix<2> local;
          for (unsigned int k = 0; k < 3; ++k)
            local.col(k) << exx[k * nx + i], eyy[k * nx + i], gxy[k * nx + i];
          row[phase].strain += local;
          ++row[phase].cells;
          if (concentration != nullptr)
            {
              if (stresses)
                local = material.classes()[phase].stiffness * local;
              std::copy_n(local.data(), 9, concentration->data() + 9 * (j * nx + i));
            }
        }
      for (std::size_t p = 0; p < sums.size(); ++p)
        {
          sums[p].strain += row[p].strain;
          sums[p].cells += row[p].cells;
        }
    }
  for (std::size_t p = 0; p < sums.size(); ++p)
    sums[p].stress = material.classes()[p].stiffness * sums[p].strain;
  return sums;
}

// u_k.K u_l / V
VoigtMatrix<2> energy_products(const UniformMaterial &material,
                               const LoadCaseSolutions &solutions)
{
  const UniformGridOperator op(material);
  VoigtMatrix<2> products;
  const auto &u = solutions.displacement;
  NodalField<double> Ku(u[0].n_columns(), u[0].n_rows());
  for (unsigned int l = 0; l < 3; ++l)
    {
      op.vmult(Ku, u[l]);
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
  return products / (material.grid().extent(0) * material.grid().extent(1));
}
// Means of the tensors over two phases against what the stiffness says they are.
std::optional<double> two_phase_residual(const UniformMaterial &material,
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
  const VoigtMatrix<2> C_m = tensor(material.classes()[present[0]].stiffness),
                       C_i = tensor(material.classes()[present[1]].stiffness),
                       D   = tensor(response.stiffness);
  // The difference has to be invertible, with digits to spare.
  const VoigtMatrix<2> inverse = (C_i - C_m).inverse();
  if (!(inverse.norm() * C_m.norm() < 1e6))
    return {};
  const double f =
    static_cast<double>(sums[present[1]].cells) / material.grid().n_cells();
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

HomogenizedResponse homogenize(const UniformMaterial &material,
                               const LoadCaseSolutions &solutions,
                               const bool keep_concentration)
{
  const bool stresses = solutions.condition == BoundaryCondition::SUBC;
  HomogenizedResponse response;
  response.condition                = solutions.condition;
  response.reports                  = solutions.reports;
  const std::vector<PhaseSums> sums = sum_over_phases(
    material, solutions, keep_concentration ? &response.concentration : nullptr);

  VoigtMatrix<2> strain = VoigtMatrix<2>::Zero(), stress = VoigtMatrix<2>::Zero();
  for (const PhaseSums &phase : sums)
    {
      strain += phase.strain / material.grid().n_cells();
      stress += phase.stress / material.grid().n_cells();
      const VoigtMatrix<2> &mean = stresses ? phase.stress : phase.strain;
      response.phase_means.push_back(phase.cells > 0
                                       ? VoigtMatrix<2>(mean / phase.cells)
                                       : VoigtMatrix<2>(VoigtMatrix<2>::Zero()));
    }
  response.mean_residual =
    ((stresses ? stress : strain) - VoigtMatrix<2>(VoigtMatrix<2>::Identity())).norm();
  set_stiffness(response, stresses ? strain : stress,
                energy_products(material, solutions));
  response.two_phase_residual = two_phase_residual(material, response, sums);
  return response;
}
} // namespace mesoslip
