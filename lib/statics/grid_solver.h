#ifndef mesoslip_statics_grid_solver_h
#define mesoslip_statics_grid_solver_h

#include "statics/multigrid/multigrid.h"
#include "statics/static_solver.h"

#include <memory>

namespace mesoslip
{
/**
 * Flexible conjugate gradients in double precision on UniformGridOperator. Free entries
 * of u are the initial guess.
 *
 * StaticSolverKind::multigrid: preconditioned by one cycle of multigrid::Multigrid in
 * single precision. About ten iterations for the contrasts of composites, whatever the
 * size; time and memory linear in the number of cells. If single precision breaks down
 * or takes more than 100 iterations, the rest of this and all further solves with the
 * same mask use the cycle in double precision. StaticSolverKind::jacobi, and grids with
 * fewer than three cells in both directions: preconditioned by the diagonal, which needs
 * no set-up and up to 100000 iterations.
 *
 * All rows on one rank; independent load cases go to different ranks. Not for use by two
 * threads at a time.
 */
class GridSolver : public StaticSolver
{
public:
  /** Sets up everything independent of the constraints. @p material must outlive this
   * object. @p limit replaces the iteration limit of @p kind. */
  explicit GridSolver(const UniformMaterial &material,
                      const StaticSolverKind kind = StaticSolverKind::multigrid,
                      const std::optional<unsigned int> &limit = {});

  /** Costs about as much as two solves; free if the mask has not changed. Throws
   * std::invalid_argument if the size of the mask differs from the grid's. */
  void set_constrained(const DofMask &mask) override;

  /** Force components along unconstrained rigid modes (usually round-off) are projected
   * out. */
  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  /** A multigrid cycle in one precision, with its input and output fields. */
  template <typename N>
  struct Cycle
  {
    using Number = N;
    Cycle(const UniformMaterial &material,
          const UniformGridOperator &stiffness,
          const DofMask &mask)
      : multigrid(material, stiffness)
      , b(material.n_columns(), material.n_rows())
      , z(b)
    {
      multigrid.set_constrained(mask);
    }

    /** Applies the cycle: z = M^-1 b. */
    void apply()
    {
      multigrid.vmult(z, b);
    }

    multigrid::Multigrid<Number> multigrid;
    NodalField<Number> b, z;
  };

  /** Jacobi preconditioner: inverse diagonal of K, zero for constrained entries. */
  struct Diagonal
  {
    using Number = double;
    Diagonal(const UniformGridOperator &stiffness, const DofMask &mask)
      : inverse(mask.n_columns(), mask.n_rows())
      , b(inverse)
      , z(inverse)
    {
      stiffness.diagonal(inverse);
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < mask.n_rows(); ++j)
          for (unsigned int i = 0; i < mask.n_columns(); ++i)
            {
              double &d = inverse.row(c, j)[i];
              d         = mask.is_constrained(c, {i, j}) ? 0. : 1. / d;
            }
    }

    /** Applies the inverse diagonal: z = D^-1 b. */
    void apply()
    {
      for (std::size_t k = 0; k < z.size(); ++k)
        z.begin()[k] = inverse.begin()[k] * b.begin()[k];
    }

    NodalField<double> inverse, b, z;
  };

  template <typename Function>
  void for_each_row(const Function &function) const;
  void restrict_to_unknowns(NodalField<double> &v) const;
  double residual(const NodalField<double> &u, const NodalField<double> &f);
  double norm(const NodalField<double> &v) const;
  double right_hand_side_norm(const NodalField<double> &u, const NodalField<double> &f);
  template <typename Preconditioner>
  std::optional<NotConverged::Reason> iterate(Preconditioner &preconditioner,
                                              NodalField<double> &u,
                                              const double scale,
                                              const double tolerance,
                                              const unsigned int last,
                                              SolverReport &report);

  const UniformMaterial &material;
  const bool use_diagonal;
  const unsigned int max_iterations;
  const unsigned int unique_columns, unique_rows; ///< without periodic copies
  const unsigned int n;                           ///< columns in whole vectors
  const UniformGridOperator stiffness;
  const UniformMaterial gentle;               ///< phases from phase_to_precondition()
  const UniformGridOperator gentle_stiffness; ///< operator of `gentle`, for multigrid
  NodalField<double> r, p, q;

  DofMask mask;
  multigrid::ConstrainedUnknowns constrained;
  multigrid::RigidModes modes;
  /** Preconditioner: exactly one is set after set_constrained(). */
  std::unique_ptr<Cycle<float>> single;
  std::unique_ptr<Cycle<double>> twice;
  std::unique_ptr<Diagonal> diagonal;
};
} // namespace mesoslip

#endif
