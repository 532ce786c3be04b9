#ifndef mesoslip_eigenvalues_inverse_stiffness_h
#define mesoslip_eigenvalues_inverse_stiffness_h

#include "eigenvalues/free_dofs.h"
#include "eigenvalues/vibration_modes.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * K^-1 for loads without resultant; solutions have no rigid motion with respect to the
 * mass. With platens, the body is first solved with constrained platens, u = K_hh^-1 f,
 * then their motion is added: u + Z s, where the columns of Z are the responses to unit
 * displacements of platens and Z.K Z s = Z.f, as Z.K u = 0.
 */
template <int dim>
class InverseStiffness
{
public:
  /** vectors of FreeDofs */
  using Vector = typename FreeDofs<dim>::Vector;

  /**
   * Inverse for the degrees of freedom that @p mask does not constrain; all arguments
   * must outlive it. Collective.
   */
  InverseStiffness(const ElasticBody<dim> &body,
                   const DofMask &mask,
                   const FreeDofs<dim> &dofs,
                   const VibrationModesOptions &options);

  /** dst = K^-1 src. Collective. @throws NotConverged */
  void vmult(Vector &dst, const Vector &src) const;

  /** Removes unconstrained rigid motions from @p x. Collective. */
  void remove_rigid(Vector &x) const;

  /** Number of unconstrained rigid motions. */
  unsigned int n_rigid() const
  {
    return rigid.size();
  }

  mutable unsigned int n_solves   = 0; ///< number of solves with K so far
  mutable unsigned int iterations = 0; ///< iterations of the linear solver in all solves

private:
  void solve() const;
  std::vector<bool> platens_that_may_stay() const;
  void push_platens(const ElasticBody<dim> &body);

  const FreeDofs<dim> &dofs;
  const VibrationModesOptions &options;
  const std::vector<Vector> rigid;
  std::unique_ptr<StaticSolver> solver;
  mutable NodalField<double> force, u;
  std::vector<Vector> responses;    ///< Z, without columns of platens_that_may_stay()
  Eigen::MatrixXd platen_stiffness; ///< Z.K Z (N/m, in 2D Pa)
};
} // namespace mesoslip

#endif
