#include "localization/comparison/field_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Component @p c of @p components of a field, over a region. */
FieldError compare(const std::vector<double> &localized,
                   const std::vector<double> &direct,
                   const unsigned int components,
                   const unsigned int c,
                   const CellRegion &region)
{
  double ours = 0., theirs = 0., squares = 0.;
  for (const std::size_t cell : region.cells)
    {
      const double a = localized[cell * components + c];
      const double b = direct[cell * components + c];
      ours += a * a;
      theirs += b * b;
      squares += (a - b) * (a - b);
    }
  FieldError error;
  error.region     = region.name;
  error.n_cells    = region.cells.size();
  const double n   = static_cast<double>(std::max<std::size_t>(error.n_cells, 1));
  error.rms        = std::sqrt(ours / n);
  error.direct_rms = std::sqrt(theirs / n);
  error.relative =
    theirs > 0. ? std::sqrt(squares / theirs) : std::numeric_limits<double>::quiet_NaN();
  return error;
}

void compare_all(const std::vector<double> &localized,
                 const std::vector<double> &direct,
                 const std::vector<std::string> &names,
                 const std::vector<CellRegion> &regions,
                 std::vector<FieldError> &errors)
{
  if (localized.empty() || direct.size() != localized.size())
    return;
  const unsigned int n = static_cast<unsigned int>(names.size());
  for (unsigned int c = 0; c < n; ++c)
    for (const CellRegion &region : regions)
      {
        errors.push_back(compare(localized, direct, n, c, region));
        errors.back().quantity = names[c];
      }
}

std::vector<double> minus(const std::vector<double> &a, const std::vector<double> &b)
{
  if (a.size() != b.size())
    return {};
  std::vector<double> result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), std::minus<>());
  return result;
}
} // namespace

std::vector<CellRegion> comparison_regions(const UniformGrid<2> &grid,
                                           const std::vector<std::uint8_t> &phase,
                                           const std::vector<std::string> &phase_names,
                                           const double surface_depth,
                                           const double edge_distance)
{
  std::vector<CellRegion> regions = {
    {"all", {}}, {"surface", {}}, {"bulk", {}}, {"interior", {}}, {"surface_inner", {}}};
  const std::size_t n_places = regions.size();
  for (const std::string &name : phase_names)
    {
      const bool taken =
        std::any_of(regions.begin(), regions.end(),
                    [&](const CellRegion &region) { return region.name == name; });
      regions.push_back({(taken ? "phase_" : "") + name, {}});
      regions.push_back({regions.back().name + "_interior", {}});
    }
  std::size_t cell = 0;
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i, ++cell)
      {
        const double x = (i + 0.5) * grid.spacing[0], y = (j + 0.5) * grid.spacing[1];
        const double side   = std::min(x, grid.extent(0) - x);
        const bool inner    = side >= edge_distance;
        const bool surface  = y < surface_depth;
        const bool interior = inner && std::min(y, grid.extent(1) - y) >= edge_distance;
        const bool member[] = {true, surface, !surface, interior, surface && inner};
        for (std::size_t r = 0; r < n_places; ++r)
          if (member[r])
            regions[r].cells.push_back(cell);
        const std::size_t of_phase = n_places + std::size_t{2} * phase[cell];
        regions[of_phase].cells.push_back(cell);
        if (interior)
          regions[of_phase + 1].cells.push_back(cell);
      }
  return regions;
}

std::vector<FieldError> field_errors(const StressFields &localized,
                                     const StressFields &direct,
                                     const std::vector<CellRegion> &regions)
{
  std::vector<FieldError> errors;
  compare_all(localized.mean_von_mises, direct.mean_von_mises, {"mean_von_mises"},
              regions, errors);
  compare_all(localized.mean_stress, direct.mean_stress,
              {"mean_sigma_xx", "mean_sigma_yy", "mean_sigma_xy"}, regions, errors);
  compare_all(localized.deviation_stress, direct.deviation_stress,
              {"deviation_sigma_xx", "deviation_sigma_yy", "deviation_sigma_xy"}, regions,
              errors);
  return errors;
}

StressFields difference(const StressFields &localized, const StressFields &direct)
{
  StressFields result;
  result.mean_von_mises   = minus(localized.mean_von_mises, direct.mean_von_mises);
  result.mean_stress      = minus(localized.mean_stress, direct.mean_stress);
  result.deviation_stress = minus(localized.deviation_stress, direct.deviation_stress);
  return result;
}
} // namespace mesoslip
