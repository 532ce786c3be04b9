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
 * A friction law whose numbers change with the motion of each node. It keeps no state of
 * its own: the memory of the contact is the tangential traction, so that a run can be
 * continued from a checkpoint.
 */
class NodeLaw
{
public:
  virtual ~NodeLaw() = default;

  /**
   * Called before each step of length @p dt (s): sets Coulomb's coefficient and the
   * factor exp(-dt / delta) of each node. What it leaves alone keeps its value.
   */
  virtual void update(const SlidingNodes &nodes,
                      double dt,
                      double *coefficient,
                      double *decay) const = 0;
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
              double *coefficient,
              double *decay) const override;

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
