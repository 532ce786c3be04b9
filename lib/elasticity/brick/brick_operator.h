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
 * Stiffness and lumped mass of a box of equal bricks, integrated exactly, matrix-free:
 * memory is one byte per cell (two with more than 255 phases). Neighbouring ranks
 * exchange one plane of nodes per product. Each rank computes the forces on all its nodes
 * itself, in an order independent of the number of ranks, so that results have the same
 * bits.
 *
 * Fields have one row with a column for each point of slab().part.
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

  BrickOperator(const BrickOperator &) = delete; ///< kernels keep pointers to it
  BrickOperator &operator=(const BrickOperator &) = delete; ///< not copyable either

  /** The part of the box on this rank. */
  const BrickSlab &slab() const
  {
    return the_slab;
  }

  /** Row sums of the mass matrix, one per point (kg). */
  const std::vector<double> &lumped_mass() const
  {
    return mass;
  }

  /**
   * @p f = K @p x (N) on all points of the part; requires x at all points. Collective.
   */
  void multiply(NodalField<double> &f, const NodalField<double> &x) const;

  /**
   * Advances all nodes by one step, except nodes whose forces are requested. u and w of
   * @p step are needed at the distinct nodes only. Components in the order of the sweep,
   * see sweep_axis. Collective.
   */
  void advance(const kernels::BrickStep &step) const;

  /** Updates periodic copies with the values of their masters. */
  void set_copies(NodalField<double> &field) const;

  /** Updates ghost values: points owned by other ranks. Collective. */
  void set_points_of_others(NodalField<double> &field) const;

  /** Largest angular frequency of a free cell (1/s), an upper bound for the body. */
  double frequency_bound() const
  {
    return bound;
  }

  /** Instruction set and kernel kind, for the log. */
  std::string kernel_name() const;

  const MPI_Comm communicator; ///< ranks that share the box

  /**
   * Axis of the body for each axis of the sweep: rows of a plane follow one another along
   * z, planes along y.
   */
  static constexpr unsigned int sweep_axis[3] = {0, 2, 1};

private:
  void set_mass(const std::vector<ElasticPhase<3>> &phases);
  void set_stiffness(const std::vector<ElasticPhase<3>> &phases);
  void
  exchange_planes(const double *const x[3], const double *const w[3], double beta) const;

  const BrickSlab the_slab;
  const InstructionSet isa;
  const kernels::BrickKernels kernels;
  unsigned int kind = 0; ///< kernel kind, see BrickKernels
  std::vector<double> mass;
  LineVector<double> stiffness;
  mutable LineVector<double> scratch, carry;
  kernels::BrickSweep sweep = {};
  std::unique_ptr<PlaneExchange> planes; ///< ghost planes of neighbouring ranks
  double bound = 0.;
};
} // namespace mesoslip

#endif
