#ifndef mesoslip_homogenization_loads_local_fields_h
#define mesoslip_homogenization_loads_local_fields_h

#include "homogenization/volumes/volume_element.h"
#include "material/voigt.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Constants of a phase from which stresses follow. */
template <int dim>
struct LoadedPhase
{
  unsigned int part          = 0; ///< phase of the .prm for the statistics
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero(); ///< Pa, plane strain in 2D

  /** 2D: sigma_zz = transverse . strain (Pa). Empty if only the in-plane stiffness was
   * given, which does not determine sigma_zz. */
  std::optional<VoigtVector<dim>> transverse;

  VoigtVector<dim> thermal_stress = VoigtVector<dim>::Zero(); ///< Pa/K
  double transverse_thermal       = 0.; ///< 2D: zz component of thermal_stress (Pa/K)
  double thermal_energy           = 0.; ///< alpha . C alpha in space (Pa/K^2)
};

/** Name and unit of a cell quantity under a load. */
struct LocalQuantity
{
  std::string name; ///< "strain_xx", "von_mises"
  std::string unit; ///< SI symbol, "-" for strains
};

/**
 * Local quantities of a cell under a load, in this order: strain and stress in Voigt
 * order; in 2D sigma_zz; von Mises stress sqrt(3/2 s : s) with the deviator s of all
 * three axes; hydrostatic stress tr(sigma) / 3; the three principal stresses, the
 * largest first. In 2D, if a phase has no LoadedPhase::transverse, only strain and
 * stress are available.
 */
template <int dim>
class LocalFields
{
public:
  /** Quantities of cells of @p the_phases. */
  explicit LocalFields(const std::vector<LoadedPhase<dim>> &the_phases);

  /** Phase of the .prm for material @p phase. With orientations that differ from cell to
   * cell, several materials belong to one phase. */
  unsigned int part(const unsigned int phase) const
  {
    return phases[phase].part;
  }

  /** Number of phases of the .prm. */
  std::size_t n_parts() const;

  /** Whether sigma_zz and the stress invariants are known everywhere. */
  bool has_invariants() const
  {
    return invariants;
  }

  /** All quantities in their order. */
  const std::vector<LocalQuantity> &quantities() const
  {
    return list;
  }

  /** Index of the von Mises stress in quantities(). */
  static constexpr std::size_t von_mises()
  {
    return std::size_t{2} * n_voigt<dim> + (dim == 2 ? 1 : 0);
  }

  /** Index of the largest principal stress in quantities(). */
  static constexpr std::size_t largest_principal()
  {
    return von_mises() + 2;
  }

  /** Number of leading quantities stored as fields: all up to the von Mises stress. */
  std::size_t n_stored() const
  {
    return invariants ? von_mises() + 1 : list.size();
  }

  /** Datasets of the stored quantities in @p group; their numbers start at @p first. */
  std::vector<CellDataset> datasets(const std::string &group,
                                    const std::size_t first) const;

  /** Computes all quantities of a cell of material @p phase with this @p strain at a
   * @p heating (K) into @p values. */
  void evaluate(const unsigned int phase,
                const VoigtVector<dim> &strain,
                const double heating,
                double *values) const;

private:
  const std::vector<LoadedPhase<dim>> phases;
  bool invariants = true;
  std::vector<LocalQuantity> list;
};
} // namespace mesoslip

#endif
