#ifndef mesoslip_statics_multigrid_rigid_modes_h
#define mesoslip_statics_multigrid_rigid_modes_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <array>
#include <vector>

namespace mesoslip::multigrid
{
/**
 * The rigid motions that constrained degrees of freedom and periodic sides leave to a grid: the
 * null space of its stiffness. A motion (a, b, r) displaces a point by a - r y, b + r x,
 * with x and y from the middle of the grid in widths of a cell.
 */
class RigidModes
{
public:
  RigidModes() = default;

  /** Those of @p material that @p mask leaves. */
  RigidModes(const UniformMaterial &material, const DofMask &mask);

  /** Motions that are orthonormal as nodal vectors; none if nothing is free to move. */
  const std::vector<std::array<double, 3>> &modes() const
  {
    return orthonormal;
  }

  /** Removes the modes from a field (duplicates are not counted but corrected). */
  void remove_from(NodalField<double> &field) const;

  /** Position of node column @p i and row @p j in these coordinates. */
  double x(const double i) const
  {
    return i - centre[0];
  }

  /** Of row @p j. */
  double y(const double j) const
  {
    return (j - centre[1]) * aspect;
  }

private:
  std::array<unsigned int, 2> n_nodes = {};
  std::array<double, 2> centre        = {};
  double aspect                       = 1.;
  std::vector<std::array<double, 3>> orthonormal;
};
} // namespace mesoslip::multigrid

#endif
