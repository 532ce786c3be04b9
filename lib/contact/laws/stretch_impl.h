// Tangential springs of the nodes of one vector; part of contact/contact_kernel.cc, in
// its namespace.

/** Columns of the stretch along x and, in 3D, y: now and in the previous step. */
constexpr ContactArrays::Column stretch_column[] = {ContactArrays::stretch,
                                                    ContactArrays::lateral_stretch},
                                earlier_column[] = {
                                  ContactArrays::stretch_before,
                                  ContactArrays::lateral_stretch_before};

/**
 * Puts the spring of a node in series with its compliance. With r = phi / (2 - phi) the
 * force that holds the node is (s + e_n + r e_(n-1)) / (k + slack + r slack), as for a
 * node with the slip in the numerator and the compliance in the denominator.
 */
template <int dim>
MESOSLIP_INLINE void
put_on_springs(const ContactArrays &a, const std::size_t i, Sliding<dim> &sliding)
{
  const vdouble slack = load(a.column[ContactArrays::slackness] + i);
  for (int k = 0; k < dim - 1; ++k)
    {
      const vdouble stretch = load(a.column[stretch_column[k]] + i),
                    earlier = load(a.column[earlier_column[k]] + i),
                    share   = share_of_earlier(slack, sliding.compliance[k]),
                    ratio   = share / (1. - share);
      sliding.slip[k] += stretch + ratio * earlier;
      sliding.slip_before[k] -= stretch - earlier;
      sliding.compliance[k] += slack / (1. - share);
    }
}

/**
 * Updates the stretches in the step in which the nodes slip by @p slip under @p force,
 * with the Coulomb @p limit. Sticking nodes: by the whole slip. Sliding nodes: to the
 * extrapolated force of the next step, but by no more than the slip, unless lagging
 * friction has the opposite sign. Adds energies to @p s.
 */
template <int dim>
MESOSLIP_INLINE void stretch_springs(const ContactArrays &a,
                                     const std::size_t i,
                                     const vdouble (&slip)[dim - 1],
                                     const vdouble (&force)[dim - 1],
                                     const vint64 touches,
                                     const vint64 sticks,
                                     LaneSums &s)
{
  using Arrays                      = ContactArrays;
  constexpr Arrays::Column forces[] = {Arrays::tangential_force, Arrays::lateral_force};
  const vdouble zero                = {};
  const vdouble slack               = load(a.column[Arrays::slackness] + i),
                touched             = load(a.column[Arrays::touching] + i);
  vdouble held[dim - 1], slid[dim - 1], along = zero, back = zero, squares = zero;
  for (int k = 0; k < dim - 1; ++k)
    squares += force[k] * force[k];
  const vdouble most = 0.5 * square_root(squares);
  for (int k = 0; k < dim - 1; ++k)
    {
      const vdouble before  = load(a.column[forces[k]] + i),
                    change  = touched > zero ? force[k] - before : zero,
                    bounded = change > most    ? most
                              : change < -most ? -most
                                               : change;
      held[k]               = load(a.column[stretch_column[k]] + i) + slip[k];
      slid[k]               = slack * (force[k] + bounded);
      along += held[k] * force[k];
      back += (held[k] - slid[k]) * force[k];
    }
  const vint64 holds    = sticks | ((back < zero) & (along > zero));
  const vdouble quarter = slack > zero ? 0.25 / at_least_smallest(slack) : zero;
  for (int k = 0; k < dim - 1; ++k)
    {
      const vdouble before    = load(a.column[stretch_column[k]] + i),
                    earlier   = load(a.column[earlier_column[k]] + i),
                    of_spring = holds ? held[k] : slid[k],
                    stretch   = ((slack > zero) & touches) ? of_spring : zero;
      store(a.column[earlier_column[k]] + i, before);
      store(a.column[stretch_column[k]] + i, stretch);
      s.stored_energy += quarter * (stretch * stretch + before * before);
      s.friction_energy -= quarter * (stretch * stretch - earlier * earlier);
    }
}
