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

/** How the coefficient of a node changes about steady sliding. */
struct FrictionSlopes
{
  double pressure = 0.; ///< p dmu/dp (-)
  double rate     = 0.; ///< dmu/dV of the slip rate at once (s/m)
  double state    = 0.; ///< likewise by the state of the law, which lags behind (s/m)
};

/** The nodes that slide on the flat in the static state. */
struct SlidingNodesAtRest
{
  std::vector<NodeIndex> nodes; ///< pressed, without duplicates
  std::vector<std::vector<WeightedNode>>
    meets; ///< what each of them meets of a second body; empty: a rigid flat
  std::vector<double> friction;       ///< Coulomb's coefficient of each of them
  std::vector<double> normal_force;   ///< N (2D: N/m) of each; for slopes and in 3D
  std::vector<FrictionSlopes> slopes; ///< of each; empty: constant coefficients
  std::vector<double> stiffness; ///< of the spring below each (N/m, 2D: Pa); empty: rigid

  /** Of the flat along x and, in 3D, y (m/s). */
  std::array<double, 2> velocity = {{1., 0.}};
};

/** What steady sliding has besides its body. */
struct SlidingLaw
{
  double delta      = 0.; ///< time in which friction follows its target (s); 0: at once
  double beta       = 0.; ///< of the stiffness-proportional damping (s)
  double state_time = 0.; ///< in which the state follows the slip rate (s); 0: no state
  double alpha      = 0.; ///< of the mass-proportional damping (1/s), which C_v has
};

/**
 * Small vibrations u exp(s t) about steady sliding, in the unknowns that ContactMotion says:
 *
 *     [ s (s M + C_v)/(1 + beta s) + K - N/(1 + s delta) + s/((1 + beta s)(1 + s delta)) (C(s) - N_d)
 *       + (K_s - N_s/(1 + s delta))/(1 + beta s) ] u = 0,   C_v = alpha M + C_d
 *     C(s) = C_0 + C_1/(1 + s tau)
 *
 * N moves mu + p dmu/dp times the normal reaction of each contact node to its rows along the
 * motion of the flat. Springs below contact nodes and of the foundation, which are not damped, are K_s,
 * dashpots of the foundation C_d. Where contact nodes stand on springs, N_s moves their reactions; N is
 * zero then. Where damping differs by phase, beta is the smallest, C_d has what phases p have besides, the sum of
 * (beta_p - beta) K_p + alpha_p M_p, and N_d moves its normal reactions. C is the drag of each node, whose static normal force is f:
 * along the motion f dmu/dV, of which a law with a state has a part C_1 that follows within tau; across
 * it, in 3D only, mu f over the speed of the flat, as friction turns against the velocity of
 * the node. Linear in s with v = s u, the friction forces q, and their parts z by the state:
 *
 *     s u = v,                     s M v = -K (u + beta v) - K_s u - C_v v + E q,
 *     s tau z = -D_1 v - z,        s delta q = G (u + beta v) + G_s u + (G_d - D_0) v + z - q
 *
 * with N = E G, N_s = E G_s, N_d = E G_d and C_i = E D_i. Without delta there is no q, without tau no z.
 *
 * Contact nodes follow what they meet of a second body along the normal, so that M is not diagonal, or stand on the springs between
 * them; E has the forces on both, and D and G_s act on their relative motion. Reactions are those of ContactMotion.
 */
class SlidingPencil
{
public:
  using Complex = std::complex<double>; ///< 1/s, and displacements

  /** Number of unknowns. */
  Eigen::Index size() const
  {
    return mass.rows();
  }

  /** Number of unknowns of the form that is linear in s. */
  Eigen::Index state_size() const
  {
    const int memories = (law.delta > 0. ? 1 : 0) + (law.state_time > 0. ? 1 : 0);
    return 2 * size() + memories * targets.rows();
  }

  /** The matrix in brackets. */
  ComplexMatrix operator()(const Complex s) const;

  /** |[...] u| over the sum of the sizes of the terms. */
  double residual(const Complex s, const ComplexVector &u) const;

  /** Friction forces of the motion u exp(s t). */
  ComplexVector friction_force(const Complex s, const ComplexVector &u) const;

  /** K + K_s. */
  RealMatrix whole_stiffness() const;

  /** N + N_s. */
  RealMatrix whole_friction() const
  {
    return friction + spring_friction;
  }

  /** Whether nodes stand on springs. */
  bool on_springs() const
  {
    return springs.nonZeros() > 0;
  }

  RealMatrix free; ///< free degrees of freedom by unknowns
  RealMatrix mass; ///< M, of lumped ones (kg, 2D: kg/m)
  Eigen::VectorXd
    own_mass;           ///< of unknowns without what follows them: a diagonal not above M
  RealMatrix stiffness; ///< K
  RealMatrix springs;   ///< K_s
  RealMatrix resistances;                 ///< C_v
  RealMatrix targets;                     ///< G, a row for each friction force
  RealMatrix spring_targets;              ///< G_s, likewise
  RealMatrix damped_targets;              ///< G_d, likewise
  RealMatrix drag;                        ///< D_0, likewise
  RealMatrix late_drag;                   ///< D_1, likewise
  RealMatrix drag_of_slip;                ///< symmetric H, with D_0 = H E^T
  RealMatrix friction;                    ///< N
  RealMatrix spring_friction;             ///< N_s
  RealMatrix damped_friction;             ///< N_d
  RealMatrix resistance;                  ///< C_0
  RealMatrix late_resistance;             ///< C_1
  RealMatrix distribution;                ///< E: what friction forces do on the bodies
  std::vector<std::size_t> contact_nodes; ///< those of the forces
  SlidingLaw law;                         ///< delta and beta
  double beta_besides = 0.; ///< mean over the vibrations of beta_p - beta (s)
};

/** Damping by phase of the whole body, numbered as MatrixEntry says. */
struct DampingByPhase
{
  RealMatrix stiffness;      ///< sum of (beta_p - beta) K_p; empty: there is none
  std::vector<double> drags; ///< sum of alpha_p M_p of the nodes
};

/** What @p matrix does with a complex vector. */
ComplexVector product(const RealMatrix &matrix, const ComplexVector &x);

/**
 * The entries of K of the whole body on every rank, numbered as MatrixEntry says.
 * Collective if the body is distributed over @p communicator.
 */
template <int dim>
RealMatrix whole_stiffness(const ElasticBody<dim> &body, const MPI_Comm communicator);

/**
 * @p all is whole_stiffness(); @p dofs are the free ones, of the normal displacement of sliding
 * nodes none, unless they stand on springs or meet a second body. Collective if there is @p damping and the body is distributed.
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
