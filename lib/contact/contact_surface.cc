#include "contact/contact_surface.h"

#include "contact/laws/flat_spring_impl.h"
#include "contact/laws/free_gap.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace mesoslip
{
template <int dim>
ContactFunction contact_function(const InstructionSet isa, const bool full)
{
  using namespace contact_kernels;
  const ContactFunction plane[]      = MESOSLIP_VARIANTS(advance);
  const ContactFunction space[]      = MESOSLIP_VARIANTS(advance_in_space);
  const ContactFunction full_plane[] = MESOSLIP_VARIANTS(advance_in_full);
  const ContactFunction full_space[] = MESOSLIP_VARIANTS(advance_in_full_in_space);
  if (full)
    return dim == 2 ? variant(full_plane, isa) : variant(full_space, isa);
  return dim == 2 ? variant(plane, isa) : variant(space, isa);
}

template <int dim>
ContactSurface<dim>::ContactSurface(const ContactSetup &setup, const StepParameters &step)
  : setup(setup)
  , advance_nodes(contact_function<dim>(InstructionSet::automatic, setup.is_full()))
  , step(step)
  , n_nodes(setup.friction_coefficient.size())
  , n_distinct(setup.n_owned.value_or(setup.periodic ? n_nodes - 1 : n_nodes))
  , values(n_nodes, 1, ContactArrays::n_columns_in(dim))
{
  const unsigned int n_padded = whole_vectors<double>(n_nodes);
  std::fill_n(column(Column::gap), n_padded, std::numeric_limits<double>::infinity());
  std::fill_n(column(Column::gap), setup.periodic ? n_distinct : n_nodes, setup.gap);
  for (std::size_t i = 0; i < setup.height.size(); ++i)
    column(Column::gap)[i] += setup.height[i];
  if (setup.profile)
    {
      profile = std::make_unique<MovingProfile<dim>>(
        setup.profile, setup.position,
        std::vector<double>(column(Column::gap), column(Column::gap) + n_nodes));
      profile->start(column(Column::gap));
    }
  std::fill_n(column(Column::pressing), n_padded, -1.);
  std::fill_n(column(Column::decided), n_padded, -1.);
  constexpr double softest = 1e100; // nodes without area
  if (setup.is_compliant() && !setup.normal_spring.is_linear())
    springs = std::make_unique<PowerSprings<dim>>(setup.normal_spring, setup.area,
                                                  setup.n_owned.value_or(n_nodes), step);
  for (unsigned int i = 0; setup.is_compliant() && !springs && i < setup.area.size(); ++i)
    column(Column::softness)[i] =
      std::min(softest, 1. / (setup.normal_spring.stiffness * std::fabs(setup.area[i])));
  for (unsigned int i = 0; setup.slips_on_springs() && i < setup.area.size(); ++i)
    column(Column::slackness)[i] =
      std::min(softest, 1. / (setup.tangential_stiffness * std::fabs(setup.area[i])));
  std::copy(setup.friction_coefficient.begin(), setup.friction_coefficient.end(),
            column(Column::friction_coefficient));
  const Relaxation relaxation(step.dt, setup.law.time);
  std::fill_n(column(Column::decay), n_padded, relaxation.decay);
  std::fill_n(column(Column::lag), n_padded, relaxation.lag);
  if (setup.law.is_variable())
    variable = std::make_unique<VariableFriction<dim>>(
      setup.law, setup.friction_coefficient, setup.area, setup.position, step);
}

template <int dim>
ContactArrays ContactSurface<dim>::arrays(const SurfaceView<dim> &surface,
                                          const unsigned int first,
                                          const unsigned int end)
{
  static_assert(contact_lanes == lanes<double>, "fields are padded to whole vectors");
  ContactArrays a = {};
  a.n             = whole_vectors<double>(end - first);
  for (unsigned int c = 0; c < dim; ++c)
    {
      const unsigned int component = c == 0 ? 0 : c == 1 ? dim - 1 : 1;
      a.force[c]                   = surface.force[component] + first;
      a.inverse_mass[c]            = surface.inverse_mass[component] + first;
      a.u[c]                       = surface.u[component] + first;
      a.w[c]                       = surface.w[component] + first;
    }
  for (unsigned int k = 0; k < values.n_components(); ++k)
    a.column[k] = values.row(k, 0) + first;
  return a;
}

template <int dim>
ContactStep ContactSurface<dim>::constants(const FlatVelocity &flat) const
{
  const std::array<double, 2> &along = setup.flat_direction,
                              moved  = flat_increment_at(flat.now),
                              before = flat_increment_at(flat.before);
  return {step.dt,
          step.beta2,
          {moved[0], moved[1]},
          {before[0], before[1]},
          {along[0], along[1]}};
}

// Contributions of ghost nodes are counted by their owners.
template <int dim>
void ContactSurface<dim>::advance_all(const SurfaceView<dim> &surface,
                                      const FlatVelocity &flat)
{
  const ContactStep given   = constants(flat);
  const unsigned int n_own  = setup.n_owned.value_or(n_nodes),
                     copies = whole_vectors<double>(n_own);
  advance_nodes(arrays(surface, 0, n_own), given, last);
  ContactSums elsewhere;
  if (copies < n_nodes)
    advance_nodes(arrays(surface, copies, n_nodes), given, elsewhere);
}

template <int dim>
void ContactSurface<dim>::begin(const SurfaceView<dim> &surface)
{
  const bool first = !started;
  if (first)
    initialize_increments(surface);
  if (profile)
    profile->advance(surface, flat_increment(surface.time), arrays(surface, 0, n_nodes));
  if (first && setup.slips_on_springs() && !continues)
    relax_along_flat(surface);
  if (first && setup.slips_on_springs() && continues)
    count_stretched_springs();
}

// Updates springs and laws for the step. A repeated call gives the same result, except
// for the memory of laws.
template <int dim>
void ContactSurface<dim>::prepare(const SurfaceView<dim> &surface,
                                  const FlatVelocity &flat)
{
  const auto along = [&](const double velocity) {
    return std::array<double, 2>{
      {velocity * setup.flat_direction[0], velocity * setup.flat_direction[1]}};
  };
  if (springs)
    springs->press(surface, arrays(surface, 0, n_nodes));
  if (setup.law.node_law)
    setup.law.node_law->update(
      {n_nodes, surface.w[0], along(flat.now)[0], dim == 3 ? surface.w[1] : nullptr,
       along(flat.now)[1]},
      step.dt,
      {column(Column::friction_coefficient), column(Column::decay), column(Column::lag)});
  if (variable)
    variable->update(surface, {along(flat.before), along(flat.now)},
                     arrays(surface, 0, n_nodes));
}

template <int dim>
void ContactSurface<dim>::try_forces(const SurfaceView<dim> &surface,
                                     const std::array<double *, dim> &trial,
                                     const bool first)
{
  Assert(setup.is_coupled && !profile, dealii::ExcInternalError());
  if (first)
    std::fill_n(column(Column::decided), n_nodes, -1.);
  const FlatVelocity flat = flat_at(surface.time);
  if (!started)
    begin(surface);
  using Memory        = typename VariableFriction<dim>::Memory;
  const Memory before = variable ? variable->memory() : Memory();
  prepare(surface, flat);
  ContactArrays all = arrays(surface, 0, setup.n_owned.value_or(n_nodes));
  all.trial[0]      = trial[0];
  all.trial[1]      = trial[dim - 1];
  all.trial[2]      = dim == 3 ? trial[1] : nullptr;
  ContactSums none;
  advance_nodes(all, constants(flat), none);
  if (variable)
    variable->recall(before);
}

template <int dim>
void ContactSurface<dim>::ride(const double *rise,
                               const std::array<const double *, dim> &moved)
{
  const std::array<Column, 3> increments = {
    {Column::increment_x, dim == 3 ? Column::lateral_increment : Column::increment_y,
     Column::increment_y}};
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      // Heights of the previous step stay unchanged, whatever @p moved says.
      column(Column::rise_before)[i] = column(Column::rise)[i] + moved[dim - 1][i];
      column(Column::rise)[i]        = rise[i];
      for (unsigned int c = 0; c < dim; ++c)
        column(increments[c])[i] += moved[c][i];
    }
}

template <int dim>
void ContactSurface<dim>::advance(const SurfaceView<dim> &surface)
{
  AssertDimension(surface.n, n_nodes);
  const FlatVelocity flat = flat_at(surface.time);
  begin(surface);
  prepare(surface, flat);
  for (ContactObserver<dim> *observer : observers)
    if (observer->wants(surface.step))
      observer->before(surface);

  advance_all(surface, flat);
  if (springs)
    springs->add_energies(surface, arrays(surface, 0, n_nodes), last);

  if (setup.periodic)
    for (unsigned int c = 0; c < dim; ++c)
      {
        surface.u[c][n_nodes - 1] = surface.u[c][0];
        surface.w[c][n_nodes - 1] = surface.w[c][0];
      }

  total.friction += last.friction_energy;
  total.impact += last.impact_energy;
  total.stored = last.stored_energy;
  total.load += last.normal_force * std::fabs(flat.now) * step.dt;
  total.external +=
    last.tangential_force * 0.5 * (flat.before + flat.now) * step.dt + last.lifting_work;
  for (ContactObserver<dim> *observer : observers)
    if (observer->wants(surface.step))
      observer->after(surface, *this);
}

// The work of the first step needs the previous increment.
template <int dim>
void ContactSurface<dim>::initialize_increments(const SurfaceView<dim> &surface)
{
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      column(Column::increment_x)[i] = step.dt * surface.w[0][i];
      column(Column::increment_y)[i] = step.dt * surface.w[dim - 1][i];
      if (dim == 3)
        column(Column::lateral_increment)[i] = step.dt * surface.w[1][i];
    }
  if (profile)
    profile->start_rise(flat_increment(0.), arrays(surface, 0, n_nodes));
  for (unsigned int i = 0; i < setup.n_owned.value_or(n_nodes); ++i)
    if (const double soft = column(Column::softness)[i]; soft > 0.)
      {
        const double height = column(Column::gap)[i] + surface.u[dim - 1][i],
                     now    = std::min(0., height),
                     before = std::min(0., height + column(Column::rise)[i] -
                                             column(Column::increment_y)[i]);
        total.pressed += 0.25 / soft * (now * now + before * before);
      }
  if (springs)
    total.pressed += springs->stored_at_start(surface, arrays(surface, 0, n_nodes));
  started = true;
}

// Nodes that touch from the start: their tangential springs were stretched one step
// before. Stiff springs, which the node could not have followed, and springs of
// constrained nodes were not.
template <int dim>
void ContactSurface<dim>::relax_along_flat(const SurfaceView<dim> &surface)
{
  constexpr Column before[] = {Column::stretch_before, Column::lateral_stretch_before},
                   increments[]     = {Column::increment_x, Column::lateral_increment};
  const std::array<double, 2> moved = flat_increment(0.);
  const double c                    = (0.5 + step.beta2) * step.dt * step.dt;
  for (unsigned int i = 0; i < n_nodes; ++i)
    {
      const double slack = column(Column::slackness)[i],
                   gap   = free_gap(surface, column(Column::gap)[i], i, step);
      for (unsigned int k = 0; k + 1 < dim && gap < 0.; ++k)
        {
          const double yields  = c * surface.inverse_mass[k][i],
                       phi     = yields > 0. ? 2. * share_of_earlier(slack, yields) : 0.,
                       stretch = phi * (column(increments[k])[i] - moved[k]);
          column(before[k])[i] = stretch;
          if (i < setup.n_owned.value_or(n_nodes))
            total.pressed += 0.25 / slack * stretch * stretch;
        }
    }
}

/** Counts the energy in tangential springs taken over from a previous run. */
template <int dim>
void ContactSurface<dim>::count_stretched_springs()
{
  for (unsigned int i = 0; i < setup.n_owned.value_or(n_nodes); ++i)
    for (unsigned int k = 0; k + 1 < dim; ++k)
      {
        const double now = column(k == 0 ? Column::stretch : Column::lateral_stretch)[i],
                     before = column(k == 0 ? Column::stretch_before
                                            : Column::lateral_stretch_before)[i];
        total.pressed +=
          0.25 / column(Column::slackness)[i] * (now * now + before * before);
      }
}

template <int dim>
NodeCounts ContactSurface<dim>::take_counts()
{
  const auto take = [&](const Column c) {
    const std::vector<float> counts(column(c), column(c) + n_nodes);
    std::fill_n(column(c), n_nodes, 0.);
    return counts;
  };
  NodeCounts counts;
  counts.stick    = take(Column::stick_count);
  counts.slip     = take(Column::slip_count);
  counts.landings = take(Column::landing_count);
  return counts;
}

template ContactFunction contact_function<2>(const InstructionSet, const bool);
template ContactFunction contact_function<3>(const InstructionSet, const bool);
template class ContactSurface<2>;
template class ContactSurface<3>;
} // namespace mesoslip
