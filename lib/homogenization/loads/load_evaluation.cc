#include "homogenization/loads/load_evaluation.h"

#include "base/object_exchange.h"

#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Goes through the cells with all loads at once. */
template <int dim>
class LoadSurvey
{
public:
  LoadSurvey(const LoadParameters &loads,
             const LocalFields<dim> &fields,
             const VolumeElement<dim> &cells,
             const std::vector<VoigtVector<dim>> &amplitudes)
    : loads(loads)
    , fields(fields)
    , cells(cells)
    , amplitudes(amplitudes)
    , parts(amplitudes.size(), std::vector<PhaseUnderLoad>(fields.n_parts()))
    , values(fields.quantities().size())
  {
    for (std::vector<PhaseUnderLoad> &of_load : parts)
      for (PhaseUnderLoad &phase : of_load)
        phase.quantities.resize(values.size());
  }

  /** Statistics of all phases under each load. Collective; complete on rank 0. */
  std::vector<std::vector<PhaseUnderLoad>> run()
  {
    cells.for_each([this](const LocalCell<dim> &cell) { add_moments(cell); });
    merge([](PhaseUnderLoad &all, const PhaseUnderLoad &part) {
      for (std::size_t q = 0; q < all.quantities.size(); ++q)
        all.quantities[q].add(part.quantities[q]);
    });
    set_bins();
    cells.for_each([this](const LocalCell<dim> &cell) { add_shares(cell); });
    merge([](PhaseUnderLoad &all, const PhaseUnderLoad &part) {
      for (std::size_t k = 0; k < 2; ++k)
        all.beyond[k] += part.beyond[k];
      for (std::size_t q = 0; q < all.histogram.size(); ++q)
        for (std::size_t bin = 0; bin < all.histogram[q].size(); ++bin)
          all.histogram[q][bin] += part.histogram[q][bin];
    });
    return parts;
  }

private:
  const double *evaluate(const LocalCell<dim> &cell, const std::size_t load)
  {
    fields.evaluate(cell.phase, cell.strain * amplitudes[load], values.data());
    return values.data();
  }

  void add_moments(const LocalCell<dim> &cell)
  {
    std::array<double, 3> centre = {};
    std::copy(cell.centre.begin(), cell.centre.end(), centre.begin());
    for (std::size_t load = 0; load < parts.size(); ++load)
      {
        const double *const value = evaluate(cell, load);
        std::vector<Moments> &of  = parts[load][fields.part(cell.phase)].quantities;
        for (std::size_t q = 0; q < of.size(); ++q)
          of[q].add(moments_of_cell(value[q], cell.volume, centre));
      }
  }

  /** What the limit is in a phase; infinity: there is none. */
  static double limit(const std::vector<double> &given, const std::size_t phase)
  {
    return given.empty() ? std::numeric_limits<double>::infinity()
                         : given[given.size() == 1 ? 0 : phase];
  }

  void set_bins()
  {
    bins.resize(parts.size());
    for (std::size_t load = 0; load < parts.size(); ++load)
      for (PhaseUnderLoad &phase : parts[load])
        {
          bins[load].emplace_back();
          for (const Moments &moments : phase.quantities)
            bins[load].back().emplace_back(moments, loads.n_bins);
          phase.histogram.assign(loads.n_bins > 0 ? phase.quantities.size() : 0,
                                 std::vector<double>(loads.n_bins, 0.));
        }
  }

  void add_shares(const LocalCell<dim> &cell)
  {
    const unsigned int part = fields.part(cell.phase);
    for (std::size_t load = 0; load < parts.size(); ++load)
      {
        const double *const value = evaluate(cell, load);
        PhaseUnderLoad &phase     = parts[load][part];
        // Volumes of a phase may differ in their last digits from rank to rank.
        const double share = cell.volume / phase.quantities[0].volume;
        for (std::size_t q = 0; q < phase.histogram.size(); ++q)
          phase.histogram[q][bins[load][part][q](value[q])] += share;
        if (!fields.has_invariants())
          continue;
        if (value[fields.von_mises()] > limit(loads.von_mises_limit, part))
          phase.beyond[0] += share;
        if (value[fields.largest_principal()] > limit(loads.principal_limit, part))
          phase.beyond[1] += share;
      }
  }

  /** Puts the parts of all ranks together, in their order, and gives them to all. */
  template <typename Add>
  void merge(const Add &add)
  {
    const std::vector<std::string> all = gather(cells.communicator(), save_state(parts));
    for (std::size_t rank = 1; rank < all.size(); ++rank)
      {
        std::vector<std::vector<PhaseUnderLoad>> other;
        load_state(all[rank], other, "the message of another process");
        for (std::size_t load = 0; load < parts.size(); ++load)
          for (std::size_t p = 0; p < parts[load].size(); ++p)
            add(parts[load][p], other[load][p]);
      }
    broadcast_object(cells.communicator(), parts);
  }

  const LoadParameters &loads;
  const LocalFields<dim> &fields;
  const VolumeElement<dim> &cells;
  const std::vector<VoigtVector<dim>> &amplitudes;
  std::vector<std::vector<PhaseUnderLoad>> parts;   ///< of each load and phase
  std::vector<std::vector<std::vector<Bins>>> bins; ///< of each load, phase and quantity
  std::vector<double> values;                       ///< of a cell
};

/** How far the means of the fields are from the macroscopic state. */
template <int dim>
void set_residuals(LoadResult<dim> &result, const double work)
{
  VoigtVector<dim> strain, stress;
  for (unsigned int k = 0; k < n_voigt<dim>; ++k)
    {
      strain[k] = result.whole(k).mean;
      stress[k] = result.whole(k + n_voigt<dim>).mean;
    }
  const auto distance = [](const VoigtVector<dim> &a, const VoigtVector<dim> &b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  };
  result.strain_residual      = distance(strain, result.strain);
  result.stress_residual      = distance(stress, result.stress);
  const double of_means       = stress.dot(strain);
  result.hill_mandel_residual = std::fabs(work - of_means) / of_means;
  result.energy               = 0.5 * work;
}

template <int dim>
void write_fields(const std::string &file,
                  const LoadParameters &loads,
                  const BoundaryCondition condition,
                  const LocalFields<dim> &fields,
                  const VolumeElement<dim> &cells,
                  const std::vector<VoigtVector<dim>> &amplitudes)
{
  std::vector<CellDataset> datasets;
  const std::size_t n = fields.n_stored();
  for (std::size_t load = 0; load < amplitudes.size(); ++load)
    for (const CellDataset &dataset :
         fields.datasets(load_group(loads.loads[load].name, condition), load * n))
      datasets.push_back(dataset);
  std::vector<double> values(fields.quantities().size());
  cells.write(file, datasets, n * amplitudes.size(),
              [&](const LocalCell<dim> &cell, double *out) {
                for (const VoigtVector<dim> &amplitude : amplitudes)
                  {
                    fields.evaluate(cell.phase, cell.strain * amplitude, values.data());
                    out = std::copy_n(values.data(), n, out);
                  }
              });
}
} // namespace

template <int dim>
Moments LoadResult<dim>::whole(const std::size_t q) const
{
  Moments all;
  for (const PhaseUnderLoad &phase : phases)
    all.add(phase.quantities[q]);
  return all;
}

template <int dim>
std::vector<LoadedPhase<dim>>
loaded_phases(const std::vector<PhaseParameters> &parameters)
{
  std::vector<LoadedPhase<dim>> phases;
  for (const PhaseParameters &p : parameters)
    {
      phases.push_back(
        {static_cast<unsigned int>(phases.size()), p.stiffness<dim>(), {}});
      if constexpr (dim == 2)
        if (p.type != PhaseParameters::Type::stiffness)
          {
            const VoigtMatrix<3> full = p.stiffness<3>();
            phases.back().transverse = VoigtVector<2>(full(2, 0), full(2, 1), full(2, 5));
          }
    }
  return phases;
}

std::string load_group(const std::string &load, const BoundaryCondition condition)
{
  return "/loads/" + load + "/" + to_string(condition);
}

template <int dim>
std::vector<LoadResult<dim>> evaluate_loads(const LoadParameters &loads,
                                            const HomogenizedResponse<dim> &response,
                                            const std::vector<LoadedPhase<dim>> &phases,
                                            const VolumeElement<dim> &cells,
                                            const std::string &file)
{
  const bool stresses = response.condition == BoundaryCondition::SUBC;
  const LocalFields<dim> fields(phases);
  std::vector<LoadResult<dim>> results;
  std::vector<VoigtVector<dim>> amplitudes;
  for (const PrescribedLoad &load : loads.loads)
    {
      const MacroscopicState<dim> state = solve_mixed_load<dim>(response.stiffness, load);
      amplitudes.push_back(stresses ? state.stress : state.strain);
      results.emplace_back();
      results.back().name      = load.name;
      results.back().condition = response.condition;
      results.back().strain    = state.strain;
      results.back().stress    = state.stress;
    }
  const auto statistics = LoadSurvey<dim>(loads, fields, cells, amplitudes).run();
  for (std::size_t load = 0; load < results.size(); ++load)
    {
      results[load].phases = statistics[load];
      set_residuals<dim>(results[load],
                         amplitudes[load].dot(response.energy * amplitudes[load]));
    }
  if (!file.empty())
    write_fields(file, loads, response.condition, fields, cells, amplitudes);
  return results;
}

#define MESOSLIP_INSTANTIATE(dim)                                      \
  template struct LoadResult<dim>;                                     \
  template std::vector<LoadedPhase<dim>> loaded_phases<dim>(           \
    const std::vector<PhaseParameters> &);                             \
  template std::vector<LoadResult<dim>> evaluate_loads<dim>(           \
    const LoadParameters &, const HomogenizedResponse<dim> &,          \
    const std::vector<LoadedPhase<dim>> &, const VolumeElement<dim> &, \
    const std::string &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
