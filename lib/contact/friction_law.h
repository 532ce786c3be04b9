#ifndef mesoslip_contact_friction_law_h
#define mesoslip_contact_friction_law_h

#include "contact/laws/normal_stress_memory.h"
#include "contact/laws/relaxation.h"

#include <cmath>
#include <memory>

namespace mesoslip
{
class SlipLaw;

/** The motion of the contact nodes just before a step. */
struct SlidingNodes
{
  unsigned int n         = 0;       ///< number of nodes
  const double *velocity = nullptr; ///< along x (m/s), n values
  double flat_velocity   = 0.;      ///< along x (m/s)

  const double *lateral_velocity = nullptr; ///< in 3D: along y (m/s), n values
  double lateral_flat_velocity   = 0.;      ///< in 3D: along y (m/s)
};

/** What a NodeLaw may change: one value a node. */
struct NodeFriction
{
  double *coefficient; ///< Coulomb's
  double *decay;       ///< of Relaxation
  double *lag;         ///< of Relaxation

  /** Regularizes node @p i like this during the next step. */
  void set(const unsigned int i, const Relaxation &relaxation) const
  {
    decay[i] = relaxation.decay;
    lag[i]   = relaxation.lag;
  }
};

/**
 * A friction law whose numbers change with the motion of each node. It keeps no state of
 * its own: the memory of the contact is the tangential traction and its target, so that a
 * run can be continued from a checkpoint.
 */
class NodeLaw
{
public:
  virtual ~NodeLaw() = default;

  /**
   * Called before each step of length @p dt (s): sets Coulomb's coefficient and the
   * regularization of each node. What it leaves alone keeps its value.
   */
  virtual void
  update(const SlidingNodes &nodes, double dt, const NodeFriction &friction) const = 0;
};

/** delta = L / (|V_rel| + V_ref): the traction relaxes over a slip length. */
class SlipRateRegularization : public NodeLaw
{
public:
  /** @param length L (m); @param reference_velocity V_ref (m/s), so that delta stays
   * finite at rest. */
  SlipRateRegularization(const double length, const double reference_velocity)
    : length(length)
    , reference_velocity(reference_velocity)
  {
  }

  void update(const SlidingNodes &nodes,
              const double dt,
              const NodeFriction &friction) const override
  {
    for (unsigned int i = 0; i < nodes.n; ++i)
      {
        const double along     = std::fabs(nodes.flat_velocity - nodes.velocity[i]),
                     slip_rate = nodes.lateral_velocity == nullptr
                                   ? along
                                   : std::hypot(along, nodes.lateral_flat_velocity -
                                                         nodes.lateral_velocity[i]);
        friction.set(i, Relaxation(dt, length / (slip_rate + reference_velocity)));
      }
  }

private:
  const double length, reference_velocity;
};

/**
 * Coulomb friction with the tangential traction relaxing to its limit,
 * d sigma_t / dt = -(sigma_t - sign mu |sigma_n|) / delta (eq. 7).
 */
struct FrictionLaw
{
  /** delta (s); 0: plain Coulomb. */
  double time = 1.5e-6;

  /** Changes mu or delta with the motion; null: both are constant, which costs nothing.
   */
  std::shared_ptr<const NodeLaw> node_law;

  /** mu of rate, state, pressure, place and time, times the node's own coefficient over
   * reference; null: constant, which costs nothing. */
  std::shared_ptr<const SlipLaw> slip_law;

  /** The coefficient of the nodes for which slip_law is written. */
  double reference = 1.;

  /** How the limit of friction follows the normal stress; not given: at once. */
  NormalStressMemory normal_stress;

  /** Whether a limit of friction is not the constant mu times the normal force. */
  bool is_variable() const
  {
    return slip_law || normal_stress.is_given();
  }
};
} // namespace mesoslip

#endif
