#include "localization/volume_share.h"

#include "base/object_exchange.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** Cells of a row of a mesh: an odd number of cache lines. */
constexpr std::size_t row_of_mesh = 504;

/** Centroids and sizes of some cells of a mesh. */
template <int dim>
struct CellPlaces
{
  std::vector<dealii::Point<dim>> middles; ///< m
  std::vector<double> measures;            ///< m^dim

  /** For boost::serialization. */
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
  const auto n_ranks = mpi::n_mpi_processes(ranks), rank = mpi::this_mpi_process(ranks);
  VolumeShare<dim> share;
  share.first_layer = files.first_layer(rank, n_ranks);
  share.first       = files.first_cell(rank, n_ranks);
  share.n_cells     = files.first_cell(rank + 1, n_ranks) - share.first;
  share.n_in_row    = files.rve.is_mesh() ? row_of_mesh : files.rve.grid.cells[0];
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
  return share;
}

template <int dim>
StressMap<dim> plain_map(const LocalizationFiles<dim> &files,
                         const LocalizationParameters &parameters,
                         const VolumeShare<dim> &share)
{
  const std::vector<Phase<dim>> parts = files.rve.constituents();
  const std::vector<double> ratios    = files.out_of_plane_ratios(parameters);
  StressMap<dim> map(share.n_cells, share.n_in_row);
  std::size_t k = 0;
  for (std::size_t j = 0; j < map.rows().n_rows(); ++j)
    for (std::size_t i = 0; i < map.rows().size(j); ++i, ++k)
      {
        map.set_matrix(j, i, parts[share.material[k]].stiffness);
        map.set_ratio(j, i, ratios[files.rve.materials.phase_of(share.material[k])]);
      }
  return map;
}

template <int dim>
VoigtMatrix<dim> multiply_by_concentration(StressMap<dim> &map,
                                           const LocalizationFiles<dim> &files,
                                           const std::string &condition,
                                           const VolumeShare<dim> &share,
                                           const MPI_Comm ranks)
{
  constexpr std::size_t n             = n_voigt<dim> * n_voigt<dim>;
  const std::vector<Phase<dim>> parts = files.rve.constituents();
  std::vector<double> sums(n + 1); // sums of L and of volumes
  Eigen::Map<VoigtMatrix<dim>> sum(sums.data());
  std::size_t j = 0, i = 0;
  const auto multiply = [&](const std::size_t first, const std::size_t count) {
    const std::vector<double> L =
      files.rve.concentration(condition, share.first + first, count);
    for (std::size_t k = 0; k < count; ++k)
      {
        const Eigen::Map<const VoigtMatrix<dim>> of_cell(&L[n * k]);
        const double volume = share.measures.empty() ? 1. : share.measures[first + k];
        sum += volume * of_cell;
        sums[n] += volume;
        map.set_matrix(j, i, parts[share.material[first + k]].stiffness * of_cell);
        if (++i == share.n_in_row)
          {
            i = 0;
            ++j;
          }
      }
  };
  on_all_ranks(
    ranks, [&]() { for_each_piece(share.n_cells, files.cells_in_layer(), multiply); });
  sum_over_ranks(sums, ranks);
  return sum / sums[n];
}

template <int dim>
void add_heat(StressMap<dim> &map,
              const LocalizationFiles<dim> &files,
              const LocalizationParameters &parameters,
              const VolumeShare<dim> &share,
              const MPI_Comm ranks)
{
  constexpr unsigned int zz = n_voigt<dim>;
  const double heating      = parameters.heating;
  const std::string &name   = parameters.concentration;
  const auto add            = [&](const std::size_t first, const std::size_t count) {
    const VoigtVector<dim> expansion = files.rve.expansion(name);
    const auto per_kelvin = files.rve.thermal_stress(name, share.first + first, count);
    for (std::size_t k = 0; k < count; ++k)
      {
        const std::size_t cell = first + k, j = cell / share.n_in_row,
                          i           = cell % share.n_in_row;
        const VoigtVector<dim> held   = per_kelvin[k].template head<n_voigt<dim>>(),
                               stress = held + map.matrix(cell) * expansion;
        // Part of the thermal sigma_zz not given by the ratio; 0 if sigma_zz is unknown.
        double rest = 0.;
        if (dim == 2 && !std::isnan(per_kelvin[k][zz]))
          rest = per_kelvin[k][zz] - map.ratio(j)[i] * (held[0] + held[1]);
        map.set_thermal(j, i, heating * stress, heating * rest);
      }
  };
  on_all_ranks(ranks,
               [&]() { for_each_piece(share.n_cells, files.cells_in_layer(), add); });
}

template <int dim>
std::vector<CellRegion> regions_of(const LocalizationFiles<dim> &files,
                                   const LocalizationParameters &parameters,
                                   const VolumeShare<dim> &share)
{
  // On a grid centres count from the lower corner; on a mesh, whose grid is its box, they
  // are coordinates.
  const UniformGrid<dim> &grid = files.rve.grid;
  UniformGrid<dim> at_zero     = grid;
  at_zero.origin               = {};
  dealii::Point<dim> size, origin;
  for (unsigned int d = 0; d < dim; ++d)
    {
      size[d]   = grid.extent(d);
      origin[d] = grid.origin[d];
    }
  const bool is_mesh = files.rve.is_mesh();
  std::vector<dealii::Point<dim>> centres;
  std::vector<std::uint8_t> phase;
  centres.reserve(share.n_cells);
  phase.reserve(share.n_cells);
  for (std::size_t k = 0; k < share.n_cells; ++k)
    {
      centres.push_back(is_mesh
                          ? dealii::Point<dim>(share.middles[k] - origin)
                          : middle_of<dim>(at_zero, places_of(grid, share.first + k)));
      phase.push_back(
        static_cast<std::uint8_t>(files.rve.materials.phase_of(share.material[k])));
    }
  // The surface region is at the contact: for a counter body at the upper end.
  if (files.homogeneous.conditions && is_below(*files.homogeneous.conditions))
    for (dealii::Point<dim> &centre : centres)
      centre[dim - 1] = size[dim - 1] - centre[dim - 1];
  return comparison_regions<dim>(centres, size, phase, files.phase_names(),
                                 parameters.surface_depth, parameters.edge_distance);
}

#define MESOSLIP_INSTANTIATE(dim)                                                  \
  template void add_heat(StressMap<dim> &, const LocalizationFiles<dim> &,         \
                         const LocalizationParameters &, const VolumeShare<dim> &, \
                         const MPI_Comm);                                          \
  template VolumeShare<dim> make_share(const LocalizationFiles<dim> &,             \
                                       const LocalizationPlan<dim> &,              \
                                       const CellSet<dim> &, const MPI_Comm);      \
  template StressMap<dim> plain_map(const LocalizationFiles<dim> &,                \
                                    const LocalizationParameters &,                \
                                    const VolumeShare<dim> &);                     \
  template VoigtMatrix<dim> multiply_by_concentration(                             \
    StressMap<dim> &, const LocalizationFiles<dim> &, const std::string &,         \
    const VolumeShare<dim> &, const MPI_Comm);                                     \
  template std::vector<CellRegion> regions_of(const LocalizationFiles<dim> &,      \
                                              const LocalizationParameters &,      \
                                              const VolumeShare<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
