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
/** Local indices of the owned @p rows strictly between bottom and top row of a grid. */
std::vector<unsigned int> inner_rows(const NodeRows &rows);

/**
 * The left or right column of a plane grid between contact and top, moved by a platen.
 * The kernel advances its rows as if the side were free, one step per sweep; the forces
 * of the cells follow from the resulting motion.
 */
class PlatenColumn
{
public:
  /**
   * @p platen of inner_rows(), @p u and @p w must outlive this object; @p damping as in
   * SteppedBody.
   */
  PlatenColumn(RigidPlaten<2> &platen,
               const unsigned int column,
               const UniformMaterial &material,
               const NodeRows &rows,
               const StepParameters &step,
               const UniformMaterial *damping,
               NodalField<double> &u,
               NodalField<double> &w,
               const MPI_Comm communicator);

  /** Call before the kernel advances the rows. */
  void save();

  /** Call after the kernel has advanced the rows from step @p step on. Collective. */
  void advance(const std::uint64_t step);

  const unsigned int column; ///< first or last column of nodes of the grid

private:
  using Components =
    std::array<std::vector<double>, 2>; ///< x and y, one value per entry of places

  RigidPlaten<2> &platen;
  const StepParameters step;
  NodalField<double> &u, &w;
  const MPI_Comm communicator;
  const std::vector<unsigned int> places; ///< local rows of the column
  std::vector<double> inverse_mass;       ///< m/kg
  Components u_before, w_before, force;
};
} // namespace mesoslip

#endif
