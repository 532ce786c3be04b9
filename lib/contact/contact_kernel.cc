// The contact kernel of one instruction set. Compiled once for each set, see
// elasticity/kernel_variants.h. No branches: comparisons give masks, ?: selects lane by
// lane.
#include "contact/contact_kernel.h"

#include "elasticity/kernel_variants.h"

#include <cstdint>

#ifdef __x86_64__
#  include <immintrin.h>
#endif

namespace mesoslip::contact_kernels::MESOSLIP_VARIANT
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
  using Arrays        = ContactArrays;
  const auto at       = [&](const Arrays::Column c) { return a.column[c] + i; };
  const vdouble zero  = {};
  const vdouble one   = splat(1.);
  const double dt     = step.dt;
  const double c      = (0.5 + step.beta2) * dt * dt; // du = dt w + c a
  const double d      = (step.beta2 - 0.5) * dt * dt;
  const vdouble mxinv = load(a.inverse_mass[0] + i), myinv = load(a.inverse_mass[1] + i);
  const vdouble w_x = load(a.w[0] + i), w_y = load(a.w[1] + i);
  const vdouble u_x = load(a.u[0] + i), u_y = load(a.u[1] + i);

  // Without contact.
  const vdouble free_x = -load(a.force[0] + i) * mxinv;
  const vdouble free_y = -load(a.force[1] + i) * myinv;
  const vdouble slide  = dt * w_x + c * free_x;
  const vdouble gap    = load(at(Arrays::gap)) + u_y + dt * w_y + c * free_y;

  // Contact.
  const vint64 touches = gap < zero;
  const vdouble normal = touches ? -gap / at_least_smallest(c * myinv) : zero;

  // Friction.
  const vdouble to_stick = (step.flat_increment - slide) / at_least_smallest(c * mxinv);
  const vdouble limit    = load(at(Arrays::friction_coefficient)) * normal;
  const vint64 sticks    = touches & (absolute(to_stick) <= limit);
  const vdouble target   = to_stick < zero ? -limit : limit;
  const vdouble before   = load(at(Arrays::target));
  const vdouble relaxed =
    target + (load(at(Arrays::tangential_force)) - before) * load(at(Arrays::decay)) -
    (target - before) * load(at(Arrays::lag));

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
  store(a.w[0] + i, w_new_x);
  store(a.w[1] + i, w_new_y);
  store(a.u[0] + i, u_x + du_x);
  store(a.u[1] + i, u_y + du_y);

  // Statistics.
  const vdouble central_x  = 0.5 * (du_x + load(at(Arrays::increment_x)));
  const vdouble central_y  = 0.5 * (du_y + load(at(Arrays::increment_y)));
  const vdouble in_contact = touches ? one : zero;
  const vdouble stick      = sticks ? one : zero;
  const vdouble landing    = in_contact * (one - load(at(Arrays::touching)));
  store(at(Arrays::increment_x), du_x);
  store(at(Arrays::increment_y), du_y);
  store(at(Arrays::stick_count), load(at(Arrays::stick_count)) + stick);
  store(at(Arrays::slip_count), load(at(Arrays::slip_count)) + (in_contact - stick));
  store(at(Arrays::landing_count), load(at(Arrays::landing_count)) + landing);
  store(at(Arrays::touching), in_contact);
  store(at(Arrays::sticking), stick);
  store(at(Arrays::normal_force), normal);
  store(at(Arrays::tangential_force), tangential);
  store(at(Arrays::target), touches ? target : zero);
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
} // namespace mesoslip::contact_kernels::MESOSLIP_VARIANT
