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
 * The left or right column of a plane grid as a SideSurface, whose node k is local row k. The kernel
 * advances its rows as if the side was free; from what it did follow the forces of the cells, with which the
 * nodes are advanced again.
 */
class SideColumn
{
public:
  /** @p surface, @p u and @p w must outlive it; components that are @p held stay where they are; @p damping is
   * that of SteppedBody. */
  SideColumn(SideSurface<2> &surface,
             const unsigned int column,
             const UniformMaterial &material,
             const NodeRows &rows,
             const StepParameters &step,
             const UniformMaterial *damping,
             const std::array<bool, 2> &held,
             NodalField<double> &u,
             NodalField<double> &w);

  /** Before the steps from @p first on, while all rows are there. */
  void start(const std::uint64_t first);

  /** What the side adds to the inertia (kg/m) of component @p c of its node in the bottom or @p top row,
   * which others move; 0 where it is held. */
  double guest_mass(const bool top, const unsigned int c);

  /** Adds to the @p force on its node in the bottom or @p top row before its step. */
  void add_force(const SurfaceView<2> &view,
                 const std::array<double *, 2> &force,
                 const bool top);

  /** Counts what happened to that node in the step, after it. */
  void account(const SurfaceView<2> &view, const bool top);


  /** Before the kernel advances @p n rows from @p row (global number) on. */
  void save(const unsigned int row, const unsigned int n);

  /** After it has advanced them from the time of @p step. */
  void advance(const unsigned int row, const unsigned int n, const std::uint64_t step);

  const unsigned int column; ///< of nodes of the grid: its first or last one

private:
  /** A node before the kernel advances it. */
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
    inverse_mass; ///< of each local row (m/kg), 0 where held
  std::vector<Node> saved;
};
} // namespace mesoslip

#endif
