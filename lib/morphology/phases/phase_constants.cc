#include "base/errors.h"
#include "base/text.h"
#include "material/stiffness_derivatives.h"
#include "morphology/phases/phase_parameters.h"

#include <Eigen/Geometry>

#include <array>

namespace mesoslip
{
namespace
{
/** A derivative of a 3D stiffness; in 2D its plane-strain part. */
template <int dim>
VoigtMatrix<dim> in_dimension(const VoigtMatrix<3> &derivative)
{
  if constexpr (dim == 3)
    return derivative;
  else
    return plane_part(derivative);
}

/** The entries that @p n coefficients of stiffness_from_coefficients() stand for. */
template <int dim>
std::vector<StiffnessEntry> given_entries(const std::size_t n)
{
  const auto all        = stiffness_entries<dim>();
  const bool short_form = n < all.size();
  std::vector<StiffnessEntry> given;
  for (const StiffnessEntry &entry : all)
    if (!short_form || !entry.couples_shear(dim))
      given.push_back(entry);
  return given;
}
} // namespace

VoigtVector<3> PhaseParameters::expansion_in_space() const
{
  const Eigen::Vector3d along_axes = expansion.size() == 1
                                       ? Eigen::Vector3d::Constant(expansion[0])
                                       : Eigen::Vector3d(expansion.data());
  return turned_expansion(along_axes, axes());
}

VoigtVector<3> PhaseParameters::thermal_stress_in_space() const
{
  return stiffness<3>() * expansion_in_space();
}

double PhaseParameters::thermal_energy() const
{
  return expands() ? expansion_in_space().dot(thermal_stress_in_space()) : 0.;
}

Eigen::Matrix3d PhaseParameters::axes() const
{
  return is_turned_in_3d()
           ? rotation()
           : Eigen::Matrix3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
}

template <int dim>
Eigen::Matrix<double, dim, dim, Eigen::RowMajor> PhaseParameters::conductivity() const
{
  const Eigen::Vector3d along_axes = conductivities.size() == 1
                                       ? Eigen::Vector3d::Constant(conductivities[0])
                                       : Eigen::Vector3d(conductivities.data());
  const Eigen::Matrix3d full = axes() * along_axes.asDiagonal() * axes().transpose();
  return full.topLeftCorner<dim, dim>();
}

template <int dim>
VoigtVector<dim> PhaseParameters::thermal_stress() const
{
  if (!expands())
    return VoigtVector<dim>::Zero();
  const VoigtVector<3> full = thermal_stress_in_space();
  if constexpr (dim == 3)
    return full;
  else
    return {full[0], full[1], full[5]};
}

double PhaseParameters::transverse_thermal_stress() const
{
  return expands() ? thermal_stress_in_space()[2] : 0.;
}

OrthotropicConstants PhaseParameters::orthotropic() const
{
  return {young_moduli.at(0),   young_moduli.at(1),   young_moduli.at(2),
          poisson_ratios.at(0), poisson_ratios.at(1), poisson_ratios.at(2),
          shear_moduli.at(0),   shear_moduli.at(1),   shear_moduli.at(2)};
}

template <int dim>
std::vector<PhaseConstant<dim>> PhaseParameters::constants() const
{
  std::vector<PhaseConstant<dim>> list;
  const auto add = [this, &list](const std::string &constant, const double value,
                                 const VoigtMatrix<dim> &derivative) {
    const bool is_ratio = constant.rfind("nu", 0) == 0;
    list.push_back({constant, is_ratio ? "1" : "Pa", value, 0., turned<dim>(derivative)});
  };
  if (type == Type::isotropic)
    {
      const auto derivatives = isotropic_derivatives(young_modulus, poisson_ratio);
      add("E", young_modulus, in_dimension<dim>(derivatives[0]));
      add("nu", poisson_ratio, in_dimension<dim>(derivatives[1]));
    }
  else if (type == Type::orthotropic)
    {
      constexpr std::array<const char *, 9> names = {
        {"E1", "E2", "E3", "nu12", "nu13", "nu23", "G12", "G13", "G23"}};
      const auto derivatives = orthotropic_derivatives(orthotropic());
      const std::array<const std::vector<double> *, 3> keys = {
        {&young_moduli, &poisson_ratios, &shear_moduli}};
      for (std::size_t k = 0; k < names.size(); ++k)
        add(names[k], (*keys[k / 3])[k % 3], in_dimension<dim>(derivatives[k]));
    }
  else
    for (const auto &[row, column, entry] : given_entries<dim>(coefficients.size()))
      {
        VoigtMatrix<dim> derivative = VoigtMatrix<dim>::Zero();
        derivative(row, column) = derivative(column, row) = 1.;
        add(entry, coefficients[list.size()], derivative);
      }
  // A wrong number of deviations is refused by check_deviations().
  const bool for_all = deviations.size() == 1;
  for (std::size_t k = 0; k < list.size() && (for_all || k < deviations.size()); ++k)
    {
      const double share = deviations[for_all ? 0 : k];
      list[k].deviation  = std::abs(list[k].value) * share;
      if (!for_all && share > 0. && list[k].value == 0.)
        throw UserError("'Phases/" + name + "/Relative deviation' gives " +
                        to_text(share) + " for the constant " + list[k].name +
                        ", which is 0 and has no share that deviates; give 0 for it");
    }
  return list;
}

void PhaseParameters::check_deviations(const std::size_t n_constants) const
{
  if (deviations.size() != 1 && deviations.size() != n_constants)
    throw UserError("'Phases/" + name + "/Relative deviation' has " +
                    std::to_string(deviations.size()) + " numbers, and the phase " +
                    std::to_string(n_constants) +
                    " constants; give one number for all or one for each");
}

template VoigtVector<2> PhaseParameters::thermal_stress<2>() const;
template VoigtVector<3> PhaseParameters::thermal_stress<3>() const;
template Eigen::Matrix<double, 2, 2, Eigen::RowMajor>
PhaseParameters::conductivity<2>() const;
template Eigen::Matrix<double, 3, 3, Eigen::RowMajor>
PhaseParameters::conductivity<3>() const;
template std::vector<PhaseConstant<2>> PhaseParameters::constants<2>() const;
template std::vector<PhaseConstant<3>> PhaseParameters::constants<3>() const;
} // namespace mesoslip
