#include "localization/mesh/mesh_result.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <utility>

namespace mesoslip
{
namespace
{
/** Puts fields number @p k of the ranks together, and localizes errors. */
template <int dim>
class Assembly
{
public:
  Assembly(const MeshLocalizationInput<dim> &input, std::vector<RankResult> &of_ranks)
    : input(input)
    , of_ranks(of_ranks)
    , n_points(input.points.size())
    , n_variants(of_ranks[0].fields.size() - n_points - (input.direct ? 1 : 0))
  {
  }

  LocalizationResult result() const
  {
    LocalizationResult result;
    result.window = {input.times.front(), input.times.back()};
    for (std::size_t p = 0; p < n_points; ++p)
      result.points.push_back(
        {input.points[p].probe.name, input.points[p].probe.position, fields(p)});
    if (input.direct)
      result.direct = fields(n_points + n_variants);
    for (std::size_t v = 0; v < n_variants; ++v)
      {
        const bool local = v == 0 && input.parameters.local_strain;
        result.variants.push_back(
          variant(local ? "local strain" : "mean strain", v, result.direct));
      }
    return result;
  }

private:
  /** Takes them away from the ranks. */
  StressFields fields(const std::size_t k) const
  {
    StressFields all;
    for (RankResult &part : of_ranks)
      for (const StressField &field : stress_fields(dim))
        {
          const auto values = std::exchange(part.fields[k].*field.values, {});
          auto &to          = all.*field.values;
          to.insert(to.end(), values.begin(), values.end());
        }
    return all;
  }

  /** Stress of probe @p p over time in variant @p v; of the direct run: the last one. */
  std::vector<double> series(const std::size_t p, const std::size_t v) const
  {
    const std::size_t n_ranks = of_ranks.size(), cell = input.probes[p].cell;
    std::size_t r = 0;
    while (cell >= input.first_cell(r + 1, n_ranks))
      ++r;
    const std::size_t n_of_rank =
      of_ranks[r].probes.size() / (n_variants + (input.direct ? 1 : 0));
    // Probes of a rank are in the order of all of them.
    const auto here = [&](const auto &other) {
      return other.cell >= input.first_cell(r, n_ranks) &&
             other.cell < input.first_cell(r + 1, n_ranks);
    };
    const auto before = std::count_if(
      input.probes.begin(), input.probes.begin() + static_cast<std::ptrdiff_t>(p), here);
    return of_ranks[r].probes[v * n_of_rank + static_cast<std::size_t>(before)];
  }

  VariantResult
  variant(const std::string &name, const std::size_t v, const StressFields &direct) const
  {
    VariantResult result;
    result.name   = name;
    result.fields = fields(n_points + v);
    for (std::size_t p = 0; p < input.probes.size(); ++p)
      result.probes.push_back(probe(p, v));
    if (!input.direct || !input.parameters.fields.any())
      return result;
    result.difference = difference(result.fields, direct);
    result.errors = field_errors(dim, result.fields, direct, regions(), input.measures);
    return result;
  }

  ProbeResult probe(const std::size_t p, const std::size_t v) const
  {
    ProbeResult result = {input.probes[p].probe, {}};
    result.time        = input.times;
    result.stress      = series(p, v);
    ProbeSeries direct;
    if (input.direct)
      {
        direct               = {input.direct_times, series(p, n_variants)};
        result.direct_stress = resample(direct, result.time);
      }
    result.statistics =
      compare_series(result.stress, direct.values, result.direct_stress, n_voigt<dim>);
    return result;
  }

  std::vector<CellRegion> regions() const
  {
    const auto box = dealii::BoundingBox<dim>(input.volume.points).get_boundary_points();
    std::vector<dealii::Point<dim>> centres;
    for (const dealii::Point<dim> &centroid : input.centroids)
      centres.emplace_back(centroid - box.first);
    std::vector<std::uint8_t> phase;
    for (const auto &cell : input.volume.cells)
      phase.push_back(static_cast<std::uint8_t>(cell.material_id));
    return comparison_regions<dim>(
      centres, dealii::Point<dim>(box.second - box.first), phase, origin_of(input).phases,
      input.parameters.surface_depth, input.parameters.edge_distance);
  }

  const MeshLocalizationInput<dim> &input;
  std::vector<RankResult> &of_ranks;
  const std::size_t n_points, n_variants;
};
} // namespace

template <int dim>
LocalizationResult put_together(const MeshLocalizationInput<dim> &input,
                                std::vector<RankResult> &of_ranks)
{
  return Assembly<dim>(input, of_ranks).result();
}

template <int dim>
LocalizationOrigin origin_of(const MeshLocalizationInput<dim> &input)
{
  LocalizationOrigin origin;
  origin.dim = dim;
  origin.digest.add(input.rve.digest)
    .add(input.homogeneous.digest)
    .add(input.direct ? input.direct->digest : "");
  origin.n_cells = input.volume.cells.size();
  origin.n_dofs  = dim * input.body.points.size();
  for (const Phase<dim> &phase : input.rve.phases)
    origin.phases.push_back(phase.name);
  origin.concentration    = input.parameters.concentration;
  origin.snapshots        = input.snapshots.count;
  origin.direct_snapshots = input.direct_snapshots.count;
  origin.differences      = input.differences;
  origin.create_file      = [&input](const std::string &path, const std::string &digest) {
    if (!input.rve.is_mesh())
      return LocalizationFile::create(path, digest, input.rve.grid);
    return LocalizationFile::create(path, digest, input.volume);
  };
  return origin;
}

template LocalizationResult put_together(const MeshLocalizationInput<2> &,
                                         std::vector<RankResult> &);
template LocalizationResult put_together(const MeshLocalizationInput<3> &,
                                         std::vector<RankResult> &);
template LocalizationOrigin origin_of(const MeshLocalizationInput<2> &);
template LocalizationOrigin origin_of(const MeshLocalizationInput<3> &);
} // namespace mesoslip
