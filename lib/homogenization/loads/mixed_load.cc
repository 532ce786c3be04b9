#include "homogenization/loads/mixed_load.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace mesoslip
{
template <int dim>
MacroscopicState<dim> solve_mixed_load(const VoigtMatrix<dim> &stiffness,
                                       const VoigtVector<dim> &thermal_stress,
                                       const PrescribedLoad &load)
{
  const VoigtMatrix<dim> &D = stiffness;
  MacroscopicState<dim> state;
  std::vector<Eigen::Index> unknown;
  for (Eigen::Index k = 0; k < n_voigt<dim>; ++k)
    {
      const auto place = static_cast<std::size_t>(k);
      if (!std::isnan(load.strain[place]))
        state.strain[k] = load.strain[place];
      else
        unknown.push_back(k);
      state.stress[k] = std::isnan(load.stress[place]) ? 0. : load.stress[place];
    }
  // Scaled by the diagonal, as moduli may differ by many orders of magnitude.
  const auto n = static_cast<Eigen::Index>(unknown.size());
  Eigen::MatrixXd A(n, n);
  Eigen::VectorXd b(n);
  const VoigtVector<dim> of_heat     = load.heating * thermal_stress,
                         from_strain = D * state.strain - of_heat,
                         scale       = D.diagonal().cwiseSqrt().cwiseInverse();
  for (Eigen::Index i = 0; i < n; ++i)
    {
      const Eigen::Index row = unknown[static_cast<std::size_t>(i)];
      b[i]                   = scale[row] * (state.stress[row] - from_strain[row]);
      for (Eigen::Index j = 0; j < n; ++j)
        {
          const Eigen::Index column = unknown[static_cast<std::size_t>(j)];
          A(i, j)                   = scale[row] * D(row, column) * scale[column];
        }
    }
  const Eigen::VectorXd x = A.llt().solve(b);
  for (Eigen::Index i = 0; i < n; ++i)
    {
      const Eigen::Index row = unknown[static_cast<std::size_t>(i)];
      state.strain[row]      = scale[row] * x[i];
    }
  const VoigtVector<dim> stress = D * state.strain - of_heat;
  for (Eigen::Index k = 0; k < n_voigt<dim>; ++k)
    if (!std::isnan(load.strain[static_cast<std::size_t>(k)]))
      state.stress[k] = stress[k];
  return state;
}

template MacroscopicState<2>
solve_mixed_load(const VoigtMatrix<2> &, const VoigtVector<2> &, const PrescribedLoad &);
template MacroscopicState<3>
solve_mixed_load(const VoigtMatrix<3> &, const VoigtVector<3> &, const PrescribedLoad &);
} // namespace mesoslip
