#include "localization/mesh/mesh_input.h"

#include "base/errors.h"
#include "exchange/mesh_datasets.h"
#include "localization/comparison.h"
#include "localization/mesh/memory_need.h"
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
std::vector<unsigned int> cell_in_file(const CellSet<dim> &cells,
                                       const std::size_t number)
{
  if (!cells.is_grid)
    return {static_cast<unsigned int>(number)};
  const auto places = places_of(cells.grid, number);
  return {places.begin(), places.end()};
}

/** The times of @p all in the range. */
std::vector<double> times_of(const std::vector<double> &all, const IndexRange &range)
{
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(range.first);
  return {first, first + static_cast<std::ptrdiff_t>(range.count)};
}
} // namespace

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
}

template <int dim>
std::size_t LocalizationFiles<dim>::cells_in_row() const
{
  std::size_t n = 1;
  for (std::size_t axis = 1; axis < shape().size(); ++axis)
    n *= shape()[axis];
  return n;
}

template <int dim>
MeshLocalizationInput<dim>::MeshLocalizationInput(const LocalizationParameters &p,
                                                  const LocalizationFiles<dim> &the_files)
  : parameters(p)
  , files(the_files)
  , volume(files.rve, !files.rve.is_mesh())
  , body(files.homogeneous, files.homogeneous.is_grid)
{
  out_of_plane_ratios(p, files.rve); // tells what is wrong with them
  for (const std::string &note :
       {files.rve.change_note(), files.homogeneous.change_note()})
    if (!note.empty())
      warnings.push_back(note);
  files.rve.concentration(p.concentration, 0, 1); // tells what is wrong with them
  for_cells(nullptr, [](std::size_t, std::uint16_t, std::uint16_t) {});
  check_homogeneous();
  compare_boxes();
  find_places();
  if (files.direct)
    check_direct();
  choose_snapshots();
}

/** Calls @p treat (number, material in the volume, material in @p run, if any) for each cell
 * of the volume; few of them are in memory. */
template <int dim>
template <typename Treat>
void MeshLocalizationInput<dim>::for_cells(const BodySnapshots<dim> *run,
                                           const Treat &treat) const
{
  const std::size_t n_cells = volume.n_cells();
  for_each_piece(
    n_cells, files.cells_in_row(), [&](const std::size_t first, const std::size_t count) {
      const auto ours   = files.rve.constituent_ids(first, count),
                 theirs = run != nullptr ? run->constituent_ids(first, count) : ours;
      for (std::size_t k = 0; k < count; ++k)
        treat(first + k, ours[k], theirs[k]);
    });
}

template <int dim>
void MeshLocalizationInput<dim>::check_homogeneous()
{
  const BodySnapshots<dim> &run         = files.homogeneous;
  const std::vector<Phase<dim>> of_body = run.constituents();
  std::optional<std::uint16_t> before;
  const auto check = [&](const std::size_t first, const std::size_t count) {
    for (const std::uint16_t id : run.constituent_ids(first, count))
      {
        if (before && of_body[id].stiffness != of_body[*before].stiffness)
          throw UserError(
            "the homogeneous run " + run.path() +
            " is one of a heterogeneous body, whose strains are local already; "
            "name a run with Body/Material = homogeneous");
        before = id;
      }
  };
  for_each_piece(body.n_cells(), body.n_cells_in_row(), check);
  if (!run.rve_digest.empty() && run.rve_digest != files.rve.digest)
    warnings.push_back("the homogeneous run " + run.path() +
                       " took its material from an RVE file with the digest " +
                       run.rve_digest + ", but " + files.rve.path() + " has " +
                       files.rve.digest);
}

template <int dim>
void MeshLocalizationInput<dim>::compare_boxes()
{
  const dealii::BoundingBox<dim> ours = volume.box(), theirs = body.box();
  plan.is_body = same_box(ours, theirs);
  if (plan.is_body)
    return find_cells();
  const std::string both = "the homogeneous run " + files.homogeneous.path() +
                           " covers the box " + corners_text(theirs) + ", but " +
                           files.rve.path() + " covers that " + corners_text(ours);
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
  // Of a grid each rank finds those that hold its cells.
  if (body.is_grid && volume.is_grid)
    return;
  const CellFinder<dim> finder(body);
  for (std::size_t k = 0; k < volume.n_cells(); ++k)
    {
      const dealii::Point<dim> centroid = volume.measure(k).centroid;
      const auto cell                   = finder.find(centroid);
      if (!cell)
        throw UserError("the cell of " + files.rve.path() + " at " +
                        point_text(centroid) + " lies outside the body of " +
                        files.homogeneous.path() +
                        "; both have to be meshes of the same body");
      if (!body.is_grid)
        body_cell.push_back(static_cast<unsigned int>(*cell));
    }
}

template <int dim>
void MeshLocalizationInput<dim>::find_places()
{
  if (!parameters.all_run_probes() && !parameters.run_probes.empty())
    throw UserError("Probes/Of the run names '" + parameters.run_probes[0] +
                    "', but with meshes the probes of the run are not used; give its "
                    "position under Probes/Further");
  const auto find = [](const LocalizedProbe &asked, const std::string &section,
                       const CellSet<dim> &cells) {
    const std::string key = section + "/" + asked.name + "/Position";
    if (asked.position.size() != dim)
      throw UserError(key + " has " + std::to_string(asked.position.size()) +
                      " numbers, but the body has " + std::to_string(dim) +
                      " dimensions; give one for each");
    dealii::Point<dim> at;
    for (unsigned int d = 0; d < dim; ++d)
      at[d] = asked.position[d];
    const auto cell = CellFinder<dim>(cells).find(at);
    if (!cell)
      throw UserError(key + ": " + point_text(at) +
                      " lies outside the body, whose bounding box is " +
                      corners_text(cells.box()));
    return std::make_pair(at, *cell);
  };
  for (const LocalizedProbe &point : parameters.points)
    {
      const auto [at, cell] = find(point, "Volume element", body);
      plan.points.push_back(at);
      plan.point_cells.push_back(cell);
    }
  for (const LocalizedProbe &probe : parameters.further_probes)
    {
      const std::size_t cell = find(probe, "Probes", volume).second;
      plan.probes.push_back(cell);
      LocalizedProbe &found = probes.emplace_back(probe);
      found.cell            = cell_in_file(volume, cell);
      found.phase =
        files.rve.materials.phase_of(files.rve.constituent_ids(cell, 1).front());
      found.phase_name = files.rve.phases[found.phase].name;
    }
}

template <int dim>
void MeshLocalizationInput<dim>::check_direct()
{
  const BodySnapshots<dim> &direct = *files.direct;
  if (!direct.change_note().empty())
    warnings.push_back(direct.change_note());
  direct_body            = CellSet<dim>(direct, direct.is_grid);
  const std::string what = "the direct run " + direct.path();
  if (direct_body.n_cells() != volume.n_cells())
    throw UserError(what + " has " + std::to_string(direct_body.n_cells()) + " cells, " +
                    files.rve.path() + " " + std::to_string(volume.n_cells()) +
                    "; run contact_dynamics with the mesh of the RVE");
  const std::vector<Phase<dim>> ours   = files.rve.constituents(),
                                theirs = direct.constituents();
  for_cells(&direct, [&](const std::size_t k, const std::uint16_t a,
                         const std::uint16_t b) {
    const CellMeasure<dim> measure  = direct_body.measure(k);
    const dealii::Point<dim> middle = volume.measure(k).centroid;
    if (!(measure.centroid.distance(middle) <= 1e-6 * std::pow(measure.volume, 1. / dim)))
      throw UserError(what + " has other cells than " + files.rve.path() +
                      ", the first at " + point_text(measure.centroid) +
                      "; run contact_dynamics with the mesh of the RVE");
    const auto &stiffness = ours[a].stiffness;
    if (!((stiffness - theirs[b].stiffness).norm() <= 1e-9 * stiffness.norm()))
      throw UserError(what + " has another material than " + files.rve.path() +
                      " in the cell at " + point_text(middle) +
                      "; run contact_dynamics with the phases of the RVE");
  });
  differences =
    compare_conditions({files.homogeneous.path(), files.homogeneous.conditions},
                       {direct.path(), direct.conditions},
                       parameters.allow_different_loads, notes, warnings);
}

template <int dim>
void MeshLocalizationInput<dim>::choose_snapshots()
{
  const auto begin = [this](const BodySnapshots<dim> &run) {
    return std::isnan(parameters.from) ? steady_from({run.path(), run.conditions})
                                       : parameters.from;
  };
  TimeWindow window;
  window.begin = begin(files.homogeneous);
  if (files.direct)
    window.begin = std::max(window.begin, begin(*files.direct));
  if (!std::isnan(parameters.to))
    window.end = parameters.to;
  const RunSnapshots ours = {files.homogeneous.path(), files.homogeneous.times()};
  if (files.direct)
    {
      const RunSnapshots theirs = {files.direct->path(), files.direct->times()};
      window                    = shared_snapshots(ours, theirs, window);
      plan.direct_snapshots     = snapshots_in(theirs, window);
      plan.direct_times         = times_of(theirs.times, plan.direct_snapshots);
    }
  plan.snapshots = snapshots_in(ours, window);
  plan.times     = times_of(ours.times, plan.snapshots);
}

template <int dim>
ResourceNeed MeshLocalizationInput<dim>::need() const
{
  const double with_direct = files.direct ? 1. : 0.;
  const double n_variants  = !plan.is_body ? 0.
                                           : (parameters.local_strain ? 1. : 0.) +
                                              (parameters.mean_strain ? 1. : 0.);
  LocalizationExtent extent;
  extent.n_cells = static_cast<double>(volume.n_cells());
  if (!volume.is_grid)
    extent.mesh_bytes =
      static_cast<double>(sizeof(double) * dim * volume.n_points() +
                          sizeof(unsigned int) * topology_size(volume.mesh));
  extent.n_field_sets = n_variants * (1. + with_direct) + with_direct +
                        static_cast<double>(plan.points.size());
  extent.n_series  = n_variants * static_cast<double>(probes.size());
  extent.n_numbers = extent.n_series * static_cast<double>(plan.snapshots.count) *
                     (1. + n_voigt<dim> * (1. + with_direct));
  return need_of<dim>(extent, parameters.fields);
}

template <int dim>
void MeshLocalizationInput<dim>::describe(std::ostream &out) const
{
  out << "Homogeneous run: " << body.n_cells() << " cells, " << plan.snapshots.count
      << " snapshots\n";
  if (files.direct)
    out << "Direct run: " << direct_body.n_cells() << " cells, "
        << plan.direct_snapshots.count << " snapshots\n";
  const RankMemory memory =
    memory_need(*this, dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
  out << volume.n_cells() << " cells of the RVE, "
      << (plan.is_body ? "which is the body, " : "smaller than the body, ")
      << probes.size() << " probes, " << plan.points.size() << " points, about "
      << std::ceil(1e-6 * memory.root) << " MB of memory";
  if (memory.other > 0.)
    out << ", " << std::ceil(1e-6 * memory.other) << " MB on each other rank";
  out << '\n' << bytes_text(need().bytes) << " on the disk\n";
  for (const std::string &warning : warnings)
    out << "warning: " << warning << '\n';
}

template struct LocalizationFiles<2>;
template struct LocalizationFiles<3>;
template class MeshLocalizationInput<2>;
template class MeshLocalizationInput<3>;
} // namespace mesoslip
