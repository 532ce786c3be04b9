#ifndef mesoslip_localization_mesh_stress_record_h
#define mesoslip_localization_mesh_stress_record_h

#include "localization/mesh/cell_statistics.h"

#include <limits>
#include <vector>

namespace mesoslip
{
/** Statistics and series from one source of strain in the cells of a rank. */
template <int dim>
class StressRecord
{
public:
  /** The place of a probe whose cell another rank has. */
  static constexpr std::size_t elsewhere = std::numeric_limits<std::size_t>::max();

  /** All arguments must outlive it; @p probes are numbers of cells, or elsewhere. */
  StressRecord(const LocalCells<dim> &of_cells,
               const FieldSelection &selection,
               const std::vector<std::size_t> &of_probes)
    : cells(of_cells)
    , probes(of_probes)
    , statistics(of_cells, selection)
    , of_probe(of_probes.size())
  {
  }

  /** The next sample: @p strain (k) is the macroscopic strain of cell number k. */
  template <typename Strain>
  void add(const Strain &strain)
  {
    statistics.add(strain);
    for (std::size_t p = 0; p < probes.size(); ++p)
      {
        VoigtVector<dim> stress = VoigtVector<dim>::Zero();
        if (probes[p] != elsewhere)
          stress = cells.stiffness[probes[p]] * strain(probes[p]);
        of_probe[p].insert(of_probe[p].end(), stress.data(),
                           stress.data() + stress.size());
      }
  }

  /** The averages over the samples. */
  StressFields fields() const
  {
    return statistics.fields();
  }

  /** Stress of each probe over time [k][components] (Pa); zeros for those elsewhere. */
  const std::vector<std::vector<double>> &series() const
  {
    return of_probe;
  }

private:
  const LocalCells<dim> &cells;
  const std::vector<std::size_t> &probes;
  CellStatistics<dim> statistics;
  std::vector<std::vector<double>> of_probe;
};
} // namespace mesoslip

#endif
