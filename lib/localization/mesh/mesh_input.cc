#include "localization/mesh/mesh_input.h"

#include "base/errors.h"
#include "exchange/mesh_datasets.h"
#include "localization/comparison.h"
#include "localization/mesh/memory_need.h"
#include "mesh/cell_gradients.h"
#include "mesh/cell_locator.h"
#include "parameters/parameters.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace mesoslip
{
namespace
{
template <int dim>
std::string point_text(const dealii::Point<dim> &point)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d == 0 ? "(" : ", ") + to_text(point[d]);
  return text + ") m";
}

template <int dim>
std::string corners_text(const dealii::BoundingBox<dim> &box)
{
  return "from " + point_text(box.get_boundary_points().first) + " to " +
         point_text(box.get_boundary_points().second);
}

/** Whether two boxes are one, as far as meshes that are made apart can be. */
template <int dim>
bool same_box(const dealii::BoundingBox<dim> &a, const dealii::BoundingBox<dim> &b)
{
  const auto &p = a.get_boundary_points(), &q = b.get_boundary_points();
  const double slack = 1e-6 * p.first.distance(p.second);
  return p.first.distance(q.first) <= slack && p.second.distance(q.second) <= slack;
}

/** The cell @p number as localization.h5 has it: its places along the axes of a grid. */
template <int dim>
std::vector<unsigned int> cell_in_file(const RveFile<dim> &rve, unsigned int number)
{
  if (rve.is_mesh())
    return {number};
  std::vector<unsigned int> places;
  for (const unsigned int n : rve.grid.cells)
    {
      places.push_back(number % n);
      number /= n;
    }
  return places;
}

/** The times of @p all in the range. */
std::vector<double> times_of(const std::vector<double> &all, const IndexRange &range)
{
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(range.first);
  return {first, first + static_cast<std::ptrdiff_t>(range.count)};
}
} // namespace

template <int dim>
MeshLocalizationInput<dim>::MeshLocalizationInput(const LocalizationParameters &p)
  : parameters(p)
  , rve(p.rve_file)
  , homogeneous(p.homogeneous_run, "the homogeneous run; run contact_dynamics first")
  , volume(rve.mesh())
  , orientations(rve.orientations())
  , materials(oriented_phases(rve.phases, orientations.materials))
  , body(homogeneous.mesh())
  , out_of_plane_ratio(out_of_plane_ratios(p, rve))
{
  for (const std::string &note : {rve.change_note(), homogeneous.change_note()})
    if (!note.empty())
      warnings.push_back(note);
  centroids.reserve(volume.cells.size());
  measures.reserve(volume.cells.size());
  for (const auto &cell : volume.cells)
    {
      const CellMeasure<dim> measure = cell_measure(volume, cell.vertices);
      centroids.push_back(measure.centroid);
      measures.push_back(measure.volume);
    }
  rve.concentration(p.concentration, 0, 1); // tells what is wrong with them
  check_homogeneous();
  compare_boxes();
  find_places();
  if (!p.direct_run.empty())
    check_direct();
  choose_snapshots();
}

template <int dim>
void MeshLocalizationInput<dim>::check_homogeneous()
{
  const std::vector<Phase<dim>> of_body = homogeneous.materials();
  const auto &first                     = of_body[body.cells[0].material_id].stiffness;
  for (const auto &cell : body.cells)
    if (of_body[cell.material_id].stiffness != first)
      throw UserError("the homogeneous run " + homogeneous.path() +
                      " is one of a heterogeneous body, whose strains are local already; "
                      "name a run with Body/Material = homogeneous");
  if (!homogeneous.rve_digest.empty() && homogeneous.rve_digest != rve.digest)
    warnings.push_back("the homogeneous run " + homogeneous.path() +
                       " took its material from an RVE file with the digest " +
                       homogeneous.rve_digest + ", but " + rve.path() + " has " +
                       rve.digest);
}

template <int dim>
void MeshLocalizationInput<dim>::compare_boxes()
{
  const dealii::BoundingBox<dim> ours(volume.points), theirs(body.points);
  const bool same = same_box(ours, theirs);
  if (same)
    return find_cells();
  const std::string both = "the homogeneous run " + homogeneous.path() +
                           " covers the box " + corners_text(theirs) + ", but " +
                           rve.path() + " covers that " + corners_text(ours);
  if (parameters.points.empty())
    throw UserError(both + "; run contact_dynamics with a body of this size, or name "
                           "points of the body in Volume element/Points, to have the "
                           "fields of the volume there");
  if (!parameters.further_probes.empty() || !parameters.direct_run.empty())
    throw UserError(both + ", so the volume is not the body: there are neither probes "
                           "nor a direct run; empty Probes/Further and Input/Direct run");
}

template <int dim>
void MeshLocalizationInput<dim>::find_cells()
{
  const CellLocator<dim> locator(body);
  body_cell.reserve(centroids.size());
  for (const dealii::Point<dim> &centroid : centroids)
    {
      const auto cell = locator.find(centroid);
      if (!cell)
        throw UserError("the cell of " + rve.path() + " at " + point_text(centroid) +
                        " lies outside the body of " + homogeneous.path() +
                        "; both have to be meshes of the same body");
      body_cell.push_back(*cell);
    }
}

template <int dim>
void MeshLocalizationInput<dim>::find_places()
{
  if (!parameters.all_run_probes() && !parameters.run_probes.empty())
    throw UserError("Probes/Of the run names '" + parameters.run_probes[0] +
                    "', but with meshes the probes of the run are not used; give its "
                    "position under Probes/Further");
  const auto add = [&](const LocalizedProbe &asked, const std::string &section,
                       const Mesh<dim> &mesh, std::vector<Place> &places) {
    const std::string key = section + "/" + asked.name + "/Position";
    if (asked.position.size() != dim)
      throw UserError(key + " has " + std::to_string(asked.position.size()) +
                      " numbers, but the body has " + std::to_string(dim) +
                      " dimensions; give one for each");
    Place place = {asked, {}, 0};
    for (unsigned int d = 0; d < dim; ++d)
      place.at[d] = asked.position[d];
    const auto cell = CellLocator<dim>(mesh).find(place.at);
    if (!cell)
      throw UserError(key + ": " + point_text(place.at) +
                      " lies outside the body, whose bounding box is " +
                      corners_text(dealii::BoundingBox<dim>(mesh.points)));
    place.cell = *cell;
    places.push_back(place);
  };
  for (const LocalizedProbe &point : parameters.points)
    add(point, "Volume element", body, points);
  for (const LocalizedProbe &probe : parameters.further_probes)
    {
      add(probe, "Probes", volume, probes);
      LocalizedProbe &found = probes.back().probe;
      found.cell            = cell_in_file(rve, probes.back().cell);
      found.phase           = volume.cells[probes.back().cell].material_id;
      found.phase_name      = rve.phases[found.phase].name;
    }
}

template <int dim>
void MeshLocalizationInput<dim>::check_direct()
{
  direct = std::make_unique<BodySnapshots<dim>>(
    parameters.direct_run, "the direct run; run contact_dynamics first");
  if (!direct->change_note().empty())
    warnings.push_back(direct->change_note());
  direct_body                             = direct->mesh();
  const std::vector<Phase<dim>> of_direct = direct->materials();
  const std::string what                  = "the direct run " + direct->path();
  if (direct_body.cells.size() != volume.cells.size())
    throw UserError(what + " has " + std::to_string(direct_body.cells.size()) +
                    " cells, " + rve.path() + " " + std::to_string(volume.cells.size()) +
                    "; run contact_dynamics with the mesh of the RVE");
  for (std::size_t k = 0; k < volume.cells.size(); ++k)
    {
      const auto measure = cell_measure(direct_body, direct_body.cells[k].vertices);
      if (!(measure.centroid.distance(centroids[k]) <=
            1e-6 * std::pow(measure.volume, 1. / dim)))
        throw UserError(what + " has other cells than " + rve.path() + ", the first at " +
                        point_text(measure.centroid) +
                        "; run contact_dynamics with the mesh of the RVE");
      const auto &ours   = materials[material_of(k)].stiffness;
      const auto &theirs = of_direct[direct_body.cells[k].material_id].stiffness;
      if (!((ours - theirs).norm() <= 1e-9 * ours.norm()))
        throw UserError(what + " has another material than " + rve.path() +
                        " in the cell at " + point_text(centroids[k]) +
                        "; run contact_dynamics with the phases of the RVE");
    }
  differences = compare_conditions({homogeneous.path(), homogeneous.conditions},
                                   {direct->path(), direct->conditions},
                                   parameters.allow_different_loads, notes, warnings);
}

template <int dim>
void MeshLocalizationInput<dim>::choose_snapshots()
{
  const auto begin = [this](const BodySnapshots<dim> &run) {
    return std::isnan(parameters.from) ? steady_from({run.path(), run.conditions})
                                       : parameters.from;
  };
  window.begin = begin(homogeneous);
  if (direct)
    window.begin = std::max(window.begin, begin(*direct));
  if (!std::isnan(parameters.to))
    window.end = parameters.to;
  const RunSnapshots ours = {homogeneous.path(), homogeneous.times()};
  RunSnapshots theirs;
  if (direct)
    {
      theirs           = {direct->path(), direct->times()};
      window           = shared_snapshots(ours, theirs, window);
      direct_snapshots = snapshots_in(theirs, window);
      direct_times     = times_of(theirs.times, direct_snapshots);
    }
  snapshots = snapshots_in(ours, window);
  times     = times_of(ours.times, snapshots);
}

template <int dim>
ResourceNeed MeshLocalizationInput<dim>::need() const
{
  const double with_direct = direct ? 1. : 0.;
  const double n_variants =
    !is_body() ? 0.
               : (parameters.local_strain ? 1. : 0.) + (parameters.mean_strain ? 1. : 0.);
  LocalizationExtent extent;
  extent.n_cells = static_cast<double>(volume.cells.size());
  if (rve.is_mesh())
    extent.mesh_bytes = static_cast<double>(sizeof(double) * dim * volume.points.size() +
                                            sizeof(unsigned int) * topology_size(volume));
  extent.n_field_sets =
    n_variants * (1. + with_direct) + with_direct + static_cast<double>(points.size());
  extent.n_series  = n_variants * static_cast<double>(probes.size());
  extent.n_numbers = extent.n_series * static_cast<double>(snapshots.count) *
                     (1. + n_voigt<dim> * (1. + with_direct));
  return need_of<dim>(extent, parameters.fields);
}

template <int dim>
void MeshLocalizationInput<dim>::describe(std::ostream &out) const
{
  out << "Homogeneous run: " << body.cells.size() << " cells, " << snapshots.count
      << " snapshots\n";
  if (direct)
    out << "Direct run: " << direct_body.cells.size() << " cells, "
        << direct_snapshots.count << " snapshots\n";
  const RankMemory memory =
    memory_need(*this, dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  out << volume.cells.size() << " cells of the RVE, "
      << (is_body() ? "which is the body, " : "smaller than the body, ") << probes.size()
      << " probes, " << points.size() << " points, about "
      << std::ceil(1e-6 * memory.root) << " MB of memory";
  if (memory.other > 0.)
    out << ", " << std::ceil(1e-6 * memory.other) << " MB on each other rank";
  out << '\n' << bytes_text(need().bytes) << " on the disk\n";
  for (const std::string &warning : warnings)
    out << "warning: " << warning << '\n';
}

template class MeshLocalizationInput<2>;
template class MeshLocalizationInput<3>;
} // namespace mesoslip
