#ifndef mesoslip_contact_laws_variable_friction_h
#define mesoslip_contact_laws_variable_friction_h

#include "contact/contact_kernel.h"
#include "contact/friction_law.h"
#include "contact/laws/coefficient_law.h"
#include "dynamics/surface_condition.h"

#include <array>
#include <vector>

namespace mesoslip
{
/**
 * Velocity of the flat along x and y (m/s) in the step that ends and in the step that
 * begins.
 */
struct FlatMotion
{
  std::array<double, 2> before; ///< in the step that ends (m/s)
  std::array<double, 2> now;    ///< in the step that begins (m/s)
};

/**
 * Friction limit that is not a constant times the normal force: the coefficient of a
 * CoefficientLaw at the slip rate of the same instant, and the memory of the normal stress. Sets
 * the coefficient by which the contact kernel multiplies the normal force.
 *
 * With lumped masses each node has its own equation. In a step the force f_n changes the
 * slip rate of a node from V_- to V_+ = S - (dt/m) f_n, where S is V_+ without friction
 * and f_n = (1 - p) mu(V_n) N + h, with the remembered part h of the regularization. V_n
 * = (1 - b) V_- + b V_+ with b = beta2 is the rate at t_n, of order two in dt for b =
 * 1/2:
 *
 *     V_n + b (dt/m) (1 - p) N mu(V_n) = (1 - b) V_- + b (S - (dt/m) h)
 */
template <int dim>
class VariableFriction
{
public:
  /**
   * Friction of nodes with these @p coefficients; @p area and @p position may be empty.
   */
  VariableFriction(const FrictionLaw &law,
                   const std::vector<double> &coefficients,
                   const std::vector<double> &area,
                   const std::array<std::vector<double>, 2> &position,
                   const StepParameters &step);

  /**
   * Sets the friction coefficients of @p contact for the step that begins with
   * @p surface; decay and lag must be set before.
   */
  void update(const SurfaceView<dim> &surface,
              const FlatMotion &flat,
              const ContactArrays &contact);

  /** State that is kept from step to step. */
  struct Memory
  {
    std::vector<double> states;     ///< state of the law, one per node
    std::vector<double> remembered; ///< relaxed normal force (N, in 2D N/m)
    double weakening = 0.;          ///< see largest_weakening()
  };

  /** Current memory, to be restored by recall(). */
  const Memory &memory() const
  {
    return kept;
  }

  /** Undoes the updates since @p memory. */
  void recall(const Memory &memory)
  {
    kept = memory;
  }

  /** State of the law, one value per node; null if it has none. */
  const double *state() const
  {
    return kept.states.empty() ? nullptr : kept.states.data();
  }

  /**
   * Normal force that enters friction (N, in 2D N/m), one value per node; null without a
   * memory of the normal stress.
   */
  const double *remembered_normal_force() const
  {
    return kept.remembered.empty() ? nullptr : kept.remembered.data();
  }

  /**
   * Largest weakening of friction within a step so far, relative to the inertia of a
   * node: b (dt/m) (1 - p) N |d mu/d V| or (dt^2/m) N |d mu/d D|. From 1 on the slip rate
   * of a node is not unique, or slip grows faster than the steps can follow.
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
  /** Prediction for a node in this step. */
  struct Node
  {
    double normal    = 0.; ///< normal force (N)
    double free_rate = 0.; ///< slip rate without friction (m/s)
    double softness  = 0.; ///< change of the rate by a unit force
  };

  Node predict(const SurfaceView<dim> &surface,
               const FlatMotion &flat,
               const ContactArrays &contact,
               const std::size_t i);
  void note_weakening(const double softness, const double free_share);

  const FrictionLaw law;
  const StepParameters step;
  std::vector<double> factor; ///< factor of the coefficient of the law
  const std::vector<double> area;
  const std::array<std::vector<double>, 2> position;

  Memory kept;

  std::vector<SlipStep> before; ///< work arrays of one step, as all below
  std::vector<double> normal, free_rate, softness, pressure, coefficient;
};
} // namespace mesoslip

#endif
