#ifndef mesoslip_dynamics_platen_column_h
#define mesoslip_dynamics_platen_column_h

#include "dynamics/supports/rigid_platen.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** Local numbers of the own @p rows between the bottom and the top row of a grid. */
std::vector<unsigned int> inner_rows(const NodeRows &rows);

/**
 * The left or right column of a plane grid between contact and top, which a platen moves. The kernel advances its
 * rows as if the side was free, one step in a sweep; from what it did follow the forces of the cells.
 */
class PlatenColumn
{
public:
  /** @p platen of inner_rows(), @p u and @p w must outlive it; @p damping is that of SteppedBody. */
  PlatenColumn(RigidPlaten<2> &platen,
               const unsigned int column,
               const UniformMaterial &material,
               const NodeRows &rows,
               const StepParameters &step,
               const UniformMaterial *damping,
               NodalField<double> &u,
               NodalField<double> &w,
               const MPI_Comm communicator);

  /** Before the kernel advances the rows. */
  void save();

  /** After it has advanced them from the time of @p step. Collective. */
  void advance(const std::uint64_t step);

  const unsigned int column; ///< of nodes of the grid: its first or last one

private:
  using Components =
    std::array<std::vector<double>, 2>; ///< x and y, a value for each of places

  RigidPlaten<2> &platen;
  const StepParameters step;
  NodalField<double> &u, &w;
  const MPI_Comm communicator;
  const std::vector<unsigned int> places; ///< the rows in the fields
  std::vector<double> inverse_mass;       ///< m/kg
  Components u_before, w_before, force;
};
} // namespace mesoslip

#endif
