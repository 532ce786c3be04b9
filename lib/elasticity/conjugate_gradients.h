#ifndef mesoslip_elasticity_conjugate_gradients_h
#define mesoslip_elasticity_conjugate_gradients_h

#include "elasticity/static_solver.h"
#include "elasticity/uniform_grid_operator.h"

#include <functional>

namespace mesoslip
{
/**
 * Preconditioned conjugate gradients on the uniform-grid operator. The preconditioner is
 * all that derived classes add.
 */
class ConjugateGradients : public StaticSolver
{
public:
  /** For K of @p material; a solve that needs more than @p max_iterations fails. */
  explicit ConjugateGradients(const UniformMaterial &material,
                              const unsigned int max_iterations);

  void set_held(const DofMask &held) override;

  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

protected:
  /** Called by set_held(). */
  virtual void prepare() = 0;

  /** z = M^-1 r; both vanish at held entries. */
  virtual void precondition(NodalField<double> &z, const NodalField<double> &r) = 0;

  const UniformMaterial &material;     ///< what K is made of
  const UniformGridOperator stiffness; ///< K without constraints
  DofMask held;                        ///< degrees of freedom kept at their values

private:
  void clear_held(NodalField<double> &x) const;
  void copy_duplicates(NodalField<double> &x) const;
  void remove_translations(NodalField<double> &x) const;
  double dot(const NodalField<double> &x, const NodalField<double> &y) const;

  const unsigned int max_iterations;
  bool singular = false;
};

/** The diagonal of K as preconditioner. */
class JacobiSolver : public ConjugateGradients
{
public:
  /** Computes the diagonal of K; @p material must outlive the solver. */
  explicit JacobiSolver(const UniformMaterial &material);

protected:
  void prepare() override;
  void precondition(NodalField<double> &z, const NodalField<double> &r) override;

private:
  NodalField<double> inverse_diagonal;
};
} // namespace mesoslip

#endif
