// The contact kernel of one instruction set. Compiled once for each set, see
// elasticity/kernel_variants.h. No branches: comparisons give masks, ?: selects lane by
// lane.
#include "contact/contact_kernel.h"

#include "elasticity/kernel_variants.h"

#include <cstdint>

#ifdef __x86_64__
#  include <immintrin.h>
#endif

namespace mesoslip
{
namespace contact_kernels
{
namespace MESOSLIP_VARIANT
{
#include "elasticity/simd.h"

// Held nodes have no compliance; dividing by the smallest normal number keeps the
// arithmetic free of 0/0.
constexpr double smallest = 2.2250738585072014e-308;

/** Sums over the nodes of one vector's lanes. */
struct LaneSums
{
  vdouble normal, tangential, sticking, touching, friction_energy, impact_energy;
};

MESOSLIP_INLINE vdouble absolute(const vdouble x)
{
  return x < vdouble{} ? -x : x;
}

MESOSLIP_INLINE vdouble at_least_smallest(const vdouble x)
{
  const vdouble tiny = splat(smallest);
  return x > tiny ? x : tiny;
}

/** The nodes i, i + 1, ... of one vector. */
MESOSLIP_INLINE void advance_vector(const ContactArrays &a,
                                    const ContactStep &step,
                                    const std::size_t i,
                                    LaneSums &s)
{
  const vdouble zero  = {};
  const vdouble one   = splat(1.);
  const double dt     = step.dt;
  const double c      = (0.5 + step.beta2) * dt * dt; // du = dt w + c a
  const double d      = (step.beta2 - 0.5) * dt * dt;
  const vdouble mxinv = load(a.inverse_mass_x + i), myinv = load(a.inverse_mass_y + i);
  const vdouble w_x = load(a.w_x + i), w_y = load(a.w_y + i);
  const vdouble u_x = load(a.u_x + i), u_y = load(a.u_y + i);

  // Without contact.
  const vdouble free_x = -load(a.internal_x + i) * mxinv;
  const vdouble free_y = -load(a.internal_y + i) * myinv;
  const vdouble slide  = dt * w_x + c * free_x;
  const vdouble gap    = load(a.gap + i) + u_y + dt * w_y + c * free_y;

  // Contact.
  const vint64 touches = gap < zero;
  const vdouble normal = touches ? -gap / at_least_smallest(c * myinv) : zero;

  // Friction.
  const vdouble to_stick = (step.flat_increment - slide) / at_least_smallest(c * mxinv);
  const vdouble limit    = load(a.friction_coefficient + i) * normal;
  const vint64 sticks    = touches & (absolute(to_stick) <= limit);
  const vdouble target   = to_stick < zero ? -limit : limit;
  const vdouble before   = load(a.target + i);
  const vdouble relaxed  = target +
                          (load(a.tangential_force + i) - before) * load(a.decay + i) -
                          (target - before) * load(a.lag + i);

  // In its own direction friction never exceeds the force that makes the node stick.
  const vint64 same_direction = relaxed * to_stick > zero;
  const vint64 excess         = same_direction & (absolute(relaxed) > absolute(to_stick));
  const vdouble sliding       = excess ? to_stick : relaxed;
  const vdouble stopped       = sticks ? to_stick : sliding;
  const vdouble tangential    = touches ? stopped : zero;

  // Time step.
  const vdouble a_x     = free_x + tangential * mxinv;
  const vdouble a_y     = free_y + normal * myinv;
  const vdouble w_new_x = w_x + dt * a_x;
  const vdouble w_new_y = w_y + dt * a_y;
  const vdouble du_x    = dt * w_new_x + d * a_x;
  const vdouble du_y    = dt * w_new_y + d * a_y;
  store(a.w_x + i, w_new_x);
  store(a.w_y + i, w_new_y);
  store(a.u_x + i, u_x + du_x);
  store(a.u_y + i, u_y + du_y);

  // Statistics.
  const vdouble central_x  = 0.5 * (du_x + load(a.increment_x + i));
  const vdouble central_y  = 0.5 * (du_y + load(a.increment_y + i));
  const vdouble in_contact = touches ? one : zero;
  const vdouble stick      = sticks ? one : zero;
  const vdouble landing    = in_contact * (one - load(a.touching + i));
  store(a.increment_x + i, du_x);
  store(a.increment_y + i, du_y);
  store(a.stick_count + i, load(a.stick_count + i) + stick);
  store(a.slip_count + i, load(a.slip_count + i) + (in_contact - stick));
  store(a.landing_count + i, load(a.landing_count + i) + landing);
  store(a.touching + i, in_contact);
  store(a.sticking + i, stick);
  store(a.normal_force + i, normal);
  store(a.tangential_force + i, tangential);
  store(a.target + i, touches ? target : zero);
  s.normal += normal;
  s.tangential += tangential;
  s.sticking += stick;
  s.touching += in_contact;
  s.friction_energy += tangential * (step.flat_increment - central_x);
  s.impact_energy -= normal * central_y;
}

void advance(const ContactArrays &arrays, const ContactStep &step, ContactSums &sums)
{
  // Eight partial sums whatever the vectors: the same order everywhere.
  constexpr std::size_t length = Simd<double>::length;
  constexpr std::size_t n      = contact_lanes / length;
  LaneSums parts[n]            = {};
  for (std::size_t i = 0; i < arrays.n; i += contact_lanes)
#pragma GCC unroll 4
    for (std::size_t p = 0; p < n; ++p)
      advance_vector(arrays, step, i + p * length, parts[p]);

  const auto sum = [&](vdouble LaneSums::*quantity) {
    double total = 0.;
    for (std::size_t l = 0; l < contact_lanes; ++l)
      total += (parts[l / length].*quantity)[l % length];
    return total;
  };
  sums.normal_force     = sum(&LaneSums::normal);
  sums.tangential_force = sum(&LaneSums::tangential);
  sums.sticking         = sum(&LaneSums::sticking);
  sums.slipping         = sum(&LaneSums::touching) - sums.sticking;
  sums.friction_energy  = sum(&LaneSums::friction_energy);
  sums.impact_energy    = sum(&LaneSums::impact_energy);
}
} // namespace MESOSLIP_VARIANT
} // namespace contact_kernels
} // namespace mesoslip
