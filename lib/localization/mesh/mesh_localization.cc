#include "localization/mesh/mesh_localization.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "localization/localization_program.h"
#include "localization/mean_concentration.h"
#include "localization/mesh/mesh_result.h"
#include "localization/mesh/rank_work.h"
#include "program/run_context.h"

#include <optional>
#include <ostream>
#include <utility>

namespace mesoslip
{
namespace
{
/** The volume mean of L, from the cells of all ranks. Collective. */
template <int dim>
VoigtMatrix<dim> mean_concentration(const RankWork<dim> &work,
                                    const MPI_Comm communicator)
{
  constexpr std::size_t n = n_voigt<dim> * n_voigt<dim>;
  VoigtMatrix<dim> sum    = VoigtMatrix<dim>::Zero();
  double volume           = 0.;
  for (std::size_t k = 0; k < work.measure.size(); ++k)
    {
      const Eigen::Map<const VoigtMatrix<dim>> L(&work.concentration[n * k]);
      sum += work.measure[k] * L;
      volume += work.measure[k];
    }
  std::vector<double> sums(sum.data(), sum.data() + n);
  sums.push_back(volume);
  sum_over_ranks(sums, communicator);
  return Eigen::Map<const VoigtMatrix<dim>>(sums.data()) / sums[n];
}

template <int dim>
class MeshLocalization : public Analysis
{
public:
  MeshLocalization(const LocalizationParameters &p, const std::string &canonical_text)
    : parameters(p)
    , canonical(canonical_text)
  {
    on_root(MPI_COMM_WORLD, [this]() {
      input = std::make_unique<MeshLocalizationInput<dim>>(parameters);
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
    auto texts       = gather(context.communicator(), localize(context));
    const auto scope = context.timer().scope("Output");
    on_root(context.communicator(), [&]() { write(texts, context); });
    if (context.root())
      log_key_numbers(context);
  }

private:
  /** The RankResult of this rank, saved. */
  std::string localize(RunContext &context)
  {
    RankWork<dim> work = distribute_work(context);
    tell(context);
    RankResult mine;
    const auto scope = context.timer().scope("Localization");
    pass_homogeneous(work, mine, context);
    if (!parameters.direct_run.empty())
      pass_direct(work, mine, context);
    return save_state(mine);
  }

  RankWork<dim> distribute_work(const RunContext &context)
  {
    const auto n_ranks      = static_cast<std::size_t>(context.n_ranks());
    const auto work_of_rank = [&](const std::size_t r) {
      return work_of(input->first_cell(r, n_ranks), input->first_cell(r + 1, n_ranks));
    };
    const std::string text = scatter(context.communicator(), [&](const unsigned int r) {
      return save_state(work_of_rank(r));
    });
    RankWork<dim> work;
    if (context.root())
      work = work_of_rank(0);
    else
      load_state(text, work, "the message of another process");
    read_concentration(work, context.communicator());
    return work;
  }

  /** Each rank reads the tensors of its cells, all at once. */
  void read_concentration(RankWork<dim> &work, const MPI_Comm communicator)
  {
    const RveFile<dim> rve(parameters.rve_file, communicator);
    work.concentration =
      rve.concentration(parameters.concentration, work.first_cell, work.phase.size());
    const VoigtMatrix<dim> mean = mean_concentration(work, communicator);
    if (!input)
      return;
    const std::string warning =
      concentration_warning<dim>(rve.path(), parameters.concentration, mean);
    if (!warning.empty())
      input->warnings.push_back(warning);
  }

  RankWork<dim> work_of(const std::size_t first, const std::size_t end) const
  {
    RankWork<dim> work;
    work.is_body    = input->is_body();
    work.first_cell = first;
    for (std::size_t k = first; k < end; ++k)
      {
        work.measure.push_back(input->measures[k]);
        work.phase.push_back(input->material_of(k));
        if (input->is_body())
          {
            work.in_body.at.push_back(input->centroids[k]);
            work.in_body.cell.push_back(input->body_cell[k]);
          }
        if (input->direct)
          {
            work.in_direct.at.push_back(input->centroids[k]);
            work.in_direct.cell.push_back(static_cast<unsigned int>(k));
          }
      }
    for (const auto &point : input->points)
      {
        work.in_body.at.push_back(point.at);
        work.in_body.cell.push_back(point.cell);
      }
    for (const auto &probe : input->probes)
      if (probe.cell >= first && probe.cell < end)
        work.probes.push_back(probe.cell - first);
    for (const Phase<dim> &phase : input->materials)
      work.phase_stiffness.push_back(phase.stiffness);
    work.phase_ratio = input->out_of_plane_ratio;
    work.phase_ratio.resize(input->materials.size()); // in 3D they do not count
    return work;
  }

  /** Calls @p treat for each snapshot of a run. */
  template <typename Treat>
  void for_each_snapshot(const IndexRange &of_root,
                         const std::string &role,
                         StrainSource<dim> &source,
                         const Treat &treat,
                         RunContext &context)
  {
    std::array<std::size_t, 2> range = {{of_root.first, of_root.count}};
    dealii::Utilities::MPI::broadcast(range.data(), 2, 0, context.communicator());
    context.progress().start("snapshots of the " + role, range[1]);
    for (std::size_t k = 0; k < range[1]; ++k)
      {
        source.set_snapshot(range[0] + k);
        treat();
        context.progress().update(k + 1);
        if (context.stop_requested())
          throw Interrupted("stopped before anything was written; start the run again");
      }
    context.progress().finish();
  }

  /** Uses up the concentration tensors of @p work. */
  void pass_homogeneous(RankWork<dim> &work, RankResult &mine, RunContext &context)
  {
    const LocalCells<dim> cells = work.cells(true);
    std::vector<double>().swap(work.concentration);
    StrainSource<dim> source(parameters.homogeneous_run, input ? input->body : no_mesh,
                             work.in_body, context.communicator());
    const std::size_t n_points   = parameters.points.size(),
                      n_places   = work.in_body.at.size() - n_points;
    const FieldSelection &fields = parameters.fields;
    std::optional<StressRecord<dim>> local, mean;
    if (work.is_body && parameters.local_strain)
      local.emplace(cells, fields, work.probes);
    if (work.is_body && parameters.mean_strain)
      mean.emplace(cells, fields, work.probes);
    std::vector<StressRecord<dim>> points;
    const std::vector<std::size_t> none;
    for (std::size_t p = 0; p < n_points; ++p)
      points.emplace_back(cells, fields, none);
    for_each_snapshot(
      input ? input->snapshots : IndexRange(), "homogeneous run", source,
      [&]() {
        if (local)
          local->add([&](const std::size_t k) { return source.at(k); });
        if (mean)
          mean->add([&](const std::size_t) { return source.mean(); });
        for (std::size_t p = 0; p < n_points; ++p)
          {
            const VoigtVector<dim> strain = source.at(n_places + p);
            points[p].add([&](const std::size_t) { return strain; });
          }
      },
      context);
    for (const auto &point : points)
      point.append_to(mine);
    if (local)
      local->append_to(mine);
    local.reset();
    if (mean)
      mean->append_to(mine);
  }

  void pass_direct(const RankWork<dim> &work, RankResult &mine, RunContext &context)
  {
    const LocalCells<dim> cells = work.cells(false);
    StrainSource<dim> source(parameters.direct_run, input ? input->direct_body : no_mesh,
                             work.in_direct, context.communicator());
    StressRecord<dim> record(cells, parameters.fields, work.probes);
    for_each_snapshot(
      input ? input->direct_snapshots : IndexRange(), "direct run", source,
      [&]() { record.add([&](const std::size_t k) { return source.at(k); }); }, context);
    record.append_to(mine);
  }

  void tell(RunContext &context)
  {
    if (!input)
      return;
    for (const std::string &warning : input->warnings)
      context.warn(warning);
    for (const std::string &note : input->notes)
      context.log(note);
  }

  void write(std::vector<std::string> &texts, RunContext &context) const
  {
    std::vector<RankResult> of_ranks(texts.size());
    for (std::size_t r = 0; r < texts.size(); ++r)
      load_state(std::exchange(texts[r], {}), of_ranks[r],
                 "the message of another process");
    const LocalizationOrigin origin = origin_of(*input);
    const LocalizationResult result = put_together(*input, of_ranks);
    write_localization(origin, result, canonical, context.output_folder());
    summarize_localization(origin, result, context.summary());
  }

  const LocalizationParameters parameters;
  const std::string canonical;
  std::unique_ptr<MeshLocalizationInput<dim>> input; ///< on rank 0
  const Mesh<dim> no_mesh;                           ///< that of a run on the other ranks
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
