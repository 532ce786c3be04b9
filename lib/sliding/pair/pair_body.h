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
/** Both matrices as blocks. */
RealMatrix blocks_of(const std::array<RealMatrix, 2> &matrices);

/** The nodes of the contact of a lower body, and what those of the upper one meet of them. */
struct MeetingNodes
{
  std::vector<NodeIndex> below; ///< in the order of the weights' columns
  SurfaceWeights weights;       ///< W
};

/**
 * Two bodies that meet, as one for statics and modes, with whole fields: in one row the nodes of the upper body,
 * behind them those of the lower one. Its contact is that of the upper body. The displacements u are absolute, or those of the
 * nodes of its contact are relative to what they meet: u_1 = u + W u_2. Then the conditions of the contact are those on a rigid
 * flat, forces on these displacements act on both bodies, and the stiffness is T^T K T with the matrix T that makes them
 * absolute; nodes of the lower body, which has to be held by itself, do not count in sums.
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

  /** @p stiffness of the cells of both bodies, whose contacts are the meeting @p given. The bodies must outlive it. Collective. */
  PairBody(const PointBody<dim> &above,
           const PointBody<dim> &below,
           const MeetingNodes &given,
           const std::array<RealMatrix, 2> &stiffness,
           const Motion motion);

  /** The absolute displacements of both bodies. */
  std::array<NodalField<double>, 2> parts(const NodalField<double> &u) const;

  /** A node of the lower body. */
  NodeIndex below_node(const NodeIndex &node) const
  {
    return {n_above + node.i, 0};
  }

  std::vector<WeightedNode> meets(const std::size_t k) const override;

  void act_on_displacements(NodalField<double> &force) const override;
  std::array<double, dim> point(const NodeIndex &node) const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  std::vector<MatrixEntry> stiffness_entries() const override;
  std::unique_ptr<StaticSolver> make_solver() const override;

  /** Of a pair there is none. @throws std::invalid_argument */
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
  MeetingNodes meeting; ///< with the numbers that nodes below have here
  std::vector<unsigned int>
    follows; ///< of each node the one that it duplicates, or itself
  mutable std::unique_ptr<CondensedStiffness<dim>>
    condensed; ///< stiffness that its solvers share; empty before the first solve
  std::vector<double> masses; ///< of the nodes (kg, in 2D kg/m)
  RealMatrix T;               ///< makes displacements absolute
  RealMatrix K;               ///< of cells, and of springs that hold the contact
};
} // namespace mesoslip

#endif
