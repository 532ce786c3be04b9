#ifndef mesoslip_localization_localization_files_h
#define mesoslip_localization_localization_files_h

#include "exchange/body_snapshots.h"
#include "exchange/rve_file.h"
#include "localization/localization_parameters.h"

#include <memory>

namespace mesoslip
{
/** The files of a localization, which every rank opens. */
template <int dim>
struct LocalizationFiles
{
  /** On rank 0, whose checksums count, or on another one once rank 0 has opened them. @throws
   * UserError */
  LocalizationFiles(const LocalizationParameters &p, const bool is_root);

  /** Extents of a field of the volume: [ny][nx], [nz][ny][nx] or, of a mesh, [n]. */
  const Shape &shape() const
  {
    return rve.materials.shape;
  }

  /** Cells of a layer of the first axis of a field; of a mesh one. */
  std::size_t cells_in_layer() const
  {
    return rve.is_mesh() ? 1 : rve.grid.cells_in_layer();
  }

  /** The first layer of the cells of the volume that rank @p r of @p n_ranks has. */
  std::size_t first_layer(const std::size_t r, const std::size_t n_ranks) const
  {
    return r * shape()[0] / n_ranks;
  }

  /** The first of these cells. */
  std::size_t first_cell(const std::size_t r, const std::size_t n_ranks) const
  {
    return first_layer(r, n_ranks) * cells_in_layer();
  }

  /** Whether the volume and the body of the homogeneous run are grids. */
  bool are_grids() const
  {
    return !rve.is_mesh() && homogeneous.is_grid;
  }

  /** @throws UserError where the RVE file lacks what @p p applies to strains and temperature */
  void require_tensors(const LocalizationParameters &p) const
  {
    rve.concentration(p.concentration, 0, 1);
    if (p.heating == 0.)
      return;
    rve.expansion(p.concentration);
    rve.thermal_stress(p.concentration, 0, 1);
  }

  /** Names of the phases. */
  std::vector<std::string> phase_names() const;

  /** sigma_zz / (sigma_xx + sigma_yy) of each phase, as asked for or Poisson's ratio of the
   * closest isotropic solid. @throws UserError for another number of them */
  std::vector<double> out_of_plane_ratios(const LocalizationParameters &parameters) const;

  RveFile<dim> rve;                           ///< stiffnesses, tensors
  BodySnapshots<dim> homogeneous;             ///< run whose strains are localized
  std::unique_ptr<BodySnapshots<dim>> direct; ///< run to compare with, or null
};
} // namespace mesoslip

#endif
