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

PlaneModuli hashin_shtrikman(const std::vector<double> &bulk,
                             const std::vector<double> &shear,
                             const std::vector<double> &fractions,
                             const PlaneModuli &reference)
{
  const double H =
    reference.bulk * reference.shear / (reference.bulk + 2. * reference.shear);
  return {shifted_harmonic_mean(bulk, fractions, reference.shear),
          shifted_harmonic_mean(shear, fractions, H)};
}
} // namespace

template <int dim>
VoigtMatrix<dim> voigt_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions)
{
  check_fractions(phases.size(), fractions);
  VoigtMatrix<dim> mean = VoigtMatrix<dim>::Zero();
  for (std::size_t i = 0; i < phases.size(); ++i)
    mean += fractions[i] * phases[i].stiffness;
  return mean;
}

template <int dim>
VoigtMatrix<dim> reuss_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions)
{
  check_fractions(phases.size(), fractions);
  VoigtMatrix<dim> mean = VoigtMatrix<dim>::Zero();
  for (std::size_t i = 0; i < phases.size(); ++i)
    mean += fractions[i] * VoigtMatrix<dim>(phases[i].stiffness.inverse());
  return mean.inverse();
}

template <int dim>
double mean_density(const std::vector<Phase<dim>> &phases,
                    const std::vector<double> &fractions)
{
  check_fractions(phases.size(), fractions);
  double mean = 0.;
  for (std::size_t i = 0; i < phases.size(); ++i)
    mean += fractions[i] * phases[i].density;
  return mean;
}

VoigtMatrix<2> plane_isotropic_stiffness(const PlaneModuli &moduli)
{
  VoigtMatrix<2> D = VoigtMatrix<2>::Zero();
  D(0, 0) = D(1, 1) = moduli.bulk + moduli.shear;
  D(0, 1) = D(1, 0) = moduli.bulk - moduli.shear;
  D(2, 2)           = moduli.shear;
  return D;
}

std::optional<PlaneModuli> plane_moduli(const VoigtMatrix<2> &stiffness)
{
  const IsotropicProjection isotropic = closest_isotropic<2>(stiffness);
  if (!(isotropic.relative_distance <= 1e-9))
    return std::nullopt;
  return PlaneModuli{isotropic.bulk_modulus, isotropic.shear_modulus};
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
      const std::optional<PlaneModuli> moduli = plane_moduli(phases[i].stiffness);
      if (!moduli)
        return std::nullopt;
      if (fractions[i] > 0.)
        {
          bulk.push_back(moduli->bulk);
          shear.push_back(moduli->shear);
          present.push_back(fractions[i]);
        }
    }
  const auto [min_bulk, max_bulk]   = std::minmax_element(bulk.begin(), bulk.end());
  const auto [min_shear, max_shear] = std::minmax_element(shear.begin(), shear.end());

  HashinShtrikmanBounds bounds;
  bounds.lower = hashin_shtrikman(bulk, shear, present, {*min_bulk, *min_shear});
  bounds.upper = hashin_shtrikman(bulk, shear, present, {*max_bulk, *max_shear});
  bounds.lower_stiffness = plane_isotropic_stiffness(bounds.lower);
  bounds.upper_stiffness = plane_isotropic_stiffness(bounds.upper);
  return bounds;
}

template VoigtMatrix<2> voigt_bound<2>(const std::vector<Phase<2>> &,
                                       const std::vector<double> &);
template VoigtMatrix<3> voigt_bound<3>(const std::vector<Phase<3>> &,
                                       const std::vector<double> &);
template VoigtMatrix<2> reuss_bound<2>(const std::vector<Phase<2>> &,
                                       const std::vector<double> &);
template VoigtMatrix<3> reuss_bound<3>(const std::vector<Phase<3>> &,
                                       const std::vector<double> &);
template double mean_density<2>(const std::vector<Phase<2>> &,
                                const std::vector<double> &);
template double mean_density<3>(const std::vector<Phase<3>> &,
                                const std::vector<double> &);
} // namespace mesoslip
