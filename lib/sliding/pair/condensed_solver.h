#ifndef mesoslip_sliding_pair_condensed_solver_h
#define mesoslip_sliding_pair_condensed_solver_h

#include "body/elastic_body.h"

#include <Eigen/CholmodSupport>
#include <Eigen/Dense>

#include <cstdint>
#include <memory>
#include <vector>

namespace mesoslip
{
/** The stiffness of a body with replicated fields in one row, condensed to its contact
 * nodes: with the inner degrees of freedom i and the contact degrees of freedom c, S =
 * K_cc - K_ci K_ii^-1 K_ic. K_ii is factorized by CHOLMOD; K_ii is regular even if only
 * the contact holds the body. */
template <int dim>
class CondensedStiffness
{
public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>; ///< sparse

  /** Condenses the stiffness of @p body with the constraints @p mask on inner degrees of
   * freedom. */
  CondensedStiffness(const ElasticBody<dim> &body, const DofMask &mask);

  /** Whether the constraints of inner degrees of freedom agree with @p mask. */
  bool is_of(const DofMask &mask) const;

  /** K_ii^-1 x. */
  Eigen::VectorXd solve(const Eigen::VectorXd &x) const;

  std::vector<std::int64_t> inner; ///< free inner degrees of freedom, see MatrixEntry
  std::vector<std::int64_t> at_contact; ///< all contact degrees of freedom
  Matrix whole;                         ///< K with the springs of the foundation
  Matrix coupling;                      ///< K_ic
  Eigen::MatrixXd at_nodes;             ///< S

private:
  void condense();

  const ElasticBody<dim> &body;
  std::vector<bool> is_held;    ///< per dof: constrained; false for contact dofs
  std::vector<bool> is_contact; ///< per dof: at the contact
  Eigen::CholmodSupernodalLLT<Matrix> factors;
};

/** Static solver for a body whose constraints and springs change only at its contact.
 * Several solvers may share one condensed stiffness. Replicated on all ranks. */
template <int dim>
class CondensedSolver : public StaticSolver
{
public:
  /** @p body and @p shared, which may be empty at first, must outlive it. */
  CondensedSolver(const ElasticBody<dim> &body,
                  std::unique_ptr<CondensedStiffness<dim>> &shared);

  void set_constrained(const DofMask &mask) override
  {
    set_constrained_on_springs(mask, {});
  }

  void set_constrained_on_springs(const DofMask &mask,
                                  const std::vector<SpringEntry> &on) override;

  /** @throws NotConverged if rigid motions are not constrained */
  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  const ElasticBody<dim> &body;
  std::unique_ptr<CondensedStiffness<dim>> &stiffness;
  std::vector<Eigen::Index> free; ///< free contact dofs, as indices into at_contact
  std::vector<SpringEntry> springs;
  Eigen::LDLT<Eigen::MatrixXd> factors; ///< S with springs, for the free dofs
  bool moves = false;                   ///< whether a rigid motion is left
};
} // namespace mesoslip

#endif
