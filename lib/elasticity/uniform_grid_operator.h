#ifndef mesoslip_elasticity_uniform_grid_operator_h
#define mesoslip_elasticity_uniform_grid_operator_h

#include "elasticity/row_sweep.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <memory>

namespace mesoslip
{
/**
 * The stiffness operator of fully integrated Q1 rectangles on a uniform grid, without a
 * matrix: constant-strain part plus one hourglass mode for each component, which is the
 * same as 2x2 Gauss points. Forces are per unit thickness (N/m). No constraints: fixed
 * degrees of freedom are the caller's business.
 *
 * Fields have material.n_columns() columns and rows.n_local() rows; on a slab the ghost
 * rows of the source must be up to date, and only owned rows of the result are written.
 * With periodic sides the duplicate column (row) of the source must equal the first, and
 * the result is written to both copies (each holds the force of both sides). Periodicity
 * in y needs all rows on one rank. One object must not be used by two threads at a time.
 * The material must outlive the operator.
 */
class UniformGridOperator
{
public:
  /** On all rows of the grid. */
  explicit UniformGridOperator(const UniformMaterial &material,
                               const InstructionSet isa = InstructionSet::automatic);

  /** On the rows of one rank. */
  UniformGridOperator(const UniformMaterial &material,
                      const NodeRows &rows,
                      const InstructionSet requested = InstructionSet::automatic);

  /** dst = K src. @p dst and @p src must be different fields. Number: double, float. */
  template <typename Number>
  void vmult(NodalField<Number> &dst, const NodalField<Number> &src) const;

  /** Diagonal of K: K_xx in component 0, K_yy in component 1 of each owned node. */
  void diagonal(NodalField<double> &diagonal) const;

  /**
   * 1/2 u.K u (J/m) over the owned rows, a duplicate column or row counted once; the sum
   * over ranks is left to the caller. Rows are summed one by one in their order, then
   * added up in order.
   */
  double elastic_energy(const NodalField<double> &u) const;

  /**
   * Mean strain (xx, yy, engineering xy) of the `grid.cells[0]` cells between the local
   * node rows @p j and @p j + 1 of @p u. The three arrays hold `grid.cells[0]` values.
   */
  void strain(const NodalField<double> &u,
              const unsigned int j,
              double *exx,
              double *eyy,
              double *gxy) const;

private:
  /** Everything one precision needs; made when that precision is first used. */
  template <typename Number>
  struct Precision
  {
    Precision(const UniformMaterial &material, const InstructionSet isa)
      : kernels(material, isa)
      , sweep(material, kernels)
      , rows(material.n_columns(), kernels.functions.rows_at_once)
    {
    }

    RowKernels<Number> kernels;
    RowSweep<Number> sweep;
    NodalField<Number> rows; ///< of forces, where no field is to keep them
  };

  template <typename Number>
  Precision<Number> &precision() const;
  template <typename Number>
  void check(const NodalField<Number> &field) const;
  template <typename Number, typename Consume>
  void traverse(NodalField<Number> *dst,
                const NodalField<Number> &src,
                const Consume &consume) const;

  const UniformMaterial &material;
  const NodeRows rows;
  const InstructionSet isa;
  mutable std::unique_ptr<Precision<double>> in_double;
  mutable std::unique_ptr<Precision<float>> in_float;
};
} // namespace mesoslip

#endif
