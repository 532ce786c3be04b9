#include "localization/localization_input.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/mesh_datasets.h"
#include "localization/comparison.h"
#include "localization/localization_needs.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

namespace mesoslip
{
namespace
{
/** Whether two boxes agree within the accuracy of independently made grids and meshes. */
template <int dim>
bool same_box(const CellSet<dim> &one, const CellSet<dim> &other)
{
  const auto box = one.box(), other_box = other.box();
  const auto &p = box.get_boundary_points(), &q = other_box.get_boundary_points();
  const double slack =
    (one.is_grid && other.is_grid ? 1e-9 : 1e-6) * p.first.distance(p.second);
  return p.first.distance(q.first) <= slack && p.second.distance(q.second) <= slack;
}

/** "covers the box from (0, 0) m to (1, 1) m, but FILE covers that from ..." */
template <int dim>
std::string
boxes_text(const CellSet<dim> &body, const CellSet<dim> &volume, const std::string &file)
{
  return " covers the box " + corners_text(body.box()) + ", but " + file +
         " covers that " + corners_text(volume.box());
}

template <int dim>
RunSource source_of(const BodySnapshots<dim> &run)
{
  return {run.path(), run.conditions};
}

/** Warnings on values that look like another unit. */
template <int dim>
std::vector<std::string> slips(const LocalizationParameters &parameters,
                               const dealii::BoundingBox<dim> &box)
{
  std::vector<PlausibleRange> ranges;
  for (const double ratio : parameters.out_of_plane_ratio)
    ranges.push_back({"Localization/Out-of-plane ratio", ratio, "", -1.,
                      "less than any Poisson's ratio, which it is in plane strain", 1.,
                      "more than any Poisson's ratio, which it is in plane strain"});
  const auto add = [&](const char *key, const double length, const double most,
                       const std::string &what) {
    ranges.push_back(
      {std::string("Comparison/") + key, length, "m", 0., "", most,
       "more than " + what + quantity_text(most, "m") +
         ", so that no cell is left to be compared apart; lengths are in m"});
  };
  if (!parameters.direct_run.empty())
    {
      double smallest = box.side_length(0);
      for (unsigned int d = 1; d < dim; ++d)
        smallest = std::min(smallest, box.side_length(d));
      add("Surface depth", parameters.surface_depth, box.side_length(dim - 1),
          "the body's ");
      add("Edge distance", parameters.edge_distance, 0.5 * smallest,
          "half of the body's smallest side, ");
    }
  return implausible(ranges);
}
} // namespace

template <int dim>
LocalizationInput<dim>::LocalizationInput(const LocalizationParameters &p,
                                          const LocalizationFiles<dim> &the_files)
  : parameters(p)
  , files(the_files)
  , volume(files.rve, !files.rve.is_mesh())
  , body(files.homogeneous, files.homogeneous.is_grid)
{
  files.out_of_plane_ratios(p); // throws if the ratios are invalid
  if (!files.rve.change_note().empty())
    warnings.push_back(files.rve.change_note());
  // These throw if data are missing or phases differ.
  files.require_tensors(p);
  for_each_piece(volume.n_cells(), volume.cells_in_layer(),
                 [this](const std::size_t first, const std::size_t count) {
                   files.rve.constituent_ids(first, count);
                 });
  CellFinder<dim> in_volume(volume), in_body(body);
  check_run(files.homogeneous, "homogeneous run");
  check_homogeneous();
  compare_boxes(in_body);
  if (files.direct)
    check_direct();
  choose_window();
  for (const auto &sentences :
       {slips(p, volume.box()), pressure_warnings<dim>(files.rve.constituents())})
    warnings.insert(warnings.end(), sentences.begin(), sentences.end());
  find_points(in_body);
  plan_probes(in_volume);
  choose_snapshots();
}

template <int dim>
void LocalizationInput<dim>::check_run(const BodySnapshots<dim> &run,
                                       const std::string &role)
{
  if (!run.change_note().empty())
    warnings.push_back(run.change_note());
  if (!run.rve_digest.empty() && run.rve_digest != files.rve.digest)
    warnings.push_back("the " + role + " " + run.path() +
                       " took its material from an RVE file with the digest " +
                       run.rve_digest + ", but " + files.rve.path() + " has " +
                       files.rve.digest);
}

template <int dim>
void LocalizationInput<dim>::check_homogeneous()
{
  const BodySnapshots<dim> &run         = files.homogeneous;
  const std::vector<Phase<dim>> of_body = run.constituents();
  std::optional<std::uint16_t> before;
  const auto check = [&](const std::size_t first, const std::size_t count) {
    for (const std::uint16_t id : run.constituent_ids(first, count))
      {
        if (before && id != *before &&
            of_body[id].stiffness != of_body[*before].stiffness)
          throw UserError(
            "the homogeneous run " + run.path() +
            " is one of a heterogeneous body, whose strains are local already; "
            "name a run with Body/Material = homogeneous");
        before = id;
      }
  };
  if (!run.materials.shape.empty())
    for_each_piece(body.n_cells(), body.cells_in_layer(), check);
}

template <int dim>
void LocalizationInput<dim>::compare_boxes(CellFinder<dim> &in_body)
{
  plan.is_body = same_box(volume, body);
  if (plan.is_body)
    return find_cells(in_body);
  const std::string both = "the homogeneous run " + files.homogeneous.path() +
                           boxes_text(body, volume, files.rve.path());
  if (parameters.points.empty())
    throw UserError(both + "; run contact_dynamics with a body of this size, or name "
                           "points of the body in Volume element/Points, to have the "
                           "fields of the volume there");
  const bool probes_named =
    !parameters.all_run_probes() && !parameters.run_probes.empty();
  if (probes_named || !parameters.further_probes.empty() ||
      !parameters.direct_run.empty())
    throw UserError(both + ", so the volume is not the body: there are neither probes "
                           "nor a direct run; empty Probes/Of the run, Probes/Further "
                           "and Input/Direct run. The report compares the means at "
                           "the points with those of a direct run in the same report");
}

template <int dim>
void LocalizationInput<dim>::find_cells(CellFinder<dim> &in_body)
{
  // For grids each rank finds the body cells of its own cells.
  if (body.is_grid && volume.is_grid)
    return;
  for (std::size_t k = 0; k < volume.n_cells(); ++k)
    {
      const dealii::Point<dim> centroid = volume.measure(k).centroid;
      const auto cell                   = in_body.find(centroid);
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
void LocalizationInput<dim>::check_direct()
{
  const BodySnapshots<dim> &direct = *files.direct;
  check_run(direct, "direct run");
  direct_body               = CellSet<dim>(direct, direct.is_grid);
  const std::string the_run = "the direct run " + direct.path();
  if (direct.is_grid && volume.is_grid)
    check_direct_grid(the_run);
  else
    check_direct_cells(the_run);
  differences = compare_conditions(source_of(files.homogeneous), source_of(direct),
                                   parameters.allow_different_loads, notes, warnings);
}

/** @throws UserError unless a cell of the volume is of the same material in the direct run */
template <int dim>
void LocalizationInput<dim>::check_material(const std::uint16_t ours,
                                            const std::uint16_t theirs,
                                            const std::size_t cell) const
{
  const auto of_volume = files.rve.constituents(), of_run = files.direct->constituents();
  const auto &stiffness = of_volume[ours].stiffness;
  if (!((stiffness - of_run[theirs].stiffness).norm() <= 1e-9 * stiffness.norm()))
    throw UserError("the direct run " + files.direct->path() +
                    " has another material than " + files.rve.path() +
                    " in the cell at " + point_text(volume.measure(cell).centroid) +
                    "; run contact_dynamics with this RVE file, in which "
                    "Body/Material = heterogeneous");
}

/** Checks that the cells of the run are the cells of the volume, in the same order. */
template <int dim>
void LocalizationInput<dim>::check_direct_cells(const std::string &the_run)
{
  if (direct_body.n_cells() != volume.n_cells())
    throw UserError(the_run + " has " + std::to_string(direct_body.n_cells()) +
                    " cells, " + files.rve.path() + " " +
                    std::to_string(volume.n_cells()) +
                    "; run contact_dynamics with the mesh of the RVE");
  std::set<std::pair<std::uint16_t, std::uint16_t>> checked;
  const auto check = [&](const std::size_t first, const std::size_t count) {
    const auto ours   = files.rve.constituent_ids(first, count),
               theirs = files.direct->constituent_ids(first, count);
    for (std::size_t k = 0; k < count; ++k)
      {
        const CellMeasure<dim> cell     = direct_body.measure(first + k);
        const dealii::Point<dim> middle = volume.measure(first + k).centroid;
        if (!(cell.centroid.distance(middle) <= 1e-6 * std::pow(cell.volume, 1. / dim)))
          throw UserError(the_run + " has other cells than " + files.rve.path() +
                          ", the first at " + point_text(cell.centroid) +
                          "; run contact_dynamics with the mesh of the RVE");
        if (checked.insert({ours[k], theirs[k]}).second)
          check_material(ours[k], theirs[k], first + k);
      }
  };
  for_each_piece(volume.n_cells(), volume.cells_in_layer(), check);
}

/** Checks that the grid of the run is that of the volume or an integer refinement. */
template <int dim>
void LocalizationInput<dim>::check_direct_grid(const std::string &the_run)
{
  const UniformGrid<dim> &fine = direct_body.grid, &coarse = volume.grid;
  if (!same_box(volume, direct_body))
    throw UserError(the_run + boxes_text(direct_body, volume, files.rve.path()) +
                    "; run contact_dynamics with this RVE file");
  std::array<unsigned int, dim> ratio;
  for (unsigned int d = 0; d < dim; ++d)
    {
      ratio[d] = fine.cells[d] / coarse.cells[d];
      if (fine.cells[d] != ratio[d] * coarse.cells[d])
        throw UserError(the_run + " has " + cells_text(fine) +
                        " cells, no whole multiple of the " + cells_text(coarse) +
                        " of " + files.rve.path() +
                        "; run contact_dynamics with the cells of the RVE or a multiple");
    }
  std::set<std::pair<std::uint16_t, std::uint16_t>> checked;
  const std::size_t in_fine = fine.cells_in_layer(), in_coarse = coarse.cells_in_layer();
  const auto check = [&](const std::size_t first, const std::size_t count) {
    const std::size_t above    = first / in_fine / ratio[dim - 1] * in_coarse,
                      n_layers = (first + count - 1) / in_fine / ratio[dim - 1] + 1 -
                                 first / in_fine / ratio[dim - 1];
    const auto ours   = files.rve.constituent_ids(above, n_layers * in_coarse),
               theirs = files.direct->constituent_ids(first, count);
    for (std::size_t k = 0; k < count; ++k)
      {
        auto at = places_of(fine, first + k);
        for (unsigned int d = 0; d < dim; ++d)
          at[d] /= ratio[d];
        const std::size_t cell = CellBlock<dim>{{}, coarse.cells}.number_of(at);
        if (checked.insert({ours[cell - above], theirs[k]}).second)
          check_material(ours[cell - above], theirs[k], cell);
      }
  };
  for_each_piece(fine.n_cells(), in_fine, check);
}

template <int dim>
void LocalizationInput<dim>::choose_window()
{
  if (!std::isnan(parameters.to))
    window.end = parameters.to;
  window.begin = parameters.from;
  if (!std::isnan(parameters.from))
    return;
  window.begin = steady_from(source_of(files.homogeneous));
  if (files.direct)
    window.begin = std::max(window.begin, steady_from(source_of(*files.direct)));
}

template <int dim>
void LocalizationInput<dim>::choose_snapshots()
{
  const bool of_both = parameters.fields.any() || !plan.followed.empty();
  if (!of_both && !(parameters.mean_strain && !probes.empty()))
    return;
  const bool both         = files.direct && of_both;
  const RunSnapshots ours = {files.homogeneous.path(), files.homogeneous.times()};
  RunSnapshots theirs;
  if (both)
    theirs = {files.direct->path(), files.direct->times()};
  const TimeWindow shared = both ? shared_snapshots(ours, theirs, window) : window;
  plan.snapshots          = snapshots_in(ours, shared);
  times                   = times_of(ours.times, plan.snapshots);
  if (both)
    {
      plan.direct_snapshots = snapshots_in(theirs, shared);
      direct_times          = times_of(theirs.times, plan.direct_snapshots);
      if (plan.snapshots.count < snapshots_in(ours, window).count ||
          plan.direct_snapshots.count < snapshots_in(theirs, window).count)
        notes.emplace_back(
          "only the part of the window is taken that both runs have snapshots of");
    }
  if (parameters.fields.deviation && plan.snapshots.count == 1)
    notes.emplace_back("deviations over time are zero, as there is one snapshot only");
}

template <int dim>
void LocalizationInput<dim>::describe(std::ostream &out) const
{
  const auto tell = [&](const CellSet<dim> &cells, const char *role,
                        const IndexRange &used) {
    out << role << ": "
        << (cells.is_grid ? cells_text(cells.grid) : std::to_string(cells.n_cells()))
        << " cells, " << used.count << " snapshot" << (used.count == 1 ? "\n" : "s\n");
  };
  tell(body, "Homogeneous run", plan.snapshots);
  if (files.direct)
    tell(direct_body, "Direct run", plan.direct_snapshots);
  const RankMemory memory = memory_need(*this, mpi::n_mpi_processes(MPI_COMM_WORLD));
  out << volume.n_cells() << " cells of the RVE, "
      << (plan.is_body ? "which is the body, " : "smaller than the body, ")
      << probes.size() << " probes, " << plan.points.size() << " points, about "
      << std::ceil(1e-6 * memory.root) << " MB of memory";
  if (memory.other > 0.)
    out << ", " << std::ceil(1e-6 * memory.other) << " MB on each other rank";
  out << '\n' << bytes_text(disk_need(*this).bytes) << " on the disk\n";
  for (const std::string &warning : warnings)
    out << "warning: " << warning << '\n';
}

template class LocalizationInput<2>;
template class LocalizationInput<3>;
} // namespace mesoslip
