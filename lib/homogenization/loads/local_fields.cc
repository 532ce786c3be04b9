#include "homogenization/loads/local_fields.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** The stress as a tensor of three axes. */
template <int dim>
Eigen::Matrix3d tensor_of(const VoigtVector<dim> &stress, const double zz)
{
  Eigen::Matrix3d full = Eigen::Matrix3d::Zero();
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      full(c, d) = stress[voigt_index<dim>(c, d)];
  if (dim == 2)
    full(2, 2) = zz;
  return full;
}
} // namespace

template <int dim>
LocalFields<dim>::LocalFields(const std::vector<LoadedPhase<dim>> &the_phases)
  : phases(the_phases)
{
  for (const LoadedPhase<dim> &phase : phases)
    invariants = invariants && (dim == 3 || phase.transverse.has_value());
  for (const char *component : voigt_names<dim>)
    list.push_back({std::string("strain_") + component, "-"});
  for (const char *component : voigt_names<dim>)
    list.push_back({std::string("stress_") + component, "Pa"});
  if (!invariants)
    return;
  if (dim == 2)
    list.push_back({"stress_zz", "Pa"});
  for (const char *name :
       {"von_mises", "hydrostatic", "principal_1", "principal_2", "principal_3"})
    list.push_back({name, "Pa"});
}

template <int dim>
std::size_t LocalFields<dim>::n_parts() const
{
  unsigned int last = 0;
  for (const LoadedPhase<dim> &phase : phases)
    last = std::max(last, phase.part);
  return last + 1;
}

template <int dim>
std::vector<CellDataset> LocalFields<dim>::datasets(const std::string &group,
                                                    const std::size_t first) const
{
  constexpr std::size_t n       = n_voigt<dim>;
  std::vector<CellDataset> sets = {{group + "/strain", n, first},
                                   {group + "/stress", n, first + n}};
  for (std::size_t q = 2 * n; q < n_stored(); ++q)
    sets.push_back({group + "/" + list[q].name, 1, first + q});
  return sets;
}

template <int dim>
void LocalFields<dim>::evaluate(const unsigned int phase,
                                const VoigtVector<dim> &strain,
                                const double heating,
                                double *values) const
{
  const VoigtVector<dim> stress =
    phases[phase].stiffness * strain - heating * phases[phase].thermal_stress;
  double *next = std::copy_n(strain.data(), n_voigt<dim>, values);
  next         = std::copy_n(stress.data(), n_voigt<dim>, next);
  if (!invariants)
    return;
  double zz = 0.;
  if (dim == 2)
    *next++ = zz =
      phases[phase].transverse->dot(strain) - heating * phases[phase].transverse_thermal;
  const Eigen::Matrix3d sigma    = tensor_of<dim>(stress, zz);
  const double hydrostatic       = sigma.trace() / 3.;
  const Eigen::Matrix3d deviator = sigma - hydrostatic * Eigen::Matrix3d::Identity();
  *next++                        = std::sqrt(1.5) * deviator.norm();
  *next++                        = hydrostatic;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sigma,
                                                              Eigen::EigenvaluesOnly);
  for (Eigen::Index k = 2; k >= 0; --k)
    *next++ = solver.eigenvalues()[k];
}

template class LocalFields<2>;
template class LocalFields<3>;
} // namespace mesoslip
