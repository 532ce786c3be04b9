#ifndef mesoslip_eigenvalues_complex_sliding_pencil_h
#define mesoslip_eigenvalues_complex_sliding_pencil_h

#include "body/elastic_body.h"
#include "eigenvalues/complex/complex_factorization.h"
#include "eigenvalues/free_dofs.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** The nodes that slide on the flat in the static state. */
struct SlidingNodesAtRest
{
  std::vector<NodeIndex> nodes;     ///< pressed, without duplicates
  std::vector<double> friction;     ///< Coulomb's coefficient of each of them
  std::vector<double> normal_force; ///< N (2D: N/m) of each of them; used in 3D only

  /** Of the flat along x and, in 3D, y (m/s). */
  std::array<double, 2> velocity = {{1., 0.}};
};

/** What steady sliding has besides its body. */
struct SlidingLaw
{
  double delta = 0.; ///< time in which friction follows its target (s); 0: at once
  double beta  = 0.; ///< of the stiffness-proportional damping (s)
};

/**
 * Small vibrations u exp(s t) about steady sliding, in the free degrees of freedom:
 *
 *     [ s^2/(1 + beta s) M + K - N/(1 + s delta) + s/((1 + beta s)(1 + s delta)) C ] u = 0
 *
 * N moves mu times the normal reaction of each contact node to its rows along the motion of the
 * flat. C, in 3D only, is the drag across this motion: friction turns against the velocity
 * of the node, by mu times its static normal force over the speed of the flat.
 * Linear in s with v = s u and the friction forces q:
 *
 *     s u = v,    s M v = -K (u + beta v) + E q,    s delta q = G (u + beta v) - D v - q
 *
 * with N = E G and C = E D. Without delta there is no q.
 */
class SlidingPencil
{
public:
  using Complex = std::complex<double>; ///< 1/s, and displacements

  /** Number of degrees of freedom. */
  Eigen::Index size() const
  {
    return mass.size();
  }

  /** Number of unknowns of the form that is linear in s. */
  Eigen::Index state_size() const
  {
    return 2 * size() + (law.delta > 0. ? targets.rows() : 0);
  }

  /** The matrix in brackets. */
  ComplexMatrix operator()(const Complex s) const;

  /** |[...] u| over the sum of the sizes of the terms. */
  double residual(const Complex s, const ComplexVector &u) const;

  /** Friction forces of the motion u exp(s t), one for each entry of rows. */
  ComplexVector friction_force(const Complex s, const ComplexVector &u) const;

  Eigen::VectorXd mass;                   ///< M, lumped (kg, 2D: kg/m)
  RealMatrix stiffness;                   ///< K
  RealMatrix targets;                     ///< G, a row for each friction force
  RealMatrix drag;                        ///< D, likewise
  RealMatrix friction;                    ///< N
  RealMatrix resistance;                  ///< C
  std::vector<Eigen::Index> rows;         ///< degrees of freedom that E gives the forces
  std::vector<std::size_t> contact_nodes; ///< those of the forces
  SlidingLaw law;                         ///< delta and beta
};

/**
 * The entries of K of the whole body on every rank, numbered as MatrixEntry says.
 * Collective if the body is distributed over @p communicator.
 */
template <int dim>
RealMatrix whole_stiffness(const ElasticBody<dim> &body, const MPI_Comm communicator);

/**
 * @p all is whole_stiffness(); @p dofs are the free ones, of the normal displacement of sliding
 * nodes none.
 */
template <int dim>
SlidingPencil make_sliding_pencil(const ElasticBody<dim> &body,
                                  const RealMatrix &all,
                                  const FreeDofs<dim> &dofs,
                                  const SlidingNodesAtRest &contact,
                                  const SlidingLaw &law);

/** Applies (A - sigma B)^-1 B of the linear form A x = s B x, scaled; see nearest(). */
class ShiftedInverse
{
public:
  /** @p factors of pencil(@p shift) have to outlive this object, like @p pencil. @p
   * frequency (1/s) scales v. */
  ShiftedInverse(const SlidingPencil &pencil,
                 const ComplexFactorization &factors,
                 const SlidingPencil::Complex shift,
                 const double frequency);

  /** dst = the operator applied to src, of length SlidingPencil::state_size(). */
  void vmult(ComplexVector &dst, const ComplexVector &src) const;

private:
  const SlidingPencil &pencil;
  const ComplexFactorization &factors;
  const SlidingPencil::Complex shift;
  const double of_v; ///< v = of_v times its scaled unknowns
  const double of_q; ///< q likewise
};
} // namespace mesoslip

#endif
