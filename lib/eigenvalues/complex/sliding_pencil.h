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
 *     [ s (s M + C_v)/(1 + beta s) + K - N/(1 + s delta) + s/((1 + beta s)(1 + s delta)) (C(s) - N_d)
 *       + (K_s - N_s/(1 + s delta))/(1 + beta s) ] u = 0,   C_v = alpha M + C_d
 *     C(s) = C_0 + C_1/(1 + s tau)
 *
 * N adds mu + p dmu/dp times the normal reaction of each contact node to its tangential
 * rows, in the direction of the flat's motion. K_s are undamped springs, at contact nodes
 * and of the foundation; C_d are dashpots of the foundation. If contact nodes stand on
 * springs, N_s acts on the spring reactions and N is zero. If damping differs by phase,
 * beta is the smallest value, C_d contains the excess of phases p, the sum of (beta_p -
 * beta) K_p + alpha_p M_p, and N_d acts on its normal reactions. C is the drag of each
 * node with static normal force f. Along the motion it is f dmu/dV; for a law with a
 * state a part C_1 of it follows within tau. Across the motion, in 3D only, it is mu f
 * over the speed of the flat, as friction turns against the velocity of the node. The
 * form linear in s has v = s u, friction forces q, and their parts z by the state:
 *
 *     s u = v,                     s M v = -K (u + beta v) - K_s u - C_v v + E q,
 *     s tau z = -D_1 v - z,        s delta q = G (u + beta v) + G_s u + (G_d - D_0) v + z - q
 *
 * with N = E G, N_s = E G_s, N_d = E G_d and C_i = E D_i. Without delta there is no q,
 * without tau no z.
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
    const int memories = (law.delta > 0. ? 1 : 0) + (law.state_time > 0. ? 1 : 0);
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

  /** N + N_s. */
  RealMatrix whole_friction() const
  {
    return friction + spring_friction;
  }

  /** Whether contact nodes stand on springs. */
  bool on_springs() const
  {
    return springs.nonZeros() > 0;
  }

  RealMatrix free;            ///< unknowns to free degrees of freedom
  RealMatrix mass;            ///< M from lumped masses (kg, in 2D kg/m)
  Eigen::VectorXd own_mass;   ///< masses without followers: a diagonal not above M
  RealMatrix stiffness;       ///< K
  RealMatrix springs;         ///< K_s
  RealMatrix resistances;     ///< C_v
  RealMatrix targets;         ///< G, one row per friction force
  RealMatrix spring_targets;  ///< G_s, one row per friction force
  RealMatrix damped_targets;  ///< G_d, one row per friction force
  RealMatrix drag;            ///< D_0, one row per friction force
  RealMatrix late_drag;       ///< D_1, one row per friction force
  RealMatrix drag_of_slip;    ///< symmetric H, with D_0 = H E^T
  RealMatrix friction;        ///< N
  RealMatrix spring_friction; ///< N_s
  RealMatrix damped_friction; ///< N_d
  RealMatrix resistance;      ///< C_0
  RealMatrix late_resistance; ///< C_1
  RealMatrix distribution;    ///< E: friction forces to forces on the bodies
  std::vector<std::size_t> contact_nodes; ///< contact nodes of the friction forces
  SlidingLaw law;                         ///< damping and relaxation times
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
