// Friction of the nodes of one vector; part of contact/contact_kernel.cc, in its
// namespace.

/** Slip without friction in this step, and its compliance with respect to friction. */
template <int dim>
struct Sliding
{
  vdouble slip[dim - 1];        ///< slip of the node, see put_on_springs() (m)
  vdouble slip_before[dim - 1]; ///< slip in the previous step (m)
  vdouble compliance[dim - 1];  ///< c / m, see put_on_springs() (m/N, in 2D m^2/N)
};

/**
 * Sticking nodes; tangential force and Coulomb force on the body as if all nodes touched.
 */
template <int dim>
struct Friction
{
  vint64 sticks;
  vdouble force[dim - 1], target[dim - 1];
};

/** Friction force that relaxes towards its target. */
MESOSLIP_INLINE vdouble relax(const vdouble target,
                              const vdouble target_before,
                              const vdouble force_before,
                              const vdouble decay,
                              const vdouble lag)
{
  return target + (force_before - target_before) * decay - (target - target_before) * lag;
}

/**
 * Sticking nodes: @p within the limit or, if there was a first trial, by its decision.
 */
template <bool full>
MESOSLIP_INLINE vint64 hold(const ContactArrays &a,
                            const std::size_t i,
                            const vint64 within)
{
  if constexpr (!full)
    return within;
  const vdouble decided = load(a.column[ContactArrays::decided] + i), zero = {};
  return (decided > zero) | ((decided < zero) & within);
}

/** 2D friction, in the direction of the force that makes the node stick. */
template <bool full>
MESOSLIP_INLINE Friction<2> friction(const ContactArrays &a,
                                     const ContactStep &,
                                     const std::size_t i,
                                     const vdouble limit,
                                     const Sliding<2> &sliding_of)
{
  using Arrays       = ContactArrays;
  const auto at      = [&](const Arrays::Column c) { return load(a.column[c] + i); };
  const vdouble zero = {};
  const vdouble to_stick =
    sliding_of.slip[0] / at_least_smallest(sliding_of.compliance[0]);
  const vint64 within = absolute(to_stick) <= limit, holds = hold<full>(a, i, within);
  const vdouble target  = to_stick < zero ? -limit : limit;
  const vdouble relaxed = relax(target, at(Arrays::target), at(Arrays::tangential_force),
                                at(Arrays::decay), at(Arrays::lag));

  // In its direction, friction never exceeds the force that makes the node stick.
  const vint64 same_direction = relaxed * to_stick > zero;
  const vint64 excess         = same_direction & (absolute(relaxed) > absolute(to_stick));
  const vdouble sliding       = excess ? to_stick : relaxed;
  const vdouble held          = within ? to_stick : target;
  return {holds & within, {holds ? held : sliding}, {target}};
}

/**
 * Slip that remains of @p slip if the Coulomb force moves the node by @p push along each
 * axis: y with y_k + push_k y_k / |y| = slip_k, so that y_k = slip_k r / (r + push_k)
 * with r = |y|. Newton's method for 1 / |slip / (r + push)| = 1, which is linear in r for
 * equal pushes, and approaches r from below. Six steps reach round-off for all but one in
 * ten thousand random slips; ten steps reach 3e-4 if one component is about to stick and
 * the other one is constrained. Returns y / r.
 */
MESOSLIP_INLINE void
slip_left(const vdouble (&slip)[2], const vdouble (&push)[2], vdouble (&left)[2])
{
  // Lower bound of r: length of the slip minus the longer push, and each component minus
  // its own push, which may be zero.
  const vdouble most = push[0] > push[1] ? push[0] : push[1];
  vdouble least      = at_least_smallest(length_of(slip[0], slip[1]) - most);
  for (int k = 0; k < 2; ++k)
    {
      const vdouble alone = absolute(slip[k]) - push[k];
      least               = alone > least ? alone : least;
    }
  vdouble r = least;
  for (int n = 0; n < 10; ++n)
    {
      vdouble squares = {}, cubes = {};
      for (int k = 0; k < 2; ++k)
        {
          const vdouble reach = at_least_smallest(r + push[k]), share = slip[k] / reach;
          squares += share * share;
          cubes += share * share / reach;
        }
      const vdouble next =
        r + (square_root(squares) - 1.) * squares / at_least_smallest(cubes);
      r = next > least ? next : least;
    }
  for (int k = 0; k < 2; ++k)
    left[k] = slip[k] / at_least_smallest(r + push[k]);
}

/**
 * 3D friction, with two tangential components. The Coulomb force has the direction of the
 * slip at the same instant: a mean of the slip of the previous step and of the current
 * slip with friction. The weight of the latter is beta2, or more if the slip across the
 * force would reverse by more than it was (doc/theory.md).
 */
template <bool full>
MESOSLIP_INLINE Friction<3> friction(const ContactArrays &a,
                                     const ContactStep &step,
                                     const std::size_t i,
                                     const vdouble limit,
                                     const Sliding<3> &sliding_of)
{
  using Arrays            = ContactArrays;
  const auto at           = [&](const Arrays::Column c) { return load(a.column[c] + i); };
  const vdouble(&slip)[2] = sliding_of.slip;
  const vdouble(&slip_before)[2] = sliding_of.slip_before;
  const vdouble(&compliance)[2]  = sliding_of.compliance;
  const vdouble before[2]        = {at(Arrays::target), at(Arrays::lateral_target)};
  const vdouble force_before[2]  = {at(Arrays::tangential_force),
                                    at(Arrays::lateral_force)};
  const vdouble decay = at(Arrays::decay), lag = at(Arrays::lag);
  Friction<3> result;
  const vdouble zero = {};
  // Different masses along the axes, as at corners with dashpots or with a constrained
  // component.
  const vint64 differ = (compliance[0] != compliance[1]) & (absolute(slip[0]) > zero) &
                        (absolute(slip[1]) > zero);

  // Includes remembered friction, without the contribution of the new target: K (1 - lag)
  // limit along e.
  vdouble free[2], added[2], both[2], left[2];
  for (int k = 0; k < 2; ++k)
    {
      free[k] =
        slip[k] - compliance[k] * (decay * force_before[k] + (lag - decay) * before[k]);
      added[k] = compliance[k] * (1. - lag) * limit;
    }
  const vdouble distance_free = at_least_smallest(length_of(free[0], free[1])),
                most = at_least_smallest(added[0] > added[1] ? added[0] : added[1]),
                slow = 1. - length_of(free[0] * (1. - added[0] / distance_free),
                                      free[1] * (1. - added[1] / distance_free)) /
                              most,
                least = splat(step.beta2), after = slow > least ? slow : least;
  for (int k = 0; k < 2; ++k)
    both[k] = after * free[k] + (1. - after) * slip_before[k];
  const vint64 goes_on = both[0] * slip[0] + both[1] * slip[1] > zero;
  for (int k = 0; k < 2; ++k)
    left[k] = both[k] = goes_on ? both[k] : after * slip[k];
  if (any(differ)) // in few bodies; takes ten times as long as everything else
    {
      const vdouble push[2] = {after * added[0], after * added[1]};
      vdouble found[2];
      slip_left(both, push, found);
      for (int k = 0; k < 2; ++k)
        left[k] = differ ? found[k] : both[k];
    }
  const vdouble distance_left = length_of(left[0], left[1]);
  vdouble to_stick[2], direction[2], pull[2];
  // Along the force: displacement by friction, compliance, and slip.
  vdouble moved = {}, softness = {}, distance = {};
  for (int k = 0; k < 2; ++k)
    {
      to_stick[k]      = slip[k] / at_least_smallest(compliance[k]);
      direction[k]     = left[k] / at_least_smallest(distance_left);
      pull[k]          = direction[k] * compliance[k];
      result.target[k] = limit * direction[k];
      result.force[k]  = relax(result.target[k], before[k], force_before[k], decay, lag);
      moved += pull[k] * result.force[k];
      softness += pull[k] * direction[k];
      distance += slip[k] * direction[k];
    }
  const vdouble length = length_of(to_stick[0], to_stick[1]);
  const vint64 within = length <= limit, holds = hold<full>(a, i, within);
  const vdouble share  = within ? splat(1.) : limit / at_least_smallest(length);
  result.sticks        = holds & within;
  const vdouble excess = (moved - distance) / at_least_smallest(softness);
  for (int k = 0; k < 2; ++k)
    {
      const vdouble force = result.force[k], along = force - excess * direction[k],
                    sliding = moved > distance ? along : force;
      result.force[k]       = holds ? share * to_stick[k] : sliding;
    }
  return result;
}
