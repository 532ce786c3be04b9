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
 * Matrix-free stiffness operator of fully integrated Q1 rectangles on a uniform grid: a
 * constant-strain part plus one hourglass mode per component, which equals 2x2 Gauss
 * points. Forces are per unit thickness (N/m). Applies no constraints; the caller handles
 * constrained degrees of freedom.
 *
 * Fields have material.n_columns() columns and rows.n_local() rows. On a slab, the ghost
 * rows of the source must be up to date, and only locally owned rows of the result are
 * written. With periodic sides, the source must have the same values at periodic copies
 * (last column or row) and masters; the result is written to both and contains the force
 * of both sides. Periodicity in y needs all rows on one rank. Not thread-safe. The
 * material must outlive the operator.
 */
class UniformGridOperator
{
public:
  /** Operator on all rows of the grid. */
  explicit UniformGridOperator(const UniformMaterial &material,
                               const InstructionSet isa = InstructionSet::automatic);

  /** Operator on the rows of one rank. */
  UniformGridOperator(const UniformMaterial &material,
                      const NodeRows &rows,
                      const InstructionSet requested = InstructionSet::automatic);

  /** dst = K src for double or float. @p dst and @p src must be different fields. */
  template <typename Number>
  void vmult(NodalField<Number> &dst, const NodalField<Number> &src) const;

  /**
   * Diagonal of K: K_xx in component 0, K_yy in component 1 of each locally owned node.
   */
  void diagonal(NodalField<double> &diagonal) const;

  /**
   * 1/2 u.K u (J/m) over the locally owned rows, without periodic copies; the caller sums
   * over the ranks. Each row is summed separately, then the rows are added in order.
   */
  double elastic_energy(const NodalField<double> &u) const;

  /**
   * Mean strain (xx, yy, engineering xy) of the cells between the local node rows @p j
   * and @p j + 1 of @p u. Each array has `grid.cells[0]` values.
   */
  void strain(const NodalField<double> &u,
              const unsigned int j,
              double *exx,
              double *eyy,
              double *gxy) const;

private:
  /** Kernels and buffers for one precision; created at its first use. */
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
    NodalField<Number> rows; ///< scratch forces without an output field
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
