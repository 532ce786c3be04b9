#ifndef mesoslip_eigenvalues_complex_sliding_pencil_h
#define mesoslip_eigenvalues_complex_sliding_pencil_h

#include "body/elastic_body.h"
#include "eigenvalues/complex/complex_factorization.h"

#include <array>
#include <vector>

namespace mesoslip
{
template <int dim>
class FreeDofs;

/** Derivatives of a node's coefficient of friction about steady sliding. */
struct FrictionSlopes
{
  double pressure = 0.; ///< p dmu/dp (-)
  double rate     = 0.; ///< instantaneous dmu/dV (s/m)
  double state    = 0.; ///< delayed dmu/dV by the state of the law (s/m)
};

/** Nodes that slide in the static state. */
struct SlidingNodesAtRest
{
  std::vector<NodeIndex> nodes; ///< pressed nodes, without periodic copies
  std::vector<std::vector<WeightedNode>>
    meets; ///< nodes of a second body below each node; empty: a rigid flat
  std::vector<double> friction;       ///< Coulomb coefficient of each node
  std::vector<double> normal_force;   ///< N (in 2D N/m); for slopes and in 3D
  std::vector<FrictionSlopes> slopes; ///< empty: constant coefficients
  std::vector<double> stiffness;      ///< contact springs (N/m, in 2D Pa); empty: rigid
  std::vector<double> slack; ///< compliance along the flat (m/N, in 2D 1/Pa); empty: none

  /** Velocity of the flat along x and, in 3D, y (m/s). */
  std::array<double, 2> velocity = {{1., 0.}};
};

/** Parameters of steady sliding apart from the body. */
struct SlidingLaw
{
  double delta      = 0.; ///< relaxation time of friction (s); 0: instantaneous
  double beta       = 0.; ///< stiffness-proportional damping (s)
  double state_time = 0.; ///< relaxation time of the state (s); 0: no state
  double alpha      = 0.; ///< mass-proportional damping (1/s), part of C_v
};

/**
 * Small vibrations u exp(s t) about steady sliding, in the unknowns of ContactMotion:
 *
 *     [ (s (s M + C_v) + K_s)/(1 + beta s) + K ] u = E q/(1 + beta s),   C_v = alpha M + C_d
 *     L(s) q = (1 + beta s) G u + G_s u + s (G_d - H(s) E^T) u,
 *     L(s) = 1 + s delta + s Y H(s),     H(s) = H_0 + H_1/(1 + s tau)
 *
 * E applies the friction forces q, of each contact node along the motion of the flat and,
 * in 3D, of each across it. G are mu + p dmu/dp times the normal reactions, along the
 * motion. K_s are undamped springs, at contact nodes and of the foundation; C_d are
 * dashpots of the foundation. If contact nodes stand on springs, G_s acts on the spring
 * reactions and G is zero. If damping differs by phase, beta is the smallest value, C_d
 * contains the excess of phases p, the sum of (beta_p - beta) K_p + alpha_p M_p, and G_d
 * acts on its normal reactions. The diagonal H is the drag of each node with static
 * normal force f. Along the motion it is f dmu/dV; for a law with a state a part H_1 of it
 * follows within tau. Across the motion it is mu f over the speed of the flat, as friction
 * turns against the velocity of the node. Y are compliances along the flat, in series with
 * friction. The form linear in s has v = s u and parts z of q by the state:
 *
 *     s u = v,        s M v = -K (u + beta v) - K_s u - C_v v + E q,
 *     s (delta + Y H_0) q = G (u + beta v) + G_s u + (G_d - D_0) v + z - q,
 *     s (tau z + Y H_1 q) = -D_1 v - z,      D_i = H_i E^T
 *
 * Without delta and Y H there is no q, without tau no z.
 *
 * In contact with a second body, contact nodes either follow its surface along the
 * normal, so that M is not diagonal, or stand on springs between the bodies. E contains
 * the forces on both bodies; D and G_s act on the relative motion. Reactions as in
 * ContactMotion.
 */
class SlidingPencil
{
public:
  using Complex = std::complex<double>; ///< in 1/s, or a displacement

  /** Number of unknowns. */
  Eigen::Index size() const
  {
    return mass.rows();
  }

  /** Number of unknowns of the form linear in s. */
  Eigen::Index state_size() const
  {
    const int memories = (remembers() ? 1 : 0) + (law.state_time > 0. ? 1 : 0);
    return 2 * size() + memories * targets.rows();
  }

  /** The matrix in brackets. */
  ComplexMatrix operator()(const Complex s) const;

  /** Relative residual: |[...] u| over the sum of the norms of the terms. */
  double residual(const Complex s, const ComplexVector &u) const;

  /** Friction forces for the motion u exp(s t). */
  ComplexVector friction_force(const Complex s, const ComplexVector &u) const;

  /** K + K_s. */
  RealMatrix whole_stiffness() const;

  /** E (G + G_s). */
  RealMatrix whole_friction() const
  {
    return distribution * RealMatrix(targets + spring_targets);
  }

  /** L(s), one number per friction force. */
  ComplexVector lag(const Complex s) const;

  /** delta + Y H_0 (s), one number per friction force. */
  Eigen::ArrayXd lag_at_once() const
  {
    return law.delta + slack.array() * drag_of_slip.array();
  }

  /** Y H_1 (s), one number per friction force. */
  Eigen::ArrayXd late_lag() const
  {
    return slack.array() * late_drag_of_slip.array();
  }

  /** Whether there is q in the form linear in s. */
  bool remembers() const
  {
    return (lag_at_once() != 0.).any() || (late_lag() != 0.).any();
  }

  /** Y (|H_0| + |H_1|) (s), above 0 where springs yield to changes of friction. */
  Eigen::ArrayXd yielding() const
  {
    return slack.array() * (drag_of_slip.array().abs() + late_drag_of_slip.array().abs());
  }

  /** Whether springs yield along the motion. */
  bool yields() const
  {
    return (yielding().head(n_along) > 0.).any();
  }

  /** Zeros of L(s) in the upper half plane (1/s), one per friction force on something
   * that moves: poles of the matrix in brackets, by a state on springs. */
  std::vector<Complex> poles() const;

  /** Upper bound of |1/L(s)| for all growing s; infinite if springs let friction that
   * falls with the slip rate grow by itself. */
  double largest_response() const;

  /** Whether contact nodes stand on springs. */
  bool on_springs() const
  {
    return springs.nonZeros() > 0;
  }

  RealMatrix free;                   ///< unknowns to free degrees of freedom
  RealMatrix mass;                   ///< M from lumped masses (kg, in 2D kg/m)
  Eigen::VectorXd own_mass;          ///< masses without followers: a diagonal not above M
  RealMatrix stiffness;              ///< K
  RealMatrix springs;                ///< K_s
  RealMatrix resistances;            ///< C_v
  RealMatrix targets;                ///< G, one row per friction force
  RealMatrix spring_targets;         ///< G_s, one row per friction force
  RealMatrix damped_targets;         ///< G_d, one row per friction force
  RealMatrix drag;                   ///< D_0, one row per friction force
  RealMatrix late_drag;              ///< D_1, one row per friction force
  Eigen::VectorXd drag_of_slip;      ///< H_0, one number per friction force
  Eigen::VectorXd late_drag_of_slip; ///< H_1, one number per friction force
  Eigen::VectorXd slack;             ///< Y, one number per friction force
  RealMatrix distribution;           ///< E: friction forces to forces on the bodies
  std::vector<std::size_t> contact_nodes; ///< contact nodes of the friction forces
  Eigen::Index n_along = 0; ///< number of forces along the motion, the first ones
  SlidingLaw law;           ///< damping and relaxation times
  double beta_besides = 0.; ///< mean of beta_p - beta over the vibrations (s)
};

/** Damping by phase of the whole body, numbered as in MatrixEntry. */
struct DampingByPhase
{
  RealMatrix stiffness;      ///< sum of (beta_p - beta) K_p; empty if there is none
  std::vector<double> drags; ///< sum of alpha_p M_p for each node
};

/** Product of a real matrix and a complex vector. */
ComplexVector product(const RealMatrix &matrix, const ComplexVector &x);

/**
 * Entries of K of the whole body on every rank, numbered as in MatrixEntry. Collective if
 * the body is distributed over @p communicator.
 */
template <int dim>
RealMatrix whole_stiffness(const ElasticBody<dim> &body, const MPI_Comm communicator);

/**
 * @p all is whole_stiffness(). @p dofs are the free degrees of freedom, without normal
 * displacements of sliding nodes unless these stand on springs or meet a second body.
 * Collective if there is @p damping and the body is distributed.
 */
template <int dim>
SlidingPencil make_sliding_pencil(const ElasticBody<dim> &body,
                                  const RealMatrix &all,
                                  const FreeDofs<dim> &dofs,
                                  const SlidingNodesAtRest &contact,
                                  const SlidingLaw &law,
                                  const DampingByPhase &damping = {});

} // namespace mesoslip

#endif
