#ifndef mesoslip_sliding_pair_pair_body_h
#define mesoslip_sliding_pair_pair_body_h

#include "body/point_body.h"
#include "contact/pair/surface_weights.h"
#include "eigenvalues/complex/complex_factorization.h"
#include "sliding/pair/condensed_solver.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** Block diagonal matrix of both matrices. */
RealMatrix blocks_of(const std::array<RealMatrix, 2> &matrices);

/** Contact nodes of a lower body and the weights with which nodes of the upper body meet
 * them. */
struct MeetingNodes
{
  std::vector<NodeIndex> below; ///< in the order of the columns of weights
  SurfaceWeights weights;       ///< W
};

/**
 * Two bodies in contact as one body for statics and modes, with replicated fields in one
 * row: nodes of the upper body, then nodes of the lower body. Its contact is the contact
 * of the upper body. Displacements u are absolute (Motion::absolute), or relative at the
 * contact nodes: u_1 = u + W u_2. With relative displacements the contact conditions are
 * those of a rigid flat, forces on them act on both bodies, and the stiffness is T^T K T
 * with the matrix T that makes displacements absolute. The lower body has to be held by
 * its own supports; sums skip its nodes.
 */
template <int dim>
class PairBody final : public ElasticBody<dim>
{
public:
  using Cells = typename ElasticBody<dim>::Cells; ///< values in a group of cells

  /** Whether the contact of the upper body has relative displacements. */
  enum class Motion
  {
    absolute,
    relative
  };

  /** @p stiffness are the matrices of both bodies, whose contacts meet as in @p given.
   * The bodies must outlive it. Collective. */
  PairBody(const PointBody<dim> &above,
           const PointBody<dim> &below,
           const MeetingNodes &given,
           const std::array<RealMatrix, 2> &stiffness,
           const Motion motion);

  /** The absolute displacements of both bodies. */
  std::array<NodalField<double>, 2> parts(const NodalField<double> &u) const;

  /** Index of a node of the lower body in this body. */
  NodeIndex below_node(const NodeIndex &node) const
  {
    return {n_above + node.i, 0};
  }

  std::vector<WeightedNode> meets(const std::size_t k) const override;

  /** Also of the lower body. */
  std::vector<bool> counted_masters() const override;

  void act_on_displacements(NodalField<double> &force) const override;
  std::array<double, dim> point(const NodeIndex &node) const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  std::vector<VoigtMatrix<dim>>
  strain_products(const NodalField<double> &u) const override;
  std::vector<MatrixEntry> stiffness_entries() const override;
  std::unique_ptr<StaticSolver> make_solver() const override;

  /** Not available for a pair.
   * @throws std::invalid_argument */
  std::unique_ptr<ElasticBody<dim>> make_periodic() const override;

private:
  void multiply(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::vector<double> mass_of_cells() const override
  {
    return masses;
  }

  RealMatrix transformation() const;
  std::vector<SpringEntry> springs_of_above(const bool at_relative) const;
  void take_foundations();

  const PointBody<dim> &above;
  const PointBody<dim> &below;
  const unsigned int n_above; ///< nodes of the upper body
  const Motion motion;
  MeetingNodes meeting; ///< with lower nodes renumbered as in this body
  std::vector<unsigned int>
    follows; ///< periodic master of each node; a master is its own
  mutable std::unique_ptr<CondensedStiffness<dim>>
    condensed; ///< stiffness shared by its solvers; empty before the first solve
  std::vector<double> masses; ///< nodal masses (kg, in 2D kg/m)
  RealMatrix T;               ///< makes displacements absolute
  RealMatrix K;               ///< stiffness of cells and of springs at the contact
};
} // namespace mesoslip

#endif
