#ifndef mesoslip_localization_mesh_rank_work_h
#define mesoslip_localization_mesh_rank_work_h

#include "base/serialize_members.h"
#include "localization/mesh/cell_statistics.h"
#include "localization/mesh/strain_source.h"

#include <vector>

namespace mesoslip
{
/** What rank 0 gives each rank: cells of the volume, and what is wanted of them. */
template <int dim>
struct RankWork
{
  bool is_body           = true;     ///< whether the volume is the body
  std::size_t first_cell = 0;        ///< number of the first of these cells in the volume
  std::vector<double> concentration; ///< L of each cell [n][v][v], which the rank reads
  std::vector<double> measure;       ///< of each cell (m^dim)
  std::vector<unsigned int> phase;   ///< of each cell, or its material
  PlacesInCells<dim> in_body;        ///< centroids, if the volume is the body; points
  PlacesInCells<dim> in_direct;      ///< centroids, if there is a direct run
  std::vector<std::size_t> probes;   ///< numbers of the probes' cells among these cells
  std::vector<VoigtMatrix<dim>> phase_stiffness; ///< by phase (Pa), the same everywhere
  std::vector<double> phase_ratio;               ///< by phase, the same everywhere

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &is_body &first_cell &concentration &measure &phase;
    archive &in_body &in_direct &probes &phase_stiffness &phase_ratio;
  }

  /** C_phase L of the cells, or C_phase alone. */
  LocalCells<dim> cells(const bool with_concentration) const
  {
    constexpr std::size_t n = n_voigt<dim> * n_voigt<dim>;
    LocalCells<dim> result;
    result.stiffness.reserve(phase.size());
    result.ratio.reserve(phase.size());
    for (std::size_t k = 0; k < phase.size(); ++k)
      {
        VoigtMatrix<dim> product = phase_stiffness[phase[k]];
        if (with_concentration)
          product *= Eigen::Map<const VoigtMatrix<dim>>(&concentration[n * k]).eval();
        result.stiffness.push_back(product);
        result.ratio.push_back(phase_ratio[phase[k]]);
      }
    return result;
  }
};

/** What a rank finds in its cells. */
struct RankResult
{
  /** Fields of the points, of the variants and of the direct run, one after the other. */
  std::vector<StressFields> fields;

  /** Stresses over time of the probes of this rank, by variant, then of the direct run. */
  std::vector<std::vector<double>> probes;

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    std::size_t n = fields.size();
    archive &n &probes;
    fields.resize(n);
    for (StressFields &f : fields)
      archive &f.mean_von_mises &f.mean_stress &f.deviation_stress;
  }
};

/** Statistics and series from one source of strain. */
template <int dim>
class StressRecord
{
public:
  /** All arguments must outlive it; @p probes are numbers of cells. */
  StressRecord(const LocalCells<dim> &cells,
               const FieldSelection &selection,
               const std::vector<std::size_t> &probes)
    : cells(cells)
    , probes(probes)
    , statistics(cells, selection)
    , series(probes.size())
  {
  }

  /** The next sample: @p strain (k) is the macroscopic strain of cell number k. */
  template <typename Strain>
  void add(const Strain &strain)
  {
    statistics.add(strain);
    for (std::size_t p = 0; p < probes.size(); ++p)
      {
        const VoigtVector<dim> stress = cells.stiffness[probes[p]] * strain(probes[p]);
        series[p].insert(series[p].end(), stress.data(), stress.data() + stress.size());
      }
  }

  /** Adds what there is to @p result. */
  void append_to(RankResult &result) const
  {
    result.fields.push_back(statistics.fields());
    result.probes.insert(result.probes.end(), series.begin(), series.end());
  }

private:
  const LocalCells<dim> &cells;
  const std::vector<std::size_t> &probes;
  CellStatistics<dim> statistics;
  std::vector<std::vector<double>> series;
};
} // namespace mesoslip

#endif
