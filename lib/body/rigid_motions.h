#ifndef mesoslip_body_rigid_motions_h
#define mesoslip_body_rigid_motions_h

#include "body/elastic_body.h"

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/** Nodes of which a component moves as one. */
struct NodesAsOne
{
  unsigned int component = 0;   ///< 0: x
  std::vector<NodeIndex> nodes; ///< that this rank has
};

/** The rigid motions of a body about the middle of its bounding box: translations, then
 * rotations by one over a length of the body. */
template <int dim>
class RigidMotions
{
public:
  static constexpr int n = dim * (dim + 1) / 2;           ///< their number
  using Displacements    = Eigen::Matrix<double, dim, n>; ///< a motion in a column
  using Coefficients     = Eigen::Matrix<double, n, 1>;   ///< of the motions
  using Hold             = Eigen::Matrix<double, n, n>;   ///< see hold_of()

  /** @p body must outlive it. */
  explicit RigidMotions(const ElasticBody<dim> &body)
    : body(body)
  {
  }

  /** Displacements of a point by each of them. */
  Displacements at(const std::array<double, dim> &point) const;

  /**
   * What the constraints @p mask, periodic sides, springs and nodes that move @p as_one
   * hold: the sum of m^T m over all constrained components, m being their row of at(), of
   * m_c^T k_cd m_d over the springs, k being a share of the stiffest, and of m^T m over nodes that move as one, less
   * their mean m. Collective.
   */
  Hold hold_of(const DofMask &mask,
               const std::vector<SpringEntry> &springs = {},
               const std::vector<NodesAsOne> &as_one   = {}) const;

  /** The motions that these leave: eigenvectors for the eigenvalue zero. */
  static std::vector<Coefficients> left_by(const Hold &hold);

private:
  Hold hold_of(const NodesAsOne &group) const;

  const ElasticBody<dim> &body;
};

/**
 * The displacement fields of the rigid motions that the constraints @p mask, periodic
 * sides, springs and nodes that move @p as_one leave; linearly independent.
 * Collective.
 */
template <int dim>
std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<dim> &body,
                   const DofMask &mask,
                   const std::vector<SpringEntry> &springs = {},
                   const std::vector<NodesAsOne> &as_one   = {});

/** Whether the constraints @p mask, periodic sides and springs leave a rigid motion. Collective. */
template <int dim>
bool can_move(const ElasticBody<dim> &body,
              const DofMask &mask,
              const std::vector<SpringEntry> &springs = {});
} // namespace mesoslip

#endif
