#ifndef mesoslip_elasticity_row_sweep_h
#define mesoslip_elasticity_row_sweep_h

#include "elasticity/row_kernel.h"
#include "elasticity/uniform_material.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"

#include <initializer_list>
#include <memory>
#include <string>

namespace mesoslip
{
namespace kernels
{
/** Name of the kernel, for the log. */
std::string name(const Choice &choice);
} // namespace kernels

/**
 * Kernels for a material, selected once, and their constants. Internal to elasticity:
 * used by UniformGridOperator and ExplicitStepper.
 */
template <typename Number>
struct RowKernels
{
  /**
   * Selects kernels with the given terms. The default gives products only; the constants
   * of a time step remain zero.
   */
  RowKernels(const UniformMaterial &material,
             const InstructionSet isa,
             const bool damping = false,
             const bool gravity = false);

  kernels::Choice choice;             ///< selected variant
  kernels::Kernels<Number> functions; ///< functions compiled for the instruction set
  std::unique_ptr<kernels::Constants<Number>> constants; ///< constants of the functions
};

/**
 * State of a sweep over the rows: four buffers that pass the forces of a cell row to the
 * nodes above it.
 */
template <typename Number>
class RowSweep
{
public:
  /** @p material and @p kernels must outlive it. */
  RowSweep(const UniformMaterial &material, const RowKernels<Number> &kernels)
    : the_material(material)
    , the_kernels(kernels)
    , buffers(material.n_columns(), 2)
  {
  }

  /** Clears the buffers: no cells below the next row. */
  void reset()
  {
    buffers.set_zero();
  }

  /**
   * Stores the internal forces of one node row, or of rows_at_once if @p several, in
   * @p rows.fx, fy. State and output pointers of @p rows are set; @p cell_row is the
   * global cell row above the first node row.
   */
  void store(kernels::Rows<Number> rows, const unsigned int cell_row, const bool several)
  {
    complete(rows, cell_row);
    the_kernels.functions.store[several](*the_kernels.constants, rows);
    update_copies({rows.fx, rows.fy}, rows.f_stride, several);
  }

  /** Advances the rows in time, in place; arguments as store(). */
  void step(kernels::Rows<Number> rows, const unsigned int cell_row, const bool several)
  {
    complete(rows, cell_row);
    the_kernels.functions.step[several](*the_kernels.constants, rows);
    update_copies({rows.ux, rows.uy, rows.wx, rows.wy}, rows.stride, several);
  }

  /** Stores the internal forces on the top row, which has no cells above. */
  void finish(kernels::Rows<Number> rows)
  {
    complete(rows, 0);
    the_kernels.functions.finish(*the_kernels.constants, rows);
    update_copies({rows.fx, rows.fy}, 0, false);
  }

private:
  void complete(kernels::Rows<Number> &rows, const unsigned int cell_row)
  {
    rows.qx  = buffers.row(0, 0);
    rows.qy  = buffers.row(1, 0);
    rows.sxy = buffers.row(0, 1);
    rows.syy = buffers.row(1, 1);
    if (!the_material.is_homogeneous())
      {
        rows.phases       = the_material.phase_row(cell_row);
        rows.phase_stride = the_material.phase_row(1) - the_material.phase_row(0);
      }
  }

  /** Updates the periodic copy, the last column of a periodic grid. */
  void update_copies(const std::initializer_list<Number *> arrays,
                     const std::size_t stride,
                     const bool several) const
  {
    const unsigned int n = several ? the_kernels.functions.rows_at_once : 1;
    for (Number *row : arrays)
      for (unsigned int k = 0; the_kernels.constants->periodic && k < n; ++k)
        row[k * stride + the_kernels.constants->n_cells] = row[k * stride];
  }

  const UniformMaterial &the_material;
  const RowKernels<Number> &the_kernels;
  NodalField<Number> buffers;
};

extern template struct RowKernels<double>;
extern template struct RowKernels<float>;
} // namespace mesoslip

#endif
