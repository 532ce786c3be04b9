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
/** How K u = f is solved. */
enum class StaticSolverKind
{
  multigrid, ///< conjugate gradients with a multigrid cycle
  jacobi,    ///< conjugate gradients with the diagonal; needs no set-up
  ml,        ///< deal.II mesh, Trilinos matrix and ML; on several ranks
  divided ///< of load cases on a grid alone: voxel::Solver, rows divided among the ranks
};

/** Entry (c, d) of the stiffness (N/m) of a spring that holds a node. Both triangles of its symmetric
 * matrix are listed. */
struct SpringEntry
{
  NodeIndex node;        ///< that it holds
  unsigned int c   = 0;  ///< row: component of the force
  unsigned int d   = 0;  ///< column: component of the displacement
  double stiffness = 0.; ///< N/m
  double rest      = 0.; ///< displacement of d without force (m)
};

/** What a solve took. */
struct SolverReport
{
  unsigned int iterations = 0;  ///< of the iterative solver
  double residual         = 0.; ///< relative to the right-hand side

  /** Where multigrid went on in double precision: those in single precision before. */
  std::optional<unsigned int> single_iterations = std::nullopt;

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** A solve that failed, for a reason that advice may depend on. */
class NotConverged : public std::runtime_error
{
public:
  /** Why it ended. */
  enum class Reason
  {
    iterations, ///< as many as are allowed
    broke_down, ///< the preconditioner is indefinite, by round-off
    not_finite  ///< forces or displacements overflow or are no numbers
  };

  /** @p text says what happened, without advice. */
  explicit NotConverged(const std::string &text,
                        const Reason reason  = Reason::iterations,
                        const double reached = 1.)
    : std::runtime_error(text)
    , reason(reason)
    , reached(reached)
  {
  }

  const Reason reason; ///< why it ended
  const double
    reached; ///< smallest residual before that, relative to the right-hand side
};

/**
 * Static equilibrium K u = f of a body with constrained (held) degrees of freedom;
 * without enough of them the solution is fixed by being orthogonal to the rigid motions
 * that are left, and what f has of these is ignored. Periodic bodies give periodic
 * solutions.
 */
class StaticSolver
{
public:
  virtual ~StaticSolver() = default;

  /** Which degrees of freedom are held from now on; the costly part of the set-up. */
  virtual void set_constrained(const DofMask &mask) = 0;

  /** The same for K with the stiffness of @p springs, which is positive semidefinite; solve() then has to
   * begin with u = 0. Solvers that know no springs leave them out, so that their solutions are only
   * corrections towards those with springs. */
  virtual void set_constrained_on_springs(const DofMask &mask,
                                          const std::vector<SpringEntry> & /*springs*/)
  {
    set_constrained(mask);
  }

  /**
   * Solves for the free entries of @p u; the held ones are prescribed values on entry.
   * @p force (N/m) is ignored there. Stops at |r| <= tolerance |r_0|, r_0 being the
   * residual of the prescribed values alone.
   * @throws NotConverged
   */
  virtual SolverReport solve(NodalField<double> &u,
                             const NodalField<double> &force,
                             const double tolerance) = 0;
};
} // namespace mesoslip

#endif
