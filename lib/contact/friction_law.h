#ifndef mesoslip_contact_friction_law_h
#define mesoslip_contact_friction_law_h

#include "contact/laws/normal_stress_memory.h"
#include "contact/laws/relaxation.h"

#include <cmath>
#include <memory>

namespace mesoslip
{
class CoefficientLaw;

/** Motion of the contact nodes just before a step. */
struct SlidingNodes
{
  unsigned int n         = 0;       ///< number of nodes
  const double *velocity = nullptr; ///< along x (m/s), n values
  double flat_velocity   = 0.;      ///< along x (m/s)

  const double *lateral_velocity = nullptr; ///< in 3D: along y (m/s), n values
  double lateral_flat_velocity   = 0.;      ///< in 3D: along y (m/s)
};

/** Data that a NodeLaw may change, one value per node. */
struct NodeFriction
{
  double *coefficient; ///< Coulomb coefficient
  double *decay;       ///< decay of Relaxation
  double *lag;         ///< lag of Relaxation

  /** Sets the regularization of node @p i for the next step. */
  void set(const unsigned int i, const Relaxation &relaxation) const
  {
    decay[i] = relaxation.decay;
    lag[i]   = relaxation.lag;
  }
};

/**
 * A friction law whose parameters change with the motion of each node. It has no state:
 * the memory of the contact consists of the tangential traction and its target, so that a
 * run can be continued from a checkpoint.
 */
class NodeLaw
{
public:
  virtual ~NodeLaw() = default;

  /**
   * Called before each step of length @p dt (s): sets Coulomb coefficient and
   * regularization of each node. Values that it does not set are kept.
   */
  virtual void
  update(const SlidingNodes &nodes, double dt, const NodeFriction &friction) const = 0;
};

/** Regularization over a slip length: delta = L / (|V_rel| + V_ref). */
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

  /** Changes mu or delta with the motion; null: both are constant. */
  std::shared_ptr<const NodeLaw> node_law;

  /**
   * Law mu(rate, state, pressure, position, time), multiplied by the coefficient of the
   * node over reference; null: constant.
   */
  std::shared_ptr<const CoefficientLaw> coefficient_law;

  /** Coefficient of friction for which coefficient_law is written. */
  double reference = 1.;

  /** Memory of the normal stress in the friction limit; by default none. */
  NormalStressMemory normal_stress;

  /** Whether the friction limit is other than a constant mu times the normal force. */
  bool is_variable() const
  {
    return coefficient_law || normal_stress.is_given();
  }
};
} // namespace mesoslip

#endif
