#ifndef mesoslip_dynamics_side_column_h
#define mesoslip_dynamics_side_column_h

#include "dynamics/supports/side_surface.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * The left or right column of a plane grid as a SideSurface, whose node k is local row k.
 * The kernel advances its rows as if the side were free; the forces of the cells follow
 * from the resulting motion, and the nodes are advanced again with them.
 */
class SideColumn
{
public:
  /**
   * @p surface, @p u and @p w must outlive this object; @p held components are
   * constrained; @p damping as in SteppedBody.
   */
  SideColumn(SideSurface<2> &surface,
             const unsigned int column,
             const UniformMaterial &material,
             const NodeRows &rows,
             const StepParameters &step,
             const UniformMaterial *damping,
             const std::array<bool, 2> &held,
             NodalField<double> &u,
             NodalField<double> &w);

  /** Call before the steps from @p first on, while all rows are at the same time. */
  void start(const std::uint64_t first);

  /**
   * Inertia (kg/m) that the side adds to component @p c of its node in the bottom or
   * @p top row, which another surface advances; 0 if constrained.
   */
  double guest_mass(const bool top, const unsigned int c);

  /**
   * Adds the forces of the side to @p force on its node in the bottom or @p top row,
   * before the step.
   */
  void add_force(const SurfaceView<2> &view,
                 const std::array<double *, 2> &force,
                 const bool top);

  /** Counts energy and work of this node after the step. */
  void account(const SurfaceView<2> &view, const bool top);


  /** Call before the kernel advances @p n rows from global row @p row on. */
  void save(const unsigned int row, const unsigned int n);

  /** Call after the kernel has advanced these rows from step @p step on. */
  void advance(const unsigned int row, const unsigned int n, const std::uint64_t step);

  const unsigned int column; ///< first or last column of nodes of the grid

private:
  /** State of a node before the kernel advances it. */
  struct Node
  {
    std::array<double, 2> u = {}; ///< m
    std::array<double, 2> w = {}; ///< m/s
  };

  SurfaceView<2> view(const unsigned int local, Node &node, std::array<double, 2> &force);
  unsigned int boundary_row(const bool top) const;

  SideSurface<2> &surface;
  const NodeRows rows;
  const StepParameters step;
  NodalField<double> &u, &w;
  std::vector<std::array<double, 2>>
    inverse_mass; ///< inverse mass of each local row (m/kg), 0 where constrained
  std::vector<Node> saved;
};
} // namespace mesoslip

#endif
