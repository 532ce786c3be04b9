#ifndef mesoslip_body_rigid_motions_h
#define mesoslip_body_rigid_motions_h

#include "body/elastic_body.h"

#include <Eigen/Core>

#include <vector>

namespace mesoslip
{
/** Nodes of which one component moves as a rigid unit. */
struct NodesAsOne
{
  unsigned int component = 0;   ///< index of the component, 0: x
  std::vector<NodeIndex> nodes; ///< nodes of the group on this rank
};

/**
 * Rigid motions of a body about the centre of its bounding box: translations, then
 * rotations by one over a length of the body.
 */
template <int dim>
class RigidMotions
{
public:
  static constexpr int n = dim * (dim + 1) / 2;           ///< number of rigid motions
  using Displacements    = Eigen::Matrix<double, dim, n>; ///< a motion in each column
  using Coefficients     = Eigen::Matrix<double, n, 1>;   ///< coefficients of the motions
  using Hold             = Eigen::Matrix<double, n, n>;   ///< see hold_of()

  /** @p body must outlive it. */
  explicit RigidMotions(const ElasticBody<dim> &body)
    : body(body)
  {
  }

  /** Displacements of a point by each of the motions. */
  Displacements at(const std::array<double, dim> &point) const;

  /**
   * Gram matrix of the rigid motions at everything that resists them: constraints of
   * @p mask, periodic sides, springs and nodes that move @p as_one. It is the sum of m^T
   * m over constrained components (m: their row of at()), of m_c^T k_cd m_d over springs
   * (k relative to the stiffest one), and of m^T m over nodes that move as one, with m
   * less its mean. Collective.
   */
  Hold hold_of(const DofMask &mask,
               const std::vector<SpringEntry> &springs = {},
               const std::vector<NodesAsOne> &as_one   = {}) const;

  /** Unconstrained motions: eigenvectors of @p hold with eigenvalue zero. */
  static std::vector<Coefficients> left_by(const Hold &hold);

private:
  Hold hold_of(const NodesAsOne &group) const;

  const ElasticBody<dim> &body;
};

/**
 * Displacement fields of the rigid motions that constraints @p mask, periodic sides,
 * springs and nodes that move @p as_one leave free; linearly independent. Collective.
 */
template <int dim>
std::vector<NodalField<double>>
free_rigid_motions(const ElasticBody<dim> &body,
                   const DofMask &mask,
                   const std::vector<SpringEntry> &springs = {},
                   const std::vector<NodesAsOne> &as_one   = {});

/**
 * Whether constraints @p mask, periodic sides, springs and nodes that move @p as_one leave
 * a rigid motion free. Collective.
 */
template <int dim>
bool can_move(const ElasticBody<dim> &body,
              const DofMask &mask,
              const std::vector<SpringEntry> &springs = {},
              const std::vector<NodesAsOne> &as_one   = {});
} // namespace mesoslip

#endif
