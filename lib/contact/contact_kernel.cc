#include "contact/contact_kernel.h"

#include <limits>

namespace mesoslip
{
namespace
{
// GCC's vector extension: comparisons give masks, ?: selects lane by lane.
using Vec = double
  __attribute__((vector_size(contact_lanes * sizeof(double)), aligned(sizeof(double))));

// Held nodes have no compliance; dividing by the smallest normal number keeps the
// arithmetic free of branches and of 0/0.
constexpr double smallest = std::numeric_limits<double>::min();

struct LaneSums
{
  Vec normal, tangential, sticking, touching, friction_energy, impact_energy;
};

inline double
sum(const Vec &lanes)
{
  double s = 0.;
  for (std::size_t l = 0; l < contact_lanes; ++l)
    s += lanes[l];
  return s;
}

// Macros instead of inline functions: a function would be compiled for the baseline
// instruction set and not be inlined into the clones.
#define MESOSLIP_LOAD(pointer) (*reinterpret_cast<const Vec *>((pointer) + i))
#define MESOSLIP_STORE(pointer, value) (*reinterpret_cast<Vec *>((pointer) + i) = (value))
#define MESOSLIP_ABS(value) ((value) < 0. ? -(value) : (value))

__attribute__((target_clones("default", "arch=haswell", "arch=skylake-avx512"))) void
advance_lanes(const ContactArrays &a, const ContactStep &step, LaneSums &sums)
{
  const Vec    zero = {};
  const Vec    one  = zero + 1.;
  const Vec    tiny = zero + smallest;
  const double dt   = step.dt;
  const double c    = (0.5 + step.beta2) * dt * dt; // du = dt w + c a
  const double d    = (step.beta2 - 0.5) * dt * dt;

  LaneSums s = {zero, zero, zero, zero, zero, zero};
  for (std::size_t i = 0; i < a.n; i += contact_lanes)
    {
      const Vec minv_x = MESOSLIP_LOAD(a.inverse_mass_x);
      const Vec minv_y = MESOSLIP_LOAD(a.inverse_mass_y);
      const Vec w_x    = MESOSLIP_LOAD(a.w_x);
      const Vec w_y    = MESOSLIP_LOAD(a.w_y);
      const Vec u_x    = MESOSLIP_LOAD(a.u_x);
      const Vec u_y    = MESOSLIP_LOAD(a.u_y);

      // Without contact.
      const Vec free_x = -MESOSLIP_LOAD(a.internal_x) * minv_x;
      const Vec free_y = -MESOSLIP_LOAD(a.internal_y) * minv_y;
      const Vec slide = dt * w_x + c * free_x;
      const Vec gap   = MESOSLIP_LOAD(a.gap) + u_y + dt * w_y + c * free_y;

      // Contact.
      const Vec  kappa_x = c * minv_x;
      const Vec  kappa_y = c * minv_y;
      const auto touches = gap < zero;
      const Vec  normal  = touches ? -gap / (kappa_y > tiny ? kappa_y : tiny) : zero;

      // Friction.
      const Vec to_stick =
        (step.flat_increment - slide) / (kappa_x > tiny ? kappa_x : tiny);
      const Vec  limit  = MESOSLIP_LOAD(a.friction_coefficient) * normal;
      const auto sticks = touches & (MESOSLIP_ABS(to_stick) <= limit);
      const Vec  target = to_stick < zero ? -limit : limit;
      const Vec  relaxed =
        target + (MESOSLIP_LOAD(a.tangential_force) - target) * MESOSLIP_LOAD(a.decay);

      // In its own direction friction never exceeds the force that makes the node stick.
      const auto same_direction = relaxed * to_stick > zero;
      const auto excess  = same_direction & (MESOSLIP_ABS(relaxed) > MESOSLIP_ABS(to_stick));
      const Vec  sliding = excess ? to_stick : relaxed;
      const Vec  tangential = touches ? (sticks ? to_stick : sliding) : zero;

      // Time step.
      const Vec a_x     = free_x + tangential * minv_x;
      const Vec a_y     = free_y + normal * minv_y;
      const Vec w_new_x = w_x + dt * a_x;
      const Vec w_new_y = w_y + dt * a_y;
      const Vec du_x    = dt * w_new_x + d * a_x;
      const Vec du_y    = dt * w_new_y + d * a_y;
      MESOSLIP_STORE(a.w_x, w_new_x);
      MESOSLIP_STORE(a.w_y, w_new_y);
      MESOSLIP_STORE(a.u_x, u_x + du_x);
      MESOSLIP_STORE(a.u_y, u_y + du_y);

      // Statistics.
      const Vec central_x = 0.5 * (du_x + MESOSLIP_LOAD(a.increment_x));
      const Vec central_y = 0.5 * (du_y + MESOSLIP_LOAD(a.increment_y));
      MESOSLIP_STORE(a.increment_x, du_x);
      MESOSLIP_STORE(a.increment_y, du_y);
      const Vec in_contact = touches ? one : zero;
      const Vec stick      = sticks ? one : zero;
      const Vec landing    = in_contact * (one - MESOSLIP_LOAD(a.touching));
      MESOSLIP_STORE(a.stick_count, MESOSLIP_LOAD(a.stick_count) + stick);
      MESOSLIP_STORE(a.slip_count, MESOSLIP_LOAD(a.slip_count) + (in_contact - stick));
      MESOSLIP_STORE(a.landing_count, MESOSLIP_LOAD(a.landing_count) + landing);
      MESOSLIP_STORE(a.touching, in_contact);
      MESOSLIP_STORE(a.sticking, stick);
      MESOSLIP_STORE(a.normal_force, normal);
      MESOSLIP_STORE(a.tangential_force, tangential);
      s.normal += normal;
      s.tangential += tangential;
      s.sticking += stick;
      s.touching += in_contact;
      s.friction_energy += tangential * (step.flat_increment - central_x);
      s.impact_energy -= normal * central_y;
    }
  sums = s;
}
} // namespace

ContactSums
advance_contact(const ContactArrays &arrays, const ContactStep &step)
{
  LaneSums lanes;
  advance_lanes(arrays, step, lanes);
  ContactSums sums;
  sums.normal_force     = sum(lanes.normal);
  sums.tangential_force = sum(lanes.tangential);
  sums.sticking         = sum(lanes.sticking);
  sums.slipping         = sum(lanes.touching) - sums.sticking;
  sums.friction_energy  = sum(lanes.friction_energy);
  sums.impact_energy    = sum(lanes.impact_energy);
  return sums;
}
} // namespace mesoslip
