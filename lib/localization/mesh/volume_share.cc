#include "localization/mesh/volume_share.h"

#include "base/exchange.h"
#include "localization/mesh/stress_record.h"

namespace mesoslip
{
namespace
{
/** Middles and sizes of some cells of a mesh. */
template <int dim>
struct CellPlaces
{
  std::vector<dealii::Point<dim>> middles; ///< m
  std::vector<double> measures;            ///< m^dim

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

template <int dim>
CellPlaces<dim>
places_in_mesh(const CellSet<dim> &cells, const std::size_t begin, const std::size_t end)
{
  CellPlaces<dim> places;
  for (std::size_t k = begin; k < end; ++k)
    {
      const CellMeasure<dim> cell = cells.measure(k);
      places.middles.push_back(cell.centroid);
      places.measures.push_back(cell.volume);
    }
  return places;
}
} // namespace

template <int dim>
VolumeShare<dim> make_share(const LocalizationFiles<dim> &files,
                            const LocalizationPlan<dim> &plan,
                            const CellSet<dim> &of_root,
                            const MPI_Comm ranks)
{
  const auto n_ranks = dealii::Utilities::MPI::n_mpi_processes(ranks),
             rank    = dealii::Utilities::MPI::this_mpi_process(ranks);
  VolumeShare<dim> share;
  share.first_row = files.first_row(rank, n_ranks);
  share.first     = files.first_cell(rank, n_ranks);
  share.n_cells   = files.first_cell(rank + 1, n_ranks) - share.first;
  on_all_ranks(ranks, [&]() {
    share.material = files.rve.constituent_ids(share.first, share.n_cells);
  });
  if (files.rve.is_mesh())
    {
      CellPlaces<dim> places = scatter_objects(ranks, [&](const unsigned int r) {
        return places_in_mesh(of_root, files.first_cell(r, n_ranks),
                              files.first_cell(r + 1, n_ranks));
      });
      share.measures         = std::move(places.measures);
      if (plan.is_body)
        share.middles = std::move(places.middles);
    }
  else if (plan.is_body)
    for (std::size_t k = share.first; k < share.first + share.n_cells; ++k)
      share.middles.push_back(
        middle_of<dim>(files.rve.grid, places_of(files.rve.grid, k)));
  for (const std::size_t cell : plan.probes)
    share.probes.push_back(cell >= share.first && cell < share.first + share.n_cells
                             ? cell - share.first
                             : StressRecord<dim>::elsewhere);
  return share;
}

template <int dim>
LocalCells<dim> plain_cells(const LocalizationFiles<dim> &files,
                            const LocalizationParameters &parameters,
                            const VolumeShare<dim> &share)
{
  const std::vector<Phase<dim>> parts = files.rve.constituents();
  const std::vector<double> ratios    = out_of_plane_ratios(parameters, files.rve);
  LocalCells<dim> cells;
  cells.stiffness.reserve(share.n_cells);
  cells.ratio.reserve(share.n_cells);
  for (const std::uint16_t material : share.material)
    {
      cells.stiffness.push_back(parts[material].stiffness);
      cells.ratio.push_back(ratios[files.rve.materials.phase_of(material)]);
    }
  return cells;
}

template <int dim>
VoigtMatrix<dim> multiply_by_concentration(LocalCells<dim> &cells,
                                           const LocalizationFiles<dim> &files,
                                           const std::string &condition,
                                           const VolumeShare<dim> &share,
                                           const MPI_Comm ranks)
{
  constexpr std::size_t n = n_voigt<dim> * n_voigt<dim>;
  std::vector<double> sums(n + 1); // of L and of the volumes
  Eigen::Map<VoigtMatrix<dim>> sum(sums.data());
  on_all_ranks(ranks, [&]() {
    for_each_piece(share.n_cells, files.cells_in_row(),
                   [&](const std::size_t first, const std::size_t count) {
                     const std::vector<double> L =
                       files.rve.concentration(condition, share.first + first, count);
                     for (std::size_t k = 0; k < count; ++k)
                       {
                         const Eigen::Map<const VoigtMatrix<dim>> of_cell(&L[n * k]);
                         const double volume =
                           share.measures.empty() ? 1. : share.measures[first + k];
                         sum += volume * of_cell;
                         sums[n] += volume;
                         cells.stiffness[first + k] *= of_cell;
                       }
                   });
  });
  sum_over_ranks(sums, ranks);
  return sum / sums[n];
}

#define MESOSLIP_INSTANTIATE(dim)                                             \
  template VolumeShare<dim> make_share(const LocalizationFiles<dim> &,        \
                                       const LocalizationPlan<dim> &,         \
                                       const CellSet<dim> &, const MPI_Comm); \
  template LocalCells<dim> plain_cells(const LocalizationFiles<dim> &,        \
                                       const LocalizationParameters &,        \
                                       const VolumeShare<dim> &);             \
  template VoigtMatrix<dim> multiply_by_concentration(                        \
    LocalCells<dim> &, const LocalizationFiles<dim> &, const std::string &,   \
    const VolumeShare<dim> &, const MPI_Comm);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
