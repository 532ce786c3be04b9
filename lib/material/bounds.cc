#include "material/bounds.h"

#include "material/engineering_constants.h"
#include "material/stiffness.h"

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
    mean += fractions[i] *
            (of_compliance ? inverse<dim>(phases[i].stiffness) : phases[i].stiffness);
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
  return inverse<dim>(phase_mean(phases, fractions, true));
}

template <int dim>
VoigtMatrix<dim> isotropic_stiffness(const IsotropicModuli &moduli)
{
  VoigtMatrix<dim> D = VoigtMatrix<dim>::Zero();
  D.template topLeftCorner<dim, dim>().setConstant(moduli.bulk - moduli.shear * 2. / dim);
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    D(i, i) = i < dim ? moduli.bulk + moduli.shear * (2. - 2. / dim) : moduli.shear;
  return D;
}

template <int dim>
std::optional<HashinShtrikmanBounds>
hashin_shtrikman_bounds(const std::vector<Phase<dim>> &phases,
                        const std::vector<double> &fractions)
{
  check_fractions(phases.size(), fractions);
  // An absent phase must not widen the bounds.
  std::vector<double> bulk, shear, present;
  for (std::size_t i = 0; i < phases.size(); ++i)
    {
      const IsotropicProjection isotropic = closest_isotropic<dim>(phases[i].stiffness);
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
    const double G = dim == 2 ? mu : 4. / 3. * mu,
                 H = dim == 2 ? k * mu / (k + 2. * mu)
                              : mu * (9. * k + 8. * mu) / (6. * (k + 2. * mu));
    return IsotropicModuli{shifted_harmonic_mean(bulk, present, G),
                           shifted_harmonic_mean(shear, present, H)};
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
template VoigtMatrix<2> isotropic_stiffness<2>(const IsotropicModuli &);
template VoigtMatrix<3> isotropic_stiffness<3>(const IsotropicModuli &);
template std::optional<HashinShtrikmanBounds>
hashin_shtrikman_bounds<2>(const std::vector<Phase<2>> &, const std::vector<double> &);
template std::optional<HashinShtrikmanBounds>
hashin_shtrikman_bounds<3>(const std::vector<Phase<3>> &, const std::vector<double> &);
} // namespace mesoslip
