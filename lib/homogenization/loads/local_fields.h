#ifndef mesoslip_homogenization_loads_local_fields_h
#define mesoslip_homogenization_loads_local_fields_h

#include "homogenization/volumes/volume_element.h"
#include "material/voigt.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** A phase as stresses follow from its strains. */
template <int dim>
struct LoadedPhase
{
  unsigned int part          = 0; ///< the phase with which its cells are counted
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero(); ///< Pa, plane strain in 2D

  /** 2D: sigma_zz = transverse . strain (Pa); empty: the stiffness in the plane was given
   * alone, which says nothing of it. */
  std::optional<VoigtVector<dim>> transverse;

  VoigtVector<dim> thermal_stress = VoigtVector<dim>::Zero(); ///< Pa/K
  double transverse_thermal       = 0.; ///< 2D: its component zz (Pa/K)
  double thermal_energy           = 0.; ///< alpha . C alpha in space (Pa/K^2)
};

/** A number of a cell under a load. */
struct LocalQuantity
{
  std::string name; ///< "strain_xx", "von_mises"
  std::string unit; ///< SI symbol, "-" for strains
};

/**
 * Strains and stresses of a cell under a load and what follows from them, in this order:
 * strain and stress in Voigt order; in 2D sigma_zz; von Mises stress
 * sqrt(3/2 s : s) with the deviator s of all three axes; hydrostatic stress tr(sigma) / 3;
 * the three principal stresses, the largest first. In 2D without LoadedPhase::transverse of
 * all phases there are strain and stress alone.
 */
template <int dim>
class LocalFields
{
public:
  /** Of cells of these phases. */
  explicit LocalFields(const std::vector<LoadedPhase<dim>> &the_phases);

  /** The phase with which cells of phase @p phase are counted: where orientations differ
   * from cell to cell there are several of one. */
  unsigned int part(const unsigned int phase) const
  {
    return phases[phase].part;
  }

  /** Number of phases with which cells are counted. */
  std::size_t n_parts() const;

  /** Whether sigma_zz is known everywhere and with it what follows from it. */
  bool has_invariants() const
  {
    return invariants;
  }

  /** All quantities in their order. */
  const std::vector<LocalQuantity> &quantities() const
  {
    return list;
  }

  /** Place of the von Mises stress among them. */
  static constexpr std::size_t von_mises()
  {
    return std::size_t{2} * n_voigt<dim> + (dim == 2 ? 1 : 0);
  }

  /** Place of the largest principal stress. */
  static constexpr std::size_t largest_principal()
  {
    return von_mises() + 2;
  }

  /** How many of the first quantities are fields of the file: up to the von Mises stress. */
  std::size_t n_stored() const
  {
    return invariants ? von_mises() + 1 : list.size();
  }

  /** The datasets of the stored quantities in @p group, the first being number @p first. */
  std::vector<CellDataset> datasets(const std::string &group,
                                    const std::size_t first) const;

  /** All quantities of a cell of phase @p phase with this @p strain at a @p heating (K) into @p values. */
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
