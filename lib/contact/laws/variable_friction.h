#ifndef mesoslip_contact_laws_variable_friction_h
#define mesoslip_contact_laws_variable_friction_h

#include "contact/contact_kernel.h"
#include "contact/friction_law.h"
#include "contact/laws/slip_law.h"
#include "dynamics/surface_condition.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** Velocity of the flat along x and y (m/s) in the step that ends and in the one that
 * begins. */
struct FlatMotion
{
  std::array<double, 2> before; ///< in the step that ends (m/s)
  std::array<double, 2> now;    ///< in the one that begins (m/s)
};

/**
 * The limit of friction of the nodes where it is not a constant times the normal force: the
 * coefficient of a SlipLaw at the slip rate of the same instant, and the memory of the normal
 * stress. Sets the coefficient that the contact kernel multiplies the normal force with.
 *
 * With lumped masses each node has an equation of its own. In a step the force f_n takes a
 * node from the slip rate V_- to V_+ = S - (dt/m) f_n, S being V_+ without friction, and
 * f_n = (1 - p) mu(V_n) N + h, where h is what the regularization remembers. V_n =
 * (1 - b) V_- + b V_+ with b = beta2 is the rate at t_n, of order two in dt for b = 1/2:
 *
 *     V_n + b (dt/m) (1 - p) N mu(V_n) = (1 - b) V_- + b (S - (dt/m) h)
 */
template <int dim>
class VariableFriction
{
public:
  /** Of nodes with these @p coefficients; @p area and @p position may be empty. */
  VariableFriction(const FrictionLaw &law,
                   const std::vector<double> &coefficients,
                   const std::vector<double> &area,
                   const std::array<std::vector<double>, 2> &position,
                   const StepParameters &step);

  /** Sets the friction coefficients of @p contact for the step that begins with @p surface;
   * decay and lag are set before. */
  void update(const SurfaceView<dim> &surface,
              const FlatMotion &flat,
              const ContactArrays &contact);

  /** What lasts from step to step. */
  struct Memory
  {
    std::vector<double> states;     ///< of the law, one a node
    std::vector<double> remembered; ///< normal force as friction knows it (N, in 2D N/m)
    double weakening = 0.;          ///< see largest_weakening()
  };

  /** Where it is, to come back to by recall(). */
  const Memory &memory() const
  {
    return kept;
  }

  /** Forgets the updates since @p memory. */
  void recall(const Memory &memory)
  {
    kept = memory;
  }

  /** The state of the law, one value a node; null if it has none. */
  const double *state() const
  {
    return kept.states.empty() ? nullptr : kept.states.data();
  }

  /** What the normal force is to friction (N, in 2D N/m), one value a node; null without a
   * memory of the normal stress. */
  const double *remembered_normal_force() const
  {
    return kept.remembered.empty() ? nullptr : kept.remembered.data();
  }

  /**
   * By how much friction has weakened within a step so far, relative to what the mass of a
   * node resists, at most: b (dt/m) (1 - p) N |d mu/d V| or (dt^2/m) N |d mu/d D|. From 1 on the
   * slip rate of a node is not unique, or slip grows faster than the steps follow.
   */
  double largest_weakening() const
  {
    return kept.weakening;
  }

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &kept.states &kept.remembered &kept.weakening;
  }

private:
  /** A node in this step. */
  struct Node
  {
    double normal    = 0.; ///< force (N)
    double free_rate = 0.; ///< m/s
    double softness  = 0.; ///< m/s for a force of one
  };

  Node predict(const SurfaceView<dim> &surface,
               const FlatMotion &flat,
               const ContactArrays &contact,
               const std::size_t i);
  void note_weakening(const double softness, const double free_share);

  const FrictionLaw law;
  const StepParameters step;
  std::vector<double> factor; ///< of the law's coefficient
  const std::vector<double> area;
  const std::array<std::vector<double>, 2> position;

  Memory kept;

  std::vector<SlipStep> before; ///< of one step, as all below
  std::vector<double> normal, free_rate, softness, pressure, coefficient;
};
} // namespace mesoslip

#endif
