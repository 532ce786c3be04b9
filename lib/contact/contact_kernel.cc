// The contact kernel of one instruction set. Compiled once for each set, see
// elasticity/kernel_variants.h. No branches per node: comparisons give masks, ?: selects
// lane by lane.
#include "contact/contact_kernel.h"

#include "contact/laws/flat_spring_impl.h"
#include "elasticity/kernel_variants.h"

#include <cstdint>

#ifdef __x86_64__
#  include <immintrin.h>
#endif

namespace mesoslip::contact_kernels::MESOSLIP_VARIANT
{
#include "elasticity/simd.h"

// Constrained nodes have no compliance; dividing by at least the smallest normal number
// avoids 0/0.
constexpr double smallest = 2.2250738585072014e-308;

/** Sums over the nodes in each lane of a vector. */
struct LaneSums
{
  vdouble normal, tangential, sticking, touching, friction_energy, impact_energy,
    stored_energy, lifting_work;
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

MESOSLIP_INLINE vdouble length_of(const vdouble x, const vdouble y)
{
  return square_root(x * x + y * y);
}

/** Compression of the spring of a node at @p height over the flat (m). */
MESOSLIP_INLINE vdouble compression(const vdouble height)
{
  return height < vdouble{} ? -height : vdouble{};
}

MESOSLIP_INLINE bool any(const vint64 mask)
{
  std::int64_t all = 0;
  for (unsigned int l = 0; l < Simd<double>::length; ++l)
    all |= mask[l];
  return all != 0;
}

#include "contact/laws/friction_impl.h"
#include "contact/laws/stretch_impl.h"

/**
 * Advances the nodes i, i + 1, ... of one vector; with @p full it supports profiles and
 * tangential springs. With @p trial it only computes the forces.
 */
template <int dim, bool full, bool trial>
MESOSLIP_INLINE void advance_vector(const ContactArrays &a,
                                    const ContactStep &step,
                                    const std::size_t i,
                                    LaneSums &s)
{
  using Arrays       = ContactArrays;
  const auto at      = [&](const Arrays::Column c) { return a.column[c] + i; };
  const vdouble zero = {};
  const vdouble one  = splat(1.);
  const double dt    = step.dt;
  const double c     = (0.5 + step.beta2) * dt * dt; // du = dt w + c a
  const double d     = (step.beta2 - 0.5) * dt * dt;

  // Motion without contact.
  vdouble minv[dim], w[dim], a_free[dim];
  for (int k = 0; k < dim; ++k)
    {
      minv[k]   = load(a.inverse_mass[k] + i);
      w[k]      = load(a.w[k] + i);
      a_free[k] = -load(a.force[k] + i) * minv[k];
    }
  // Heights over the flat after the step, now, and in the previous step.
  const vdouble ahead = load(at(Arrays::gap)) + load(a.u[1] + i),
                gap   = ahead + dt * w[1] + c * a_free[1];
  vdouble height = ahead, height_before = height, lifted = zero;
  if constexpr (full)
    {
      const vdouble rise        = load(at(Arrays::rise)),
                    rise_before = load(at(Arrays::rise_before));
      height                    = ahead + rise;
      height_before             = height + rise_before;
      lifted                    = 0.5 * (rise + rise_before);
    }

  // Contact.
  const vdouble soft = load(at(Arrays::softness)), yields = c * minv[1],
                earlier = compression(height_before - load(at(Arrays::increment_y)));
  const vint64 touches  = gap < zero;
  vdouble pressed       = force_of_flat(gap, earlier, soft, yields);
  if constexpr (full)
    {
      const vdouble given = load(at(Arrays::pressing));
      pressed             = given >= zero ? given : pressed;
    }
  const vdouble normal = touches ? pressed : zero;

  // Friction.
  constexpr Arrays::Column increments[] = {Arrays::increment_x, Arrays::increment_y,
                                           Arrays::lateral_increment};
  Sliding<dim> sliding;
  for (int k = 0; k < dim - 1; ++k)
    {
      const int component = 2 * k;
      const vdouble slide = dt * w[component] + c * a_free[component];
      sliding.slip[k]     = step.flat_increment[k] - slide;
      sliding.slip_before[k] =
        step.flat_increment_before[k] - load(at(increments[component]));
      sliding.compliance[k] = c * minv[component];
    }
  if constexpr (full)
    put_on_springs(a, i, sliding);
  const vdouble limit   = load(at(Arrays::friction_coefficient)) * normal;
  const Friction<dim> f = friction<full>(a, step, i, limit, sliding);
  const vint64 sticks   = touches & f.sticks;

  vdouble force[dim];
  for (int k = 0; k < dim; ++k)
    force[k] = k == 1 ? normal : touches ? f.force[k / 2] : zero;
  if constexpr (trial)
    {
      for (int k = 0; k < dim; ++k)
        store(a.trial[k] + i, force[k]);
      if constexpr (full)
        {
          const vdouble decided = load(at(Arrays::decided));
          store(at(Arrays::decided), decided < zero ? (f.sticks ? one : zero) : decided);
        }
      return;
    }

  // Time step.
  vdouble du[dim], central[dim];
  for (int k = 0; k < dim; ++k)
    {
      const vdouble acceleration = a_free[k] + force[k] * minv[k];
      const vdouble w_new        = w[k] + dt * acceleration;
      du[k]                      = dt * w_new + d * acceleration;
      central[k]                 = 0.5 * (du[k] + load(at(increments[k])));
      store(a.w[k] + i, w_new);
      store(a.u[k] + i, load(a.u[k] + i) + du[k]);
      store(at(increments[k]), du[k]);
    }

  if constexpr (full)
    {
      vdouble slipped[dim - 1], friction_force[dim - 1];
      for (int k = 0; k < dim - 1; ++k)
        {
          slipped[k]        = step.flat_increment[k] - du[2 * k];
          friction_force[k] = force[2 * k];
        }
      stretch_springs<dim>(a, i, slipped, friction_force, touches, sticks, s);
    }

  // Statistics.
  const vdouble in_contact = touches ? one : zero;
  const vdouble stick      = sticks ? one : zero;
  const vdouble landing    = in_contact * (one - load(at(Arrays::touching)));
  store(at(Arrays::stick_count), load(at(Arrays::stick_count)) + stick);
  store(at(Arrays::slip_count), load(at(Arrays::slip_count)) + (in_contact - stick));
  store(at(Arrays::landing_count), load(at(Arrays::landing_count)) + landing);
  store(at(Arrays::touching), in_contact);
  store(at(Arrays::sticking), stick);
  store(at(Arrays::normal_force), normal);
  store(at(Arrays::tangential_force), force[0]);
  store(at(Arrays::target), touches ? f.target[0] : zero);
  s.normal += normal;
  s.sticking += stick;
  s.touching += in_contact;
  s.friction_energy +=
    force[0] *
    (0.5 * (step.flat_increment[0] + step.flat_increment_before[0]) - central[0]);
  const vdouble stiffness = soft > zero ? 0.25 / at_least_smallest(soft) : zero,
                now       = compression(ahead + du[1]);
  s.stored_energy += stiffness * (now * now + compression(height) * compression(height));
  if constexpr (full)
    {
      s.lifting_work += normal * lifted;
      s.impact_energy += normal * lifted;
    }
  s.impact_energy -= normal * central[1];
  s.impact_energy -= stiffness * (now * now - earlier * earlier);
  if constexpr (dim == 3)
    {
      store(at(Arrays::lateral_force), force[2]);
      store(at(Arrays::lateral_target), touches ? f.target[1] : zero);
      s.tangential +=
        step.flat_direction[0] * force[0] + step.flat_direction[1] * force[2];
      s.friction_energy +=
        force[2] *
        (0.5 * (step.flat_increment[1] + step.flat_increment_before[1]) - central[2]);
    }
  else
    s.tangential += force[0];
}

template <int dim, bool full, bool trial>
static void
step_nodes(const ContactArrays &arrays, const ContactStep &step, ContactSums &sums)
{
  // Eight partial sums for any vector length: the same order on all processors.
  constexpr std::size_t length = Simd<double>::length;
  constexpr std::size_t n      = contact_lanes / length;
  LaneSums parts[n]            = {};
  for (std::size_t i = 0; i < arrays.n; i += contact_lanes)
#pragma GCC unroll 4
    for (std::size_t p = 0; p < n; ++p)
      advance_vector<dim, full, trial>(arrays, step, i + p * length, parts[p]);
  if constexpr (trial)
    return;

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
  sums.stored_energy    = sum(&LaneSums::stored_energy);
  sums.lifting_work     = sum(&LaneSums::lifting_work);
}

template <int dim, bool full = false>
static void
advance_nodes(const ContactArrays &arrays, const ContactStep &step, ContactSums &sums)
{
  if (arrays.trial[0] != nullptr)
    step_nodes<dim, full, true>(arrays, step, sums);
  else
    step_nodes<dim, full, false>(arrays, step, sums);
}

void advance(const ContactArrays &arrays, const ContactStep &step, ContactSums &sums)
{
  advance_nodes<2>(arrays, step, sums);
}

void advance_in_space(const ContactArrays &arrays,
                      const ContactStep &step,
                      ContactSums &sums)
{
  advance_nodes<3>(arrays, step, sums);
}

void advance_in_full(const ContactArrays &arrays,
                     const ContactStep &step,
                     ContactSums &sums)
{
  advance_nodes<2, true>(arrays, step, sums);
}

void advance_in_full_in_space(const ContactArrays &arrays,
                              const ContactStep &step,
                              ContactSums &sums)
{
  advance_nodes<3, true>(arrays, step, sums);
}
} // namespace mesoslip::contact_kernels::MESOSLIP_VARIANT
