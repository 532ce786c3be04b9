#include "homogenization/loads/load_evaluation.h"

#include "base/exchange.h"
#include "base/object_exchange.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Passes through the cells once for all loads. */
template <int dim>
class LoadSurvey
{
public:
  LoadSurvey(const LoadParameters &loads,
             const LocalFields<dim> &fields,
             const VolumeElement<dim> &cells,
             const std::vector<LoadAmplitudes<dim>> &amplitudes)
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
    fields.evaluate(cell.phase, cell.strain * amplitudes[load],
                    amplitudes[load][n_voigt<dim>], values.data());
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

  /** Limit of a phase; infinity: no limit. */
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
        // Volumes of a phase may differ by round-off from rank to rank.
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

  /** Merges the parts of all ranks in rank order and broadcasts the result. */
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
  const std::vector<LoadAmplitudes<dim>> &amplitudes;
  std::vector<std::vector<PhaseUnderLoad>> parts;   ///< [load][phase]
  std::vector<std::vector<std::vector<Bins>>> bins; ///< [load][phase][quantity]
  std::vector<double> values;                       ///< quantities of the current cell
};

/** Matrix of volume means of strain . C strain of the unit cases and, last, of one kelvin
 * if a load @p is_heated; off-diagonal entries couple two cases. */
template <int dim>
Eigen::MatrixXd energies(const VolumeElement<dim> &cells,
                         const HomogenizedResponse<dim> &response,
                         const std::vector<LoadedPhase<dim>> &phases,
                         const bool is_heated)
{
  constexpr Eigen::Index n   = n_voigt<dim>;
  Eigen::MatrixXd result     = Eigen::MatrixXd::Zero(n + 1, n + 1);
  result.topLeftCorner(n, n) = response.energy;
  if (!response.heat.exists || !is_heated)
    return result;
  Eigen::VectorXd of_heat = Eigen::VectorXd::Zero(n + 1);
  cells.for_each_sample(
    [&](const unsigned int material, const double part, const UnitStrains<dim> &strain) {
      of_heat +=
        part * (strain.transpose() * (phases[material].stiffness * strain.col(n)).eval());
    });
  sum_over_ranks(of_heat.data(), static_cast<std::size_t>(of_heat.size()),
                 cells.communicator());
  of_heat /= response.volume;
  result.col(n) = of_heat;
  result.row(n) = of_heat.transpose();
  return result;
}

/** Sets the energy and the distances of field means from the macroscopic state.
 * @p amplitudes are the factors of the unit cases, @p energy is from energies(). */
template <int dim>
void set_residuals(LoadResult<dim> &result,
                   const LoadAmplitudes<dim> &amplitudes,
                   const Eigen::MatrixXd &energy,
                   const HomogenizedResponse<dim> &response)
{
  const ThermalResponse<dim> &heat = response.heat;
  const double heating             = amplitudes[n_voigt<dim>],
               of_strain           = amplitudes.dot(energy * amplitudes),
               of_heat             = heating * heat.work.dot(amplitudes),
               work                = of_strain - of_heat; // mean of stress . strain
  VoigtVector<dim> strain, stress;
  for (unsigned int k = 0; k < n_voigt<dim>; ++k)
    {
      strain[k] = result.whole(k).mean;
      stress[k] = result.whole(k + n_voigt<dim>).mean;
    }
  // A heated volume may have no macroscopic strain or stress, so the scale includes its
  // thermal expansion.
  const auto distance = [heating](const VoigtVector<dim> &a, const VoigtVector<dim> &b,
                                  const VoigtVector<dim> &per_kelvin) {
    const double scale = b.cwiseAbs().maxCoeff() +
                         std::fabs(heating) * per_kelvin.cwiseAbs().maxCoeff(),
                 off = (a - b).cwiseAbs().maxCoeff();
    return scale > 0. ? off / scale : off;
  };
  result.strain_residual = distance(strain, result.strain, heat.expansion);
  result.stress_residual = distance(stress, result.stress, heat.stress);
  const double of_means  = stress.dot(strain);
  const double scale =
    std::fabs(of_means) + heating * heating * heat.stress.dot(heat.expansion);
  result.hill_mandel_residual =
    scale > 0. ? std::fabs(work - of_means) / scale : std::fabs(work - of_means);
  result.energy = 0.5 * (of_strain - 2. * of_heat + heating * heating * heat.held);
}

template <int dim>
void write_fields(const std::string &file,
                  const LoadParameters &loads,
                  const BoundaryCondition condition,
                  const LocalFields<dim> &fields,
                  const VolumeElement<dim> &cells,
                  const std::vector<LoadAmplitudes<dim>> &amplitudes)
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
                for (const LoadAmplitudes<dim> &amplitude : amplitudes)
                  {
                    fields.evaluate(cell.phase, cell.strain * amplitude,
                                    amplitude[n_voigt<dim>], values.data());
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
      phases.push_back({static_cast<unsigned int>(phases.size()),
                        p.stiffness<dim>(),
                        {},
                        p.thermal_stress<dim>()});
      phases.back().thermal_energy = p.thermal_energy();
      if constexpr (dim == 2)
        if (p.type != PhaseParameters::Type::stiffness)
          {
            const VoigtMatrix<3> full = p.stiffness<3>();
            phases.back().transverse = VoigtVector<2>(full(2, 0), full(2, 1), full(2, 5));
            phases.back().transverse_thermal = p.transverse_thermal_stress();
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
  std::vector<LoadAmplitudes<dim>> amplitudes;
  for (const PrescribedLoad &load : loads.loads)
    {
      const MacroscopicState<dim> state =
        solve_mixed_load<dim>(response.stiffness, response.heat.stress, load);
      amplitudes.emplace_back();
      amplitudes.back() << (stresses ? state.stress : state.strain), load.heating;
      results.emplace_back();
      results.back().name      = load.name;
      results.back().condition = response.condition;
      results.back().strain    = state.strain;
      results.back().stress    = state.stress;
    }
  const auto statistics = LoadSurvey<dim>(loads, fields, cells, amplitudes).run();
  const bool is_heated =
    std::any_of(loads.loads.begin(), loads.loads.end(),
                [](const PrescribedLoad &load) { return load.heating != 0.; });
  const Eigen::MatrixXd energy = energies(cells, response, phases, is_heated);
  for (std::size_t load = 0; load < results.size(); ++load)
    {
      results[load].phases = statistics[load];
      set_residuals<dim>(results[load], amplitudes[load], energy, response);
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
