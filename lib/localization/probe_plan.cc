#include "base/errors.h"
#include "localization/comparison.h"
#include "localization/localization_input.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** The cell @p number in the form of localization.h5: for a grid its indices along the
 * axes. */
template <int dim>
std::vector<unsigned int> cell_in_file(const CellSet<dim> &cells,
                                       const std::size_t number)
{
  if (!cells.is_grid)
    return {static_cast<unsigned int>(number)};
  const auto places = places_of(cells.grid, number);
  return {places.begin(), places.end()};
}

/** Whether a point lies in the box of a grid up to round-off. */
template <int dim>
bool is_inside(const UniformGrid<dim> &grid, const dealii::Point<dim> &point)
{
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double x = point[d] - grid.origin[d], slack = 1e-9 * grid.spacing[d];
      if (!(x >= -slack && x <= grid.extent(d) + slack))
        return false;
    }
  return true;
}
} // namespace

/** Converts a position to coordinates: on a grid it counts from the lower left corner. */
template <int dim>
dealii::Point<dim>
LocalizationInput<dim>::place_in(const CellSet<dim> &cells,
                                 const std::vector<double> &position) const
{
  dealii::Point<dim> at;
  for (unsigned int d = 0; d < dim; ++d)
    at[d] = position[d] + (cells.is_grid ? cells.grid.origin[d] : 0.);
  return at;
}

/** The cell that holds the position given by @p key.
 * @throws UserError */
template <int dim>
std::size_t LocalizationInput<dim>::find_place(const LocalizedProbe &asked,
                                               const std::string &key,
                                               const CellSet<dim> &cells,
                                               CellFinder<dim> &finder) const
{
  if (asked.position.size() != dim)
    throw UserError(key + " has " + std::to_string(asked.position.size()) +
                    " numbers, but the body has " + std::to_string(dim) +
                    " dimensions; give one for each");
  const dealii::Point<dim> at = place_in(cells, asked.position);
  std::optional<std::size_t> cell;
  if (!cells.is_grid || is_inside(cells.grid, at))
    cell = finder.find(at);
  if (!cell)
    throw UserError(key + ": " + point_text(at) +
                    " lies outside the body, whose bounding box is " +
                    corners_text(cells.box()));
  return *cell;
}

template <int dim>
void LocalizationInput<dim>::find_points(CellFinder<dim> &in_body)
{
  for (const LocalizedProbe &point : parameters.points)
    {
      const std::string key = "Volume element/" + point.name + "/Position";
      plan.point_cells.push_back(find_place(point, key, body, in_body));
      plan.points.push_back(place_in(body, point.position));
    }
}

template <int dim>
void LocalizationInput<dim>::plan_probes(CellFinder<dim> &in_volume)
{
  if (!plan.is_body)
    return;
  const BodySnapshots<dim> &run = files.homogeneous;
  const auto available          = run.probes();
  for (const std::string &name :
       parameters.all_run_probes() ? available : parameters.run_probes)
    {
      if (std::find(available.begin(), available.end(), name) == available.end())
        throw UserError("Probes/Of the run names '" + name + "', but the probes of " +
                        run.path() + " are: " + to_text(available) +
                        (name == "all" ? "; 'all' stands alone"
                                       : "; give its position under Probes/Further"));
      probes.push_back({{name, run.probe_position(name)}, true, 0, {}, {}});
    }
  for (const LocalizedProbe &probe : parameters.further_probes)
    {
      for (const PlannedProbe &other : probes)
        if (other.name == probe.name)
          throw UserError("Probes/Further: the homogeneous run has a probe " +
                          probe.name + ", too; choose another name");
      probes.push_back({probe, false, 0, {}, {}});
    }
  for (PlannedProbe &probe : probes)
    {
      // A mesh and a grid share one coordinate system.
      LocalizedProbe asked = static_cast<const LocalizedProbe &>(probe);
      if (probe.recorded)
        {
          const dealii::Point<dim> at     = place_in(body, probe.position),
                                   corner = place_in(volume, std::vector<double>(dim));
          for (unsigned int d = 0; d < dim; ++d)
            asked.position[d] = at[d] - corner[d];
        }
      const std::string key  = probe.recorded
                                 ? "the probe " + probe.name + " of " + run.path()
                                 : "Probes/" + probe.name + "/Position";
      const std::size_t cell = find_place(asked, key, volume, in_volume);
      probe.cell             = cell_in_file(volume, cell);
      probe.material         = files.rve.constituent_ids(cell, 1).front();
      probe.phase            = files.rve.materials.phase_of(probe.material);
      probe.phase_name       = files.rve.phases[probe.phase].name;
      plan.probes.push_back(cell);
      if (probe.recorded)
        read_probe(probe);
      else
        plan.followed.push_back(cell);
    }
}

/** Reads the recorded series of a probe. */
template <int dim>
void LocalizationInput<dim>::read_probe(PlannedProbe &probe)
{
  if (parameters.local_strain)
    {
      probe.strain = files.homogeneous.probe(probe.name, "strain", window);
      if (probe.strain.time.empty())
        throw UserError(files.homogeneous.path() + ": the probe " + probe.name +
                        " has no sample " + window_text(window) +
                        "; change Window/From and To");
    }
  if (!files.direct)
    return;
  const std::string name = direct_probe_at(probe);
  if (name.empty())
    warnings.push_back("the direct run " + files.direct->path() +
                       " has no probe at the place of " + probe.name);
  else
    probe.direct = files.direct->probe(name, "stress", window);
}

/** The direct run's probe at the place of @p probe, preferring the same name; or "". */
template <int dim>
std::string LocalizationInput<dim>::direct_probe_at(const PlannedProbe &probe) const
{
  auto names = files.direct->probes();
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string &name) { return name == probe.name; });
  const dealii::Point<dim> ours         = place_in(body, probe.position);
  const dealii::BoundingBox<dim> bounds = body.box();
  for (const std::string &name : names)
    {
      const dealii::Point<dim> theirs =
        place_in(direct_body, files.direct->probe_position(name));
      bool is_near = true;
      for (unsigned int d = 0; d < dim; ++d)
        is_near =
          is_near && std::fabs(ours[d] - theirs[d]) <= 1e-9 * bounds.side_length(d);
      if (is_near)
        return name;
    }
  return "";
}

#define MESOSLIP_INSTANTIATE(dim)                                       \
  template dealii::Point<dim> LocalizationInput<dim>::place_in(         \
    const CellSet<dim> &, const std::vector<double> &) const;           \
  template void LocalizationInput<dim>::find_points(CellFinder<dim> &); \
  template void LocalizationInput<dim>::plan_probes(CellFinder<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
