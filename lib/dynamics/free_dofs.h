#ifndef mesoslip_dynamics_free_dofs_h
#define mesoslip_dynamics_free_dofs_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <deal.II/lac/vector.h>

#include <limits>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * The degrees of freedom that can vibrate, numbered, with their lumped masses: the free
 * ones of a uniform grid, without the duplicates of periodic sides, and, with a platen,
 * the one u_y of the top row as the last.
 */
class FreeDofs
{
public:
  using Vector = dealii::Vector<double>; ///< one entry per degree of freedom

  /**
   * @p held holds u_y of the top row when there is a platen of mass @p platen_mass
   * (kg/m), which moves that row as one.
   */
  FreeDofs(const UniformMaterial &material,
           const DofMask &held,
           const std::optional<double> &platen_mass);

  /** A component of a node; of the first node of the top row for the platen. */
  struct Place
  {
    unsigned int component; ///< 0: x, 1: y
    unsigned int i;         ///< column of nodes
    unsigned int j;         ///< row of nodes
  };

  /** What platen() is without one. */
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /** Number of degrees of freedom. */
  std::size_t size() const
  {
    return masses.size();
  }

  /** Number of the platen's degree of freedom, or none. */
  std::size_t platen() const
  {
    return with_platen ? size() - 1 : none;
  }

  /** Lumped mass (kg/m). */
  double mass(const std::size_t k) const
  {
    return masses[k];
  }

  /** Where degree of freedom @p k is. */
  const Place &place(const std::size_t k) const
  {
    return places[k];
  }

  /** x.M y. */
  double mass_product(const Vector &x, const Vector &y) const;

  /** Held entries of @p field become zero, duplicates copies. */
  void scatter(NodalField<double> &field, const Vector &values) const;

  /** Displacements of @p field. */
  void gather(Vector &values, const NodalField<double> &field) const;

  /** Nodal forces of @p field (N/m); the platen carries the sum of its row. */
  void gather_forces(Vector &values, const NodalField<double> &field) const;

private:
  const Periodicity periodic;
  const unsigned int n_columns, n_rows;
  const bool with_platen;
  std::vector<std::size_t> offsets;
  std::vector<double> masses;
  std::vector<Place> places;
};
} // namespace mesoslip

#endif
