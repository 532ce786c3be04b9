#include "base/object_exchange.h"
#include "base/timer.h"
#include "localization/localization_program.h"
#include "localization/mean_concentration.h"
#include "localization/probe_series.h"
#include "localization/snapshot_pass.h"
#include "localization/volume_share.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Computes a localization, from the files to the result. */
template <int dim>
class Localizer
{
public:
  Localizer(const LocalizationParameters &p,
            const LocalizationFiles<dim> &the_files,
            const LocalizationPlan<dim> &the_plan,
            LocalizationInput<dim> *of_root,
            const MPI_Comm communicator,
            const LocalizationMonitor &the_monitor)
    : parameters(p)
    , files(the_files)
    , plan(the_plan)
    , input(of_root)
    , ranks(communicator)
    , monitor(the_monitor)
    , share(make_share(files, plan, volume(), ranks))
  {
  }

  LocalizationResult run()
  {
    result.communicator = ranks;
    result.first_row    = share.first_layer;
    result.fields       = parameters.fields;
    result.is_compared  = files.direct != nullptr;
    if (result.is_compared)
      pass_direct();
    pass_homogeneous();
    const auto scope = optional_scope(monitor.timer, "Probes and errors");
    if (input != nullptr)
      evaluate_probes(*input, series, result);
    compare_fields();
    tell_sampling();
    return std::move(result);
  }

private:
  /** The cells of the volume on rank 0; empty on other ranks. */
  const CellSet<dim> &volume() const
  {
    return input != nullptr ? input->volume : nothing;
  }

  /** Places requested in the cells of this rank. */
  StrainPlaces<dim> places(const BodySnapshots<dim> &run, const IndexRange &snapshots)
  {
    StrainPlaces<dim> where;
    where.n_in_row  = share.n_in_row;
    where.snapshots = snapshots;
    if (!plan.is_body)
      return where;
    where.n_cells     = share.n_cells;
    where.first_layer = share.first_layer;
    if (run.is_grid && !files.rve.is_mesh())
      where.grid = &files.rve.grid;
    else
      where.middles = middles();
    return where;
  }

  /** Centroids of the cells of this rank (m); not needed if volume and body are grids. */
  std::vector<dealii::Point<dim>> middles() const
  {
    if (!share.middles.empty() || share.n_cells == 0)
      return share.middles;
    std::vector<dealii::Point<dim>> centres;
    for (std::size_t k = share.first; k < share.first + share.n_cells; ++k)
      centres.push_back(middle_of<dim>(files.rve.grid, places_of(files.rve.grid, k)));
    return centres;
  }

  std::unique_ptr<StrainSource<dim>> source_of(const BodySnapshots<dim> &run,
                                               const StrainPlaces<dim> &where,
                                               const CellSet<dim> *of_root,
                                               const std::vector<unsigned int> &cells)
  {
    return run.is_grid
             ? make_grid_source(run, where, ranks)
             : make_mesh_source(run, of_root != nullptr ? of_root->mesh : nothing.mesh,
                                where, cells, ranks);
  }

  /** Passes the snapshots of a run and reports progress. */
  SnapshotHistories pass(StrainSource<dim> &source,
                         const std::string &role,
                         const SnapshotWork<dim> &work,
                         const IndexRange &range)
  {
    if (monitor.start)
      monitor.start("snapshots of the " + role, range.count);
    SnapshotHistories histories =
      pass_snapshots(source, share, work, range.count, monitor, ranks);
    if (input != nullptr)
      {
        const auto &times = role == "direct run" ? input->direct_times : input->times;
        std::ostringstream line;
        line << range.count
             << (range.count == 1 ? " snapshot of the " : " snapshots of the ") << role
             << ", " << times.front() << " to " << times.back() << " s";
        input->notes.push_back(line.str());
      }
    return histories;
  }

  void pass_direct()
  {
    if (plan.direct_snapshots.count == 0)
      return;
    auto scope               = optional_scope(monitor.timer, "Stress map");
    const StressMap<dim> map = plain_map(files, parameters, share);
    scope.reset();
    std::optional<StressStatistics<dim>> statistics;
    if (parameters.fields.any())
      statistics.emplace(map, parameters.fields);
    SnapshotWork<dim> work;
    work.local                    = statistics ? &*statistics : nullptr;
    work.followed                 = plan.followed;
    const BodySnapshots<dim> &run = *files.direct;
    const auto where              = places(run, plan.direct_snapshots);
    std::vector<unsigned int> own(run.is_grid ? 0 : share.n_cells);
    std::iota(own.begin(), own.end(), static_cast<unsigned int>(share.first));
    const auto source =
      source_of(run, where, input != nullptr ? &input->direct_body : nullptr, own);
    series.direct = pass(*source, "direct run", work, plan.direct_snapshots);
    if (statistics)
      result.direct = statistics->fields();
  }

  /** C L of each cell; warns if L is inaccurate. */
  StressMap<dim> localized_map()
  {
    const auto scope   = optional_scope(monitor.timer, "Stress map");
    StressMap<dim> map = plain_map(files, parameters, share);
    const VoigtMatrix<dim> mean =
      multiply_by_concentration(map, files, parameters.concentration, share, ranks);
    if (parameters.heating != 0.)
      add_heat(map, files, parameters, share, ranks);
    if (input != nullptr)
      {
        const std::string warning =
          concentration_warning<dim>(files.rve.path(), parameters.concentration, mean);
        if (!warning.empty())
          input->warnings.push_back(warning);
      }
    return map;
  }

  /** Cells of the body that hold the places of this rank; for a mesh rank 0 knows
   * them. */
  std::vector<unsigned int> cells_of_body(const bool with_middles) const
  {
    if (files.homogeneous.is_grid)
      return {};
    const auto n_ranks = mpi::n_mpi_processes(ranks);
    std::vector<unsigned int> cells;
    if (with_middles)
      cells = scatter_objects(ranks, [&](const unsigned int rank) {
        const auto *all = input->body_cell.data();
        return std::vector<unsigned int>(all + files.first_cell(rank, n_ranks),
                                         all + files.first_cell(rank + 1, n_ranks));
      });
    for (const std::size_t cell : plan.point_cells)
      cells.push_back(static_cast<unsigned int>(cell));
    return cells;
  }

  void pass_homogeneous()
  {
    const StressMap<dim> map = localized_map();
    series.matrices          = matrices_of_probes(map);
    series.thermal           = thermal_of_probes(map);
    const bool by_place      = plan.is_body && parameters.local_strain,
               by_mean       = plan.is_body && parameters.mean_strain,
               fields        = parameters.fields.any();
    std::optional<StressStatistics<dim>> local, uniform;
    std::vector<StressStatistics<dim>> points;
    if (fields && by_place)
      local.emplace(map, parameters.fields);
    if (fields && by_mean)
      uniform.emplace(map, parameters.fields);
    for (std::size_t p = 0; p < plan.points.size(); ++p)
      points.emplace_back(map, parameters.fields);
    if (plan.snapshots.count > 0)
      {
        SnapshotWork<dim> work;
        work.local   = local ? &*local : nullptr;
        work.uniform = uniform ? &*uniform : nullptr;
        work.points  = &points;
        work.mean    = by_mean;
        if (by_place)
          work.followed = plan.followed;
        auto where          = places(files.homogeneous, plan.snapshots);
        where.points        = plan.points;
        where.mean          = by_mean;
        const bool at_cells = local || !work.followed.empty();
        if (!at_cells)
          {
            where.n_cells = 0;
            where.middles.clear();
          }
        const auto source =
          source_of(files.homogeneous, where, input != nullptr ? &input->body : nullptr,
                    cells_of_body(at_cells));
        series.homogeneous = pass(*source, "homogeneous run", work, plan.snapshots);
      }
    for (std::size_t p = 0; p < points.size(); ++p)
      result.points.push_back(
        {parameters.points[p].name, parameters.points[p].position, points[p].fields()});
    if (by_place)
      add_variant("local strain", local);
    if (by_mean)
      add_variant("mean strain", uniform);
  }

  void add_variant(const char *name, std::optional<StressStatistics<dim>> &statistics)
  {
    VariantResult &variant = result.variants.emplace_back();
    variant.name           = name;
    if (statistics)
      variant.fields = statistics->fields();
    statistics.reset();
  }

  /** C L in the cells of the probes; each cell is on one rank. */
  std::vector<VoigtMatrix<dim>> matrices_of_probes(const StressMap<dim> &map) const
  {
    constexpr std::size_t n = StressMap<dim>::n_entries;
    std::vector<double> entries(n * plan.probes.size());
    for (std::size_t p = 0; p < plan.probes.size(); ++p)
      {
        const std::size_t k = share.place_of(plan.probes[p]);
        if (k != share.elsewhere)
          std::copy_n(map.matrix(k).data(), n,
                      entries.begin() + static_cast<std::ptrdiff_t>(n * p));
      }
    sum_over_ranks(entries, ranks);
    std::vector<VoigtMatrix<dim>> matrices;
    for (std::size_t p = 0; p < plan.probes.size(); ++p)
      matrices.push_back(Eigen::Map<const VoigtMatrix<dim>>(&entries[n * p]));
    return matrices;
  }

  /** Thermal stresses in the cells of the probes. */
  std::vector<VoigtVector<dim>> thermal_of_probes(const StressMap<dim> &map) const
  {
    std::vector<double> all(n_voigt<dim> * plan.probes.size());
    for (std::size_t p = 0; p < plan.probes.size() && map.thermal() != nullptr; ++p)
      {
        const std::size_t k = share.place_of(plan.probes[p]);
        for (unsigned int c = 0; k != share.elsewhere && c < n_voigt<dim>; ++c)
          all[n_voigt<dim> * p + c] = (*map.thermal())(c, k);
      }
    sum_over_ranks(all, ranks);
    std::vector<VoigtVector<dim>> thermal;
    for (std::size_t p = 0; p < plan.probes.size(); ++p)
      thermal.push_back(Eigen::Map<const VoigtVector<dim>>(&all[n_voigt<dim> * p]));
    return thermal;
  }

  void compare_fields()
  {
    if (!result.is_compared || !parameters.fields.any())
      return;
    const std::vector<CellRegion> regions = regions_of(files, parameters, share);
    for (VariantResult &variant : result.variants)
      {
        variant.difference = difference(variant.fields, result.direct);
        variant.errors     = field_errors(dim, parameters.fields, variant.fields,
                                          result.direct, regions, share.measures, ranks);
      }
  }

  /** Notes the difference of the means of probes and fields, which are sampled
   * differently. */
  void tell_sampling()
  {
    if (result.variants.empty() || result.variants[0].name != "local strain" ||
        !parameters.fields.mean)
      return;
    constexpr unsigned int normal = dim - 1;
    std::vector<double> of_field(plan.probes.size());
    for (std::size_t p = 0; p < of_field.size(); ++p)
      {
        const std::size_t k = share.place_of(plan.probes[p]);
        if (k != share.elsewhere)
          of_field[p] = result.variants[0].fields.mean_stress[n_voigt<dim> * k + normal];
      }
    sum_over_ranks(of_field, ranks);
    if (input != nullptr)
      note_sampling(*input, result.variants[0], of_field);
  }

  const LocalizationParameters &parameters;
  const LocalizationFiles<dim> &files;
  const LocalizationPlan<dim> &plan;
  LocalizationInput<dim> *const input;
  const MPI_Comm ranks;
  const LocalizationMonitor &monitor;
  const CellSet<dim> nothing; ///< mesh cells on ranks other than 0
  const VolumeShare<dim> share;
  ProbeHistories<dim> series;
  LocalizationResult result;
};
} // namespace

template <int dim>
LocalizationResult localize(const LocalizationParameters &parameters,
                            const LocalizationFiles<dim> &files,
                            const LocalizationPlan<dim> &plan,
                            LocalizationInput<dim> *input,
                            const MPI_Comm ranks,
                            const LocalizationMonitor &monitor)
{
  return Localizer<dim>(parameters, files, plan, input, ranks, monitor).run();
}

#define MESOSLIP_INSTANTIATE(dim)                                            \
  template LocalizationResult localize(                                      \
    const LocalizationParameters &, const LocalizationFiles<dim> &,          \
    const LocalizationPlan<dim> &, LocalizationInput<dim> *, const MPI_Comm, \
    const LocalizationMonitor &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
