#ifndef mesoslip_elasticity_brick_brick_operator_h
#define mesoslip_elasticity_brick_brick_operator_h

#include "elasticity/brick/brick_kernel.h"
#include "elasticity/brick/plane_exchange.h"
#include "elasticity/uniform_material.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"

#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Stiffness and lumped mass of a box of equal bricks, exactly integrated, without a matrix
 * and without anything but a byte for each cell (two where there are more than 255 phases). Ranks tell each other one plane of nodes a
 * neighbour and product; each computes the forces on all its nodes itself, in the same order
 * on any number of ranks, so they have the same bits.
 *
 * Fields are one row with a column for each point of slab().part.
 */
class BrickOperator
{
public:
  /** @p phases by index. Collective. */
  BrickOperator(BrickSlab slab,
                const std::vector<ElasticPhase<3>> &phases,
                const MPI_Comm communicator,
                const InstructionSet isa = InstructionSet::automatic);

  ~BrickOperator();

  BrickOperator(const BrickOperator &)            = delete; ///< kernels point into it
  BrickOperator &operator=(const BrickOperator &) = delete; ///< see the constructor

  /** What this rank has of the box. */
  const BrickSlab &slab() const
  {
    return the_slab;
  }

  /** Row sums of the mass matrix (kg), one for each point. */
  const std::vector<double> &lumped_mass() const
  {
    return mass;
  }

  /** @p f = K @p x (N) on all points of the part, where x has to be set on all. Collective. */
  void multiply(NodalField<double> &f, const NodalField<double> &x) const;

  /**
   * One step of all nodes but those whose forces are asked for; u and w of @p step have to
   * be set at the distinct nodes. Components in the order of the sweep, see sweep_axis.
   * Collective.
   */
  void advance(const kernels::BrickStep &step) const;

  /** Gives points that repeat others the values of these. */
  void set_copies(NodalField<double> &field) const;

  /** Gives all points that do not count here the values of those that do. Collective. */
  void set_points_of_others(NodalField<double> &field) const;

  /** Largest frequency of a free cell (1/s), a bound for the body. */
  double frequency_bound() const
  {
    return bound;
  }

  /** Instruction set and what the phases are. */
  std::string kernel_name() const;

  const MPI_Comm communicator; ///< of the ranks that share the box

  /** The axis of the body of each axis of the sweep: rows of a plane follow one another
   * along z, planes along y. */
  static constexpr unsigned int sweep_axis[3] = {0, 2, 1};

private:
  void set_mass(const std::vector<ElasticPhase<3>> &phases);
  void set_stiffness(const std::vector<ElasticPhase<3>> &phases);
  void
  exchange_planes(const double *const x[3], const double *const w[3], double beta) const;

  const BrickSlab the_slab;
  const InstructionSet isa;
  const kernels::BrickKernels kernels;
  unsigned int kind = 0; ///< of the kernels, see BrickKernels
  std::vector<double> mass;
  LineVector<double> stiffness;
  mutable LineVector<double> scratch, carry;
  kernels::BrickSweep sweep = {};
  std::unique_ptr<PlaneExchange> planes; ///< those of other ranks
  double bound = 0.;
};
} // namespace mesoslip

#endif
