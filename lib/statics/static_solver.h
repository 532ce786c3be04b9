#ifndef mesoslip_statics_static_solver_h
#define mesoslip_statics_static_solver_h

#include "base/serialize_members.h"
#include "elasticity/dof_mask.h"
#include "grid/nodal_field.h"

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesoslip
{
/** Solver of K u = f. */
enum class StaticSolverKind
{
  multigrid, ///< conjugate gradients with a multigrid cycle
  jacobi,    ///< conjugate gradients with the diagonal; needs no set-up
  ml,        ///< deal.II mesh, Trilinos matrix and ML; on several ranks
  divided    ///< grids' load cases only: voxel::Solver, rows divided among the ranks
};

/** Entry (c, d) of the stiffness (N/m) of a spring at a node. Both triangles of its
 * symmetric matrix are listed. */
struct SpringEntry
{
  NodeIndex node;        ///< supported node
  unsigned int c   = 0;  ///< row: component of the force
  unsigned int d   = 0;  ///< column: component of the displacement
  double stiffness = 0.; ///< N/m
  double rest      = 0.; ///< displacement of d without force (m)
};

/** Statistics of a solve. */
struct SolverReport
{
  unsigned int iterations = 0;  ///< iterations of the solver
  double residual         = 0.; ///< relative to the right-hand side

  /** Iterations in single precision before multigrid continued in double precision. */
  std::optional<unsigned int> single_iterations = std::nullopt;

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** A failed solve, with the reason for advice. */
class NotConverged : public std::runtime_error
{
public:
  /** Reason for stopping. */
  enum class Reason
  {
    iterations, ///< limit of iterations reached
    broke_down, ///< the preconditioner is indefinite, by round-off
    not_finite  ///< forces or displacements overflow or are NaN
  };

  /** @p text describes the failure, without advice. */
  explicit NotConverged(const std::string &text,
                        const Reason reason  = Reason::iterations,
                        const double reached = 1.)
    : std::runtime_error(text)
    , reason(reason)
    , reached(reached)
  {
  }

  const Reason reason; ///< reason for stopping
  const double
    reached; ///< smallest residual before the failure, relative to the right-hand side
};

/**
 * Static equilibrium K u = f of a body with constrained degrees of freedom. With
 * remaining rigid motions the solution is orthogonal to them, and force components along
 * them are projected out. Periodic bodies give periodic solutions.
 */
class StaticSolver
{
public:
  virtual ~StaticSolver() = default;

  /** Sets the constrained degrees of freedom; the expensive part of the set-up. */
  virtual void set_constrained(const DofMask &mask) = 0;

  /** Sets the constraints for K plus the stiffness of @p springs, which is positive
   * semidefinite; solve() must then start from u = 0. The default ignores the springs:
   * its solutions are only corrections in an outer iteration. */
  virtual void set_constrained_on_springs(const DofMask &mask,
                                          const std::vector<SpringEntry> & /*springs*/)
  {
    set_constrained(mask);
  }

  /**
   * Solves for the free entries of @p u; constrained entries are prescribed values on
   * entry, and @p force (N/m) is ignored there. Stops at |r| <= tolerance |r_0|, where
   * r_0 is the residual of the prescribed values only.
   * @throws NotConverged
   */
  virtual SolverReport solve(NodalField<double> &u,
                             const NodalField<double> &force,
                             const double tolerance) = 0;
};
} // namespace mesoslip

#endif
