#include "localization/mesh/mesh_localization.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "localization/localization_program.h"
#include "localization/mean_concentration.h"
#include "localization/mesh/mesh_input.h"
#include "localization/mesh/strain_source.h"
#include "localization/mesh/stress_record.h"
#include "localization/mesh/volume_share.h"
#include "program/run_context.h"

#include <numeric>
#include <optional>
#include <ostream>

namespace mesoslip
{
namespace
{
template <int dim>
class MeshLocalization : public Analysis
{
public:
  MeshLocalization(const LocalizationParameters &p, const std::string &canonical_text)
    : parameters(p)
    , canonical(canonical_text)
  {
    on_root(MPI_COMM_WORLD, [this]() {
      files = std::make_unique<LocalizationFiles<dim>>(parameters, true);
      input = std::make_unique<MeshLocalizationInput<dim>>(parameters, *files);
      plan  = input->plan;
    });
  }

  void describe(std::ostream &out) const override
  {
    if (input)
      input->describe(out);
  }

  ResourceNeed need() const override
  {
    return input ? input->need() : ResourceNeed();
  }

  void run(RunContext &context) override
  {
    context.remove_results(
      {"localization.h5", "localization.xdmf", "probes.csv", "field_errors.csv"});
    on_all_ranks(context.communicator(), [this]() {
      if (!files)
        files = std::make_unique<LocalizationFiles<dim>>(parameters, false);
    });
    broadcast_object(context.communicator(), plan);
    const LocalizationResult result = localize(context);
    const auto scope                = context.timer().scope("Output");
    const LocalizationOrigin origin = this->origin();
    write_localization(origin, result, canonical, context.output_folder());
    if (!context.root())
      return;
    summarize_localization(origin, result, context.summary());
    log_key_numbers(context);
  }

private:
  LocalizationResult localize(RunContext &context)
  {
    const MPI_Comm ranks = context.communicator();
    const auto scope     = context.timer().scope("Localization");
    const auto share     = make_share(*files, plan, volume(), ranks);
    LocalizationResult result;
    result.communicator = ranks;
    result.first_row    = share.first_row;
    result.fields       = parameters.fields;
    result.is_compared  = files->direct != nullptr;
    result.window       = {plan.times.front(), plan.times.back()};
    pass_homogeneous(share, result, context);
    if (result.is_compared)
      compare(share, pass_direct(share, result, context), result);
    return result;
  }

  /** On rank 0; on the others nothing. */
  const CellSet<dim> &volume() const
  {
    return input ? input->volume : nothing;
  }

  /** C L of each cell; tells what the input and L are like. */
  LocalCells<dim> localized_cells(const VolumeShare<dim> &share,
                                  RunContext &context) const
  {
    LocalCells<dim> cells       = plain_cells(*files, parameters, share);
    const VoigtMatrix<dim> mean = multiply_by_concentration(
      cells, *files, parameters.concentration, share, context.communicator());
    if (!input)
      return cells;
    for (const std::string &warning : input->warnings)
      context.warn(warning);
    const std::string warning =
      concentration_warning<dim>(files->rve.path(), parameters.concentration, mean);
    if (!warning.empty())
      context.warn(warning);
    for (const std::string &note : input->notes)
      context.log(note);
    return cells;
  }

  /** Calls @p treat for each snapshot of a run. */
  template <typename Treat>
  void for_each_snapshot(const IndexRange &range,
                         const std::string &role,
                         StrainSource<dim> &source,
                         const Treat &treat,
                         RunContext &context) const
  {
    context.progress().start("snapshots of the " + role, range.count);
    for (std::size_t k = 0; k < range.count; ++k)
      {
        source.set_snapshot(range.first + k);
        treat();
        context.progress().update(k + 1);
        if (context.stop_requested())
          throw Interrupted("stopped before anything was written; start the run again");
      }
    context.progress().finish();
  }

  /** The cells of the body that hold the places of this rank; of a mesh rank 0 knows them. */
  std::vector<unsigned int> cells_of_body(const MPI_Comm ranks) const
  {
    const auto n_ranks = dealii::Utilities::MPI::n_mpi_processes(ranks);
    std::vector<unsigned int> cells;
    if (plan.is_body)
      cells = scatter_objects(ranks, [&](const unsigned int rank) {
        const auto *all = input->body_cell.data();
        return std::vector<unsigned int>(all + files->first_cell(rank, n_ranks),
                                         all + files->first_cell(rank + 1, n_ranks));
      });
    for (const std::size_t cell : plan.point_cells)
      cells.push_back(static_cast<unsigned int>(cell)); // of a mesh
    return cells;
  }

  void pass_homogeneous(const VolumeShare<dim> &share,
                        LocalizationResult &result,
                        RunContext &context) const
  {
    const MPI_Comm ranks          = context.communicator();
    const LocalCells<dim> cells   = localized_cells(share, context);
    const bool by_mean            = plan.is_body && parameters.mean_strain;
    const StrainPlaces<dim> where = {share.middles, plan.points, by_mean};
    const BodySnapshots<dim> &run = files->homogeneous;
    const auto source             = run.is_grid
                                      ? make_grid_source(run, where, ranks)
                                      : make_mesh_source(run, input ? input->body.mesh : nothing.mesh,
                                                         where, cells_of_body(ranks), ranks);
    std::optional<StressRecord<dim>> local, mean;
    if (plan.is_body && parameters.local_strain)
      local.emplace(cells, parameters.fields, share.probes);
    if (by_mean)
      mean.emplace(cells, parameters.fields, share.probes);
    std::vector<StressRecord<dim>> points;
    const std::vector<std::size_t> none;
    for (std::size_t p = 0; p < plan.points.size(); ++p)
      points.emplace_back(cells, parameters.fields, none);
    for_each_snapshot(
      plan.snapshots, "homogeneous run", *source,
      [&]() {
        if (local)
          local->add([&](const std::size_t k) { return source->at(k); });
        if (mean)
          mean->add([&](const std::size_t) { return source->mean(); });
        for (std::size_t p = 0; p < points.size(); ++p)
          {
            const VoigtVector<dim> strain = source->at(where.middles.size() + p);
            points[p].add([&](const std::size_t) { return strain; });
          }
      },
      context);
    for (std::size_t p = 0; p < points.size(); ++p)
      result.points.push_back(
        {parameters.points[p].name, parameters.points[p].position, points[p].fields()});
    if (local)
      result.variants.push_back(variant("local strain", *local, ranks));
    local.reset();
    if (mean)
      result.variants.push_back(variant("mean strain", *mean, ranks));
  }

  VariantResult variant(const std::string &name,
                        const StressRecord<dim> &record,
                        const MPI_Comm ranks) const
  {
    VariantResult found;
    found.name   = name;
    found.fields = record.fields();
    for (std::size_t p = 0; p < plan.probes.size(); ++p)
      {
        ProbeResult probe = {input ? input->probes[p] : LocalizedProbe(), {}};
        probe.time        = plan.times;
        probe.stress      = record.series()[p];
        sum_over_ranks(probe.stress, ranks);
        probe.statistics = compare_series(probe.stress, {}, {}, n_voigt<dim>);
        found.probes.push_back(probe);
      }
    return found;
  }

  /** Sets the direct fields; the stresses of the probes over time. */
  std::vector<ProbeSeries> pass_direct(const VolumeShare<dim> &share,
                                       LocalizationResult &result,
                                       RunContext &context) const
  {
    const MPI_Comm ranks          = context.communicator();
    const LocalCells<dim> cells   = plain_cells(*files, parameters, share);
    const StrainPlaces<dim> where = {share.middles, {}, false};
    const BodySnapshots<dim> &run = *files->direct;
    std::vector<unsigned int> own(run.is_grid ? 0 : share.n_cells);
    std::iota(own.begin(), own.end(), static_cast<unsigned int>(share.first));
    const auto source =
      run.is_grid ? make_grid_source(run, where, ranks)
                  : make_mesh_source(run, input ? input->direct_body.mesh : nothing.mesh,
                                     where, own, ranks);
    StressRecord<dim> record(cells, parameters.fields, share.probes);
    for_each_snapshot(
      plan.direct_snapshots, "direct run", *source,
      [&]() { record.add([&](const std::size_t k) { return source->at(k); }); }, context);
    result.direct = record.fields();
    std::vector<ProbeSeries> probes;
    for (std::vector<double> series : record.series())
      {
        sum_over_ranks(series, ranks);
        probes.push_back({plan.direct_times, series});
      }
    return probes;
  }

  /** Fields and @p probes of the direct run with those of the variants. */
  void compare(const VolumeShare<dim> &share,
               const std::vector<ProbeSeries> &probes,
               LocalizationResult &result) const
  {
    const std::vector<CellRegion> in_regions = regions(share);
    for (VariantResult &variant : result.variants)
      {
        variant.difference = difference(variant.fields, result.direct);
        variant.errors =
          field_errors(dim, parameters.fields, variant.fields, result.direct, in_regions,
                       share.measures, result.communicator);
        for (std::size_t p = 0; p < probes.size(); ++p)
          {
            ProbeResult &probe  = variant.probes[p];
            probe.direct_stress = resample(probes[p], probe.time);
            probe.statistics    = compare_series(probe.stress, probes[p].values,
                                                 probe.direct_stress, n_voigt<dim>);
          }
      }
  }

  std::vector<CellRegion> regions(const VolumeShare<dim> &share) const
  {
    const RveFile<dim> &rve = files->rve;
    dealii::Point<dim> origin, size;
    for (unsigned int d = 0; d < dim; ++d)
      {
        origin[d] = rve.grid.origin[d];
        size[d]   = rve.grid.extent(d);
      }
    std::vector<dealii::Point<dim>> centres;
    for (const dealii::Point<dim> &middle : share.middles)
      centres.emplace_back(middle - origin);
    std::vector<std::uint8_t> phase;
    for (const std::uint16_t material : share.material)
      phase.push_back(static_cast<std::uint8_t>(rve.materials.phase_of(material)));
    return comparison_regions<dim>(centres, size, phase, names_of_phases(),
                                   parameters.surface_depth, parameters.edge_distance);
  }

  std::vector<std::string> names_of_phases() const
  {
    std::vector<std::string> names;
    for (const Phase<dim> &phase : files->rve.phases)
      names.push_back(phase.name);
    return names;
  }

  /** What the results say of the input; on ranks other than 0 the dimension. */
  LocalizationOrigin origin() const
  {
    LocalizationOrigin origin;
    origin.dim = dim;
    if (!input)
      return origin;
    origin.digest.add(files->rve.digest)
      .add(files->homogeneous.digest)
      .add(files->direct ? files->direct->digest : "");
    origin.n_cells          = input->volume.n_cells();
    origin.n_dofs           = dim * input->body.n_points();
    origin.phases           = names_of_phases();
    origin.concentration    = parameters.concentration;
    origin.snapshots        = plan.snapshots.count;
    origin.direct_snapshots = plan.direct_snapshots.count;
    origin.differences      = input->differences;
    origin.create_file      = [this](const std::string &path, const std::string &digest) {
      if (!files->rve.is_mesh())
        return LocalizationFile::create(path, digest, files->rve.grid);
      return LocalizationFile::create(path, digest, input->volume.mesh);
    };
    return origin;
  }

  const LocalizationParameters parameters;
  const std::string canonical;
  std::unique_ptr<LocalizationFiles<dim>> files;     ///< on rank 0, in a run on all
  std::unique_ptr<MeshLocalizationInput<dim>> input; ///< on rank 0
  LocalizationPlan<dim> plan;                        ///< of rank 0, in a run of all
  const CellSet<dim> nothing;                        ///< what other ranks have of meshes
};
} // namespace

template <int dim>
std::unique_ptr<Analysis> make_mesh_localization(const LocalizationParameters &parameters,
                                                 const std::string &canonical)
{
  return std::make_unique<MeshLocalization<dim>>(parameters, canonical);
}

template std::unique_ptr<Analysis>
make_mesh_localization<2>(const LocalizationParameters &, const std::string &);
template std::unique_ptr<Analysis>
make_mesh_localization<3>(const LocalizationParameters &, const std::string &);
} // namespace mesoslip
