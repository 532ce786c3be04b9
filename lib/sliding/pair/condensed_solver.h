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
/** The stiffness of a body with whole fields in one row, condensed to the nodes of its contact: with the inner degrees of freedom i and
 * those of the contact c, S = K_cc - K_ci K_ii^-1 K_ic. K_ii is factorized by CHOLMOD; a body that its contact alone holds is regular. */
template <int dim>
class CondensedStiffness
{
public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>; ///< sparse

  /** Of a @p body whose inner degrees of freedom are held by @p mask. */
  CondensedStiffness(const ElasticBody<dim> &body, const DofMask &mask);

  /** Whether inner degrees of freedom are held as by @p mask. */
  bool is_of(const DofMask &mask) const;

  /** K_ii^-1 x. */
  Eigen::VectorXd solve(const Eigen::VectorXd &x) const;

  std::vector<std::int64_t> inner; ///< degrees of freedom that are free, see MatrixEntry
  std::vector<std::int64_t> at_contact; ///< all of the contact
  Matrix whole;                         ///< K with the springs of the foundation
  Matrix coupling;                      ///< K_ic
  Eigen::MatrixXd at_nodes;             ///< S

private:
  void condense();

  const ElasticBody<dim> &body;
  std::vector<bool> is_held; ///< of all degrees of freedom; of those of the contact not
  std::vector<bool> is_contact; ///< likewise
  Eigen::CholmodSupernodalLLT<Matrix> factors;
};

/** Solves for a body whose constraints and springs change at its contact alone: with one condensed stiffness, which several solvers
 * may share. Each rank has all of it. */
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

  /** @throws NotConverged if the body moves as a whole */
  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  const ElasticBody<dim> &body;
  std::unique_ptr<CondensedStiffness<dim>> &stiffness;
  std::vector<Eigen::Index> free; ///< which of the degrees of freedom of the contact
  std::vector<SpringEntry> springs;
  Eigen::LDLT<Eigen::MatrixXd> factors; ///< of S with springs, among free ones
  bool moves = false;                   ///< whether nothing holds the body
};
} // namespace mesoslip

#endif
