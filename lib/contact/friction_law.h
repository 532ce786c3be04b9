#ifndef mesoslip_contact_friction_law_h
#define mesoslip_contact_friction_law_h

#include <memory>

namespace mesoslip
{
/** The motion of the contact nodes just before a step. */
struct SlidingNodes
{
  unsigned int n         = 0;       ///< number of nodes
  const double *velocity = nullptr; ///< along x (m/s), n values
  double flat_velocity   = 0.;      ///< m/s
};

/**
 * One step of d f / dt = -(f - target) / delta, solved exactly for a target that changes
 * linearly in time during the step:
 *
 *     f_new = target_new + decay (f - target) - lag (target_new - target)
 */
struct Relaxation
{
  /** A step of length @p dt (s) with the time @p delta (s); 0: f follows its target. */
  Relaxation(double dt, double delta);

  double decay; ///< exp(-dt / delta)
  double lag;   ///< (1 - decay) delta / dt
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
  SlipRateRegularization(double length, double reference_velocity);

  void update(const SlidingNodes &nodes,
              double dt,
              const NodeFriction &friction) const override;

private:
  double length, reference_velocity;
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
};
} // namespace mesoslip

#endif
