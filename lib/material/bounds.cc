#include "material/bounds.h"

#include "material/engineering_constants.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mesoslip
{
namespace
{
void check_fractions(const std::size_t n_phases, const std::vector<double> &fractions)
{
  if (n_phases == 0 || fractions.size() != n_phases)
    throw std::invalid_argument("there are " + std::to_string(fractions.size()) +
                                " fractions for " + std::to_string(n_phases) + " phases");
  double sum = 0.;
  for (const double f : fractions)
    {
      if (!(f >= 0. && f <= 1.))
        throw std::invalid_argument("the fraction " + std::to_string(f) +
                                    " does not lie between 0 and 1");
      sum += f;
    }
  if (!(std::abs(sum - 1.) <= 1e-9))
    throw std::invalid_argument("the fractions sum to " + std::to_string(sum) +
                                " instead of 1");
}

/** Mean over the phases of the stiffness, or of its inverse. */
template <int dim>
VoigtMatrix<dim> phase_mean(const std::vector<Phase<dim>> &phases,
                            const std::vector<double> &fractions,
                            const bool of_compliance)
{
  check_fractions(phases.size(), fractions);
  VoigtMatrix<dim> mean = VoigtMatrix<dim>::Zero();
  for (std::size_t i = 0; i < phases.size(); ++i)
    mean +=
      fractions[i] * (of_compliance ? VoigtMatrix<dim>(phases[i].stiffness.inverse())
                                    : phases[i].stiffness);
  return mean;
}

/** 1 / sum f_i / (m_i + reference) - reference */
double shifted_harmonic_mean(const std::vector<double> &moduli,
                             const std::vector<double> &fractions,
                             const double reference)
{
  double sum = 0.;
  for (std::size_t i = 0; i < moduli.size(); ++i)
    sum += fractions[i] / (moduli[i] + reference);
  return 1. / sum - reference;
}
} // namespace

template <int dim>
VoigtMatrix<dim> voigt_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions)
{
  return phase_mean(phases, fractions, false);
}

template <int dim>
VoigtMatrix<dim> reuss_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions)
{
  return phase_mean(phases, fractions, true).inverse();
}

VoigtMatrix<2> plane_isotropic_stiffness(const PlaneModuli &moduli)
{
  VoigtMatrix<2> D = VoigtMatrix<2>::Zero();
  D(0, 0) = D(1, 1) = moduli.bulk + moduli.shear;
  D(0, 1) = D(1, 0) = moduli.bulk - moduli.shear;
  D(2, 2)           = moduli.shear;
  return D;
}

std::optional<HashinShtrikmanBounds>
hashin_shtrikman_bounds(const std::vector<Phase<2>> &phases,
                        const std::vector<double> &fractions)
{
  check_fractions(phases.size(), fractions);
  // An absent phase must not widen the bounds.
  std::vector<double> bulk, shear, present;
  for (std::size_t i = 0; i < phases.size(); ++i)
    {
      const IsotropicProjection isotropic = closest_isotropic<2>(phases[i].stiffness);
      if (!(isotropic.relative_distance <= 1e-9))
        return std::nullopt;
      if (fractions[i] > 0.)
        {
          bulk.push_back(isotropic.bulk_modulus);
          shear.push_back(isotropic.shear_modulus);
          present.push_back(fractions[i]);
        }
    }
  const auto bound = [&](const double k, const double mu) {
    return PlaneModuli{shifted_harmonic_mean(bulk, present, mu),
                       shifted_harmonic_mean(shear, present, k * mu / (k + 2. * mu))};
  };
  const auto [min_bulk, max_bulk]   = std::minmax_element(bulk.begin(), bulk.end());
  const auto [min_shear, max_shear] = std::minmax_element(shear.begin(), shear.end());
  return HashinShtrikmanBounds{bound(*min_bulk, *min_shear),
                               bound(*max_bulk, *max_shear)};
}

template VoigtMatrix<2> voigt_bound<2>(const std::vector<Phase<2>> &,
                                       const std::vector<double> &);
template VoigtMatrix<3> voigt_bound<3>(const std::vector<Phase<3>> &,
                                       const std::vector<double> &);
template VoigtMatrix<2> reuss_bound<2>(const std::vector<Phase<2>> &,
                                       const std::vector<double> &);
template VoigtMatrix<3> reuss_bound<3>(const std::vector<Phase<3>> &,
                                       const std::vector<double> &);
} // namespace mesoslip
