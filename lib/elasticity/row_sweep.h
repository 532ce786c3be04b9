#ifndef mesoslip_elasticity_row_sweep_h
#define mesoslip_elasticity_row_sweep_h

#include "elasticity/row_kernel.h"
#include "elasticity/uniform_material.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"

#include <memory>
#include <string>

namespace mesoslip
{
namespace kernels
{
/** For the log. */
std::string name(const Choice &choice);
} // namespace kernels

/**
 * The kernels for a material, chosen once, and their constants. Internal to elasticity:
 * UniformGridOperator and ExplicitStepper are made of it.
 */
template <typename Number>
struct RowKernels
{
  /** Those with the terms asked for; without any only products are of use, and the
   *  constants of a time step are zero. */
  RowKernels(const UniformMaterial &material,
             const InstructionSet isa,
             const bool damping = false,
             const bool gravity = false);

  kernels::Choice choice;             ///< variant that was picked
  kernels::Kernels<Number> functions; ///< compiled for the instruction set
  std::unique_ptr<kernels::Constants<Number>> constants; ///< what the functions read
};

/**
 * One sweep over the rows in flight: the four buffers that hand the forces of a cell row
 * to the nodes above it.
 */
template <typename Number>
class RowSweep
{
public:
  /** @p material and @p kernels must outlive it. */
  RowSweep(const UniformMaterial &material, const RowKernels<Number> &kernels);

  /** Nothing below the next row. */
  void reset();

  /**
   * @p n = 1 or rows_at_once node rows of internal forces into @p rows.fx, fy. @p rows
   * has its state and output pointers set; @p cell_row is the (global) cell row above the
   * first node row.
   */
  void store(kernels::Rows<Number> rows, const unsigned int cell_row, const bool several);

  /** The same, stepping in time in place. */
  void step(kernels::Rows<Number> rows, const unsigned int cell_row, const bool several);

  /** Internal forces on the top row, above which there is nothing. */
  void finish(kernels::Rows<Number> rows);

private:
  void complete(kernels::Rows<Number> &rows, const unsigned int cell_row);

  const UniformMaterial &the_material;
  const RowKernels<Number> &the_kernels;
  NodalField<Number> buffers;
};

extern template struct RowKernels<double>;
extern template struct RowKernels<float>;
extern template class RowSweep<double>;
extern template class RowSweep<float>;
} // namespace mesoslip

#endif
