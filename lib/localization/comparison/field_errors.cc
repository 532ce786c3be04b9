#include "localization/comparison/field_errors.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

namespace mesoslip
{
namespace
{
/** Component @p c of @p components of a field, over a region. */
FieldError compare(const std::vector<double> &localized,
                   const std::vector<double> &direct,
                   const std::size_t components,
                   const std::size_t c,
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
  const double n = static_cast<double>(std::max<std::size_t>(region.cells.size(), 1));
  return {"",
          region.name,
          region.cells.size(),
          std::sqrt(ours / n),
          std::sqrt(theirs / n),
          theirs > 0. ? std::sqrt(squares / theirs)
                      : std::numeric_limits<double>::quiet_NaN()};
}
} // namespace

std::vector<CellRegion> comparison_regions(const UniformGrid<2> &grid,
                                           const std::vector<std::uint8_t> &phase,
                                           const std::vector<Phase<2>> &phases,
                                           const double surface_depth,
                                           const double edge_distance)
{
  std::vector<CellRegion> regions = {
    {"all", {}}, {"surface", {}}, {"bulk", {}}, {"interior", {}}, {"surface_inner", {}}};
  const std::size_t n_places = regions.size();
  for (const Phase<2> &of_cells : phases)
    {
      const bool taken =
        std::any_of(regions.begin(), regions.end(), [&](const CellRegion &region) {
          return region.name == of_cells.name;
        });
      regions.push_back({(taken ? "phase_" : "") + of_cells.name, {}});
      regions.push_back({regions.back().name + "_interior", {}});
    }
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell)
    {
      const std::size_t i = cell % grid.cells[0], j = cell / grid.cells[0];
      const double x = (i + 0.5) * grid.spacing[0], y = (j + 0.5) * grid.spacing[1];
      const bool inner    = std::min(x, grid.extent(0) - x) >= edge_distance;
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
  for (const StressField &field : stress_fields())
    {
      const auto &ours = localized.*field.values, &theirs = direct.*field.values;
      const std::size_t n = field.quantities.size();
      for (std::size_t c = 0; c < n && !ours.empty() && !theirs.empty(); ++c)
        for (const CellRegion &region : regions)
          {
            errors.push_back(compare(ours, theirs, n, c, region));
            errors.back().quantity = field.quantities[c];
          }
    }
  return errors;
}

StressFields difference(const StressFields &localized, const StressFields &direct)
{
  StressFields result;
  for (const StressField &field : stress_fields())
    {
      const auto &ours = localized.*field.values, &theirs = direct.*field.values;
      AssertDimension(ours.size(), theirs.size());
      std::transform(ours.begin(), ours.end(), theirs.begin(),
                     std::back_inserter(result.*field.values), std::minus<>());
    }
  return result;
}
} // namespace mesoslip
