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
  /** Opens the files. Rank 0 checks the checksums; other ranks open the files after rank
   * 0.
   * @throws UserError */
  LocalizationFiles(const LocalizationParameters &p, const bool is_root);

  /** Shape of a cell field of the volume: [ny][nx], [nz][ny][nx] or, for a mesh, [n]. */
  const Shape &shape() const
  {
    return rve.materials.shape;
  }

  /** Cells per layer of the first axis of a field; for a mesh 1. */
  std::size_t cells_in_layer() const
  {
    return rve.is_mesh() ? 1 : rve.grid.cells_in_layer();
  }

  /** First layer of the volume's cells on rank @p r of @p n_ranks. */
  std::size_t first_layer(const std::size_t r, const std::size_t n_ranks) const
  {
    return r * shape()[0] / n_ranks;
  }

  /** First cell on rank @p r of @p n_ranks. */
  std::size_t first_cell(const std::size_t r, const std::size_t n_ranks) const
  {
    return first_layer(r, n_ranks) * cells_in_layer();
  }

  /** Whether the volume and the body of the homogeneous run are grids. */
  bool are_grids() const
  {
    return !rve.is_mesh() && homogeneous.is_grid;
  }

  /** @throws UserError if the RVE file lacks the tensors that @p p applies to strains and
   * temperature */
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

  /** sigma_zz / (sigma_xx + sigma_yy) of each phase: the given values, or Poisson's ratio
   * of the closest isotropic solid.
   * @throws UserError for a wrong number of values */
  std::vector<double> out_of_plane_ratios(const LocalizationParameters &parameters) const;

  RveFile<dim> rve;                           ///< stiffnesses, tensors
  BodySnapshots<dim> homogeneous;             ///< run whose strains are localized
  std::unique_ptr<BodySnapshots<dim>> direct; ///< run to compare with, or null
};
} // namespace mesoslip

#endif
