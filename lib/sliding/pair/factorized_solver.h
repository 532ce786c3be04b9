#ifndef mesoslip_sliding_pair_factorized_solver_h
#define mesoslip_sliding_pair_factorized_solver_h

#include "body/elastic_body.h"

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** Solves for bodies with whole fields in one row by Eigen's sparse Cholesky factors, which are made anew for other constraints.
 * Each rank has all of it. */
template <int dim>
class FactorizedSolver : public StaticSolver
{
public:
  /** @p body must outlive it. */
  explicit FactorizedSolver(const ElasticBody<dim> &body);

  /** @throws NotConverged if the body moves as a whole */
  void set_constrained(const DofMask &mask) override
  {
    set_constrained_on_springs(mask, {});
  }

  void set_constrained_on_springs(const DofMask &mask,
                                  const std::vector<SpringEntry> &on) override;

  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

  const ElasticBody<dim> &body;
  const std::vector<MatrixEntry> of_cells;
  std::vector<std::int64_t>
    number;        ///< of each degree of freedom among the free ones, or -1
  Matrix coupling; ///< of free degrees of freedom (rows) to all
  Eigen::SimplicialLDLT<Matrix> factors;
  bool is_singular = false;
};
} // namespace mesoslip

#endif
