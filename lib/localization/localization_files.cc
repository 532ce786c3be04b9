#include "localization/localization_files.h"

#include "base/errors.h"
#include "material/engineering_constants.h"

#include <cmath>

namespace mesoslip
{
template <int dim>
LocalizationFiles<dim>::LocalizationFiles(const LocalizationParameters &p,
                                          const bool is_root)
  : rve(is_root ? RveFile<dim>(p.rve_file) : RveFile<dim>::open_too(p.rve_file))
  , homogeneous(is_root
                  ? BodySnapshots<dim>(p.homogeneous_run,
                                       "the homogeneous run; run contact_dynamics first")
                  : BodySnapshots<dim>::open_too(p.homogeneous_run))
{
  if (!p.direct_run.empty())
    direct = std::make_unique<BodySnapshots<dim>>(
      is_root
        ? BodySnapshots<dim>(p.direct_run, "the direct run; run contact_dynamics first")
        : BodySnapshots<dim>::open_too(p.direct_run));
  // A counter body is shifted against its volume: if both have the same size, the volume
  // takes the body's origin.
  bool as_large = are_grids();
  for (unsigned int d = 0; d < dim && as_large; ++d)
    as_large = std::fabs(rve.grid.extent(d) - homogeneous.grid.extent(d)) <=
               1e-9 * rve.grid.extent(d);
  if (as_large)
    rve.grid.origin = homogeneous.grid.origin;
}

template <int dim>
std::vector<std::string> LocalizationFiles<dim>::phase_names() const
{
  std::vector<std::string> names;
  for (const Phase<dim> &phase : rve.phases)
    names.push_back(phase.name);
  return names;
}

template <int dim>
std::vector<double> LocalizationFiles<dim>::out_of_plane_ratios(
  const LocalizationParameters &parameters) const
{
  const std::size_t n        = rve.phases.size();
  std::vector<double> ratios = parameters.out_of_plane_ratio;
  if (dim == 3 && !ratios.empty())
    throw UserError("Localization/Out-of-plane ratio has no effect, as the stresses of "
                    "three dimensions are all computed; remove it");
  if (ratios.size() == 1)
    ratios.assign(n, ratios[0]);
  if (ratios.empty())
    for (const Phase<dim> &phase : rve.phases)
      ratios.push_back(closest_isotropic<dim>(phase.stiffness).poisson_ratio);
  if (ratios.size() != n)
    throw UserError("Localization/Out-of-plane ratio: " + std::to_string(ratios.size()) +
                    " numbers found, but " + rve.path() + " has " + std::to_string(n) +
                    " phases; give one for each, or leave it empty");
  return ratios;
}

template struct LocalizationFiles<2>;
template struct LocalizationFiles<3>;
} // namespace mesoslip
