#ifndef mesoslip_contact_friction_law_h
#define mesoslip_contact_friction_law_h

#include <cmath>
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
  Relaxation(const double dt, const double delta)
  {
    if (!(delta > 0.))
      return;
    // From 1 - exp(-x), which keeps its digits for small x.
    const double x = dt / delta, relaxed = -std::expm1(-x);
    decay = 1. - relaxed;
    lag   = x > 0. ? relaxed / x : 1.;
  }

  double decay = 0.; ///< exp(-dt / delta)
  double lag   = 0.; ///< (1 - decay) delta / dt
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
        const double slip_rate = std::fabs(nodes.flat_velocity - nodes.velocity[i]);
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
};
} // namespace mesoslip

#endif
