#include "dynamics/grid/temporal_blocking.h"

#include <algorithm>
#include <type_traits>

namespace mesoslip
{
namespace
{
template <typename Number>
RowKernels<Number> make_kernels(const UniformMaterial &material,
                                const StepParameters &parameters,
                                const InstructionSet isa)
{
  constexpr bool is_single = std::is_same_v<Number, float>;
  RowKernels<Number> kernels(material, isa, is_single || parameters.common_beta() != 0.,
                             parameters.acts_on_mass());
  const auto set = [](Number &constant, const double value) {
    constant = static_cast<Number>(value);
  };
  auto &c         = *kernels.constants;
  const double hx = material.grid().spacing[0], hy = material.grid().spacing[1];
  set(c.beta, parameters.common_beta());
  set(c.c_new, parameters.dt * (parameters.beta2 + 0.5));
  set(c.c_old, -parameters.dt * (parameters.beta2 - 0.5));
  set(c.gravity_x, parameters.acceleration[0]);
  set(c.gravity_y, parameters.acceleration[1]);
  // Stepping kernels have forces times 2/h.
  set(c.scaled_gravity_x, parameters.acceleration[0] * 2. / hx);
  set(c.scaled_gravity_y, parameters.acceleration[1] * 2. / hy);
  set(c.alpha, parameters.common_alpha());
  set(c.scaled_alpha_x, parameters.common_alpha() * 2. / hx);
  set(c.scaled_alpha_y, parameters.common_alpha() * 2. / hy);
  return kernels;
}
} // namespace

template <typename Number>
TemporalBlocking<Number>::Stage::Stage(const UniformMaterial &material,
                                       const RowKernels<Number> &kernels)
  : sweep(material, kernels)
  , forces(material.n_columns(), 1)
{
}

template <typename Number>
TemporalBlocking<Number>::TemporalBlocking(const SteppedBody &body,
                                           const SideConstraints &sides,
                                           const InstructionSet isa,
                                           const unsigned int max_steps,
                                           const PhaseDamping *damping)
  : body(body)
  , kernels(make_kernels<Number>(body.material, body.parameters, isa))
  , masses(body.material, body.rows, body.parameters, sides, body.damping)
  , damping(damping)
  , at_once(kernels.functions.rows_at_once)
  , state(body.u, body.w)
  , boundary_force(body.material.n_columns(), 1)
{
  if (body.rows.begin == 0)
    masses.add_guests(false, body.columns);
  if (body.rows.end == body.rows.n_global)
    masses.add_guests(true, body.columns);
  for (unsigned int i = 0; i < max_steps; ++i)
    stages.emplace_back(body.material, kernels);
}

template <typename Number>
std::string TemporalBlocking<Number>::kernel_name() const
{
  return kernels::name(kernels.choice) +
         (std::is_same_v<Number, float> ? ", single precision" : "");
}

template <typename Number>
void TemporalBlocking<Number>::load()
{
  state.load(0, body.rows.n_local(), 0, body.material.n_columns());
}

template <typename Number>
void TemporalBlocking<Number>::save()
{
  save(body.rows.begin, body.rows.end);
}

template <typename Number>
bool TemporalBlocking<Number>::is_current() const
{
  return state.is_current(body.rows.local(body.rows.begin),
                          body.rows.end - body.rows.begin, body.material.n_columns());
}

/** Writes the inner rows from @p begin to before @p end (global indices) to the fields. */
template <typename Number>
void TemporalBlocking<Number>::save(const unsigned int begin, const unsigned int end)
{
  const unsigned int first = std::max(begin, 1u),
                     last  = std::min(end, body.rows.n_global - 1);
  if (first < last)
    state.save(body.rows.local(first), last - first, 0, body.material.n_columns());
}

template <typename Number>
RowBlock TemporalBlocking<Number>::block(const unsigned int j, const unsigned int n) const
{
  const unsigned int l = body.rows.local(j);
  return {body.u.row(0, l), body.u.row(1, l), body.w.row(0, l),
          body.w.row(1, l), body.u.stride(),  n};
}

/** Kernel pointers for node row @p j and the rows above. */
template <typename Number>
kernels::Rows<Number> TemporalBlocking<Number>::kernel_rows(Stage &stage,
                                                            const unsigned int j)
{
  const unsigned int l = body.rows.local(j);
  kernels::Rows<Number> r;
  r.ux     = state.u(0, l);
  r.uy     = state.u(1, l);
  r.wx     = state.w(0, l);
  r.wy     = state.w(1, l);
  r.stride = state.stride();
  r.fx     = stage.forces.row(0, 0);
  r.fy     = stage.forces.row(1, 0);
  masses.set_inner(r, l);
  return r;
}

/** Sends @p n rows from @p j on (global number). */
template <typename Number>
void TemporalBlocking<Number>::send(const Halo::Side side,
                                    const unsigned int j,
                                    const unsigned int n)
{
  save(j, j + n);
  body.halo->send(side, block(j, n));
}

template <typename Number>
void TemporalBlocking<Number>::receive(const Halo::Side side,
                                       const unsigned int j,
                                       const unsigned int n)
{
  body.halo->receive(side, block(j, n));
  state.load(body.rows.local(j), n, 0, body.material.n_columns());
}

template <typename Number>
void TemporalBlocking<Number>::send(const unsigned int n_steps)
{
  const NodeRows &rows = body.rows;
  if (rows.has_lower_ghost())
    send(Halo::lower, rows.begin, n_steps);
  if (rows.has_upper_ghost())
    send(Halo::upper, rows.end - n_steps, n_steps);
}

template <typename Number>
void TemporalBlocking<Number>::run(const std::uint64_t first,
                                   const unsigned int n_steps,
                                   const unsigned int n_next)
{
  const NodeRows &rows = body.rows;
  const bool below = rows.has_lower_ghost(), above = rows.has_upper_ghost();
  for (unsigned int s = 0; s < n_steps; ++s)
    start(stages[s], first + s, n_steps - 1 - s);
  if (below)
    receive(Halo::lower, rows.begin - n_steps, n_steps);
  missing_above = above ? n_steps : 0;

  const unsigned int stride = (n_steps == 1 ? 5 : 1) * at_once;
  const Stage &last         = stages[n_steps - 1];
  bool lower_waits          = below && n_next > 0;
  while (last.next < last.end)
    {
      for (unsigned int s = 0; s < n_steps; ++s)
        advance(stages[s], s == 0 ? first_limit(stride) : limit_behind(stages[s - 1]));
      if (lower_waits && last.next >= rows.begin + n_next)
        {
          send(Halo::lower, rows.begin, n_next);
          lower_waits = false;
        }
      if (below || above)
        body.halo->progress();
    }
  if (above && n_next > 0)
    send(Halo::upper, rows.end - n_next, n_next);
}

/** Starts a stage; @p n_more ghost rows are advanced at sides with a neighbour. */
template <typename Number>
void TemporalBlocking<Number>::start(Stage &stage,
                                     const std::uint64_t step,
                                     const unsigned int n_more)
{
  const NodeRows &rows = body.rows;
  stage.step           = step;
  stage.begin          = rows.has_lower_ghost() ? rows.begin - n_more : 0;
  stage.end            = rows.has_upper_ghost() ? rows.end + n_more : rows.n_global;
  stage.next           = stage.begin;
  stage.sweep.reset();
}

/** The first stage advances by @p stride rows, besides the bottom row. */
template <typename Number>
unsigned int TemporalBlocking<Number>::first_limit(const unsigned int stride) const
{
  const unsigned int next = stages[0].next;
  return next + stride + (next == 0 ? 1 : 0);
}

/** A row needs the row above it to have finished the previous step. */
template <typename Number>
unsigned int TemporalBlocking<Number>::limit_behind(const Stage &before) const
{
  return before.next == before.end ? before.end : std::max(before.next, 1u) - 1;
}

/** Advances rows below @p limit, several at a time if possible. A stage soon lags one row
 * behind the previous one: the fewer rows between the first and the last stage, the more
 * steps fit the cache. */
template <typename Number>
void TemporalBlocking<Number>::advance(Stage &stage, const unsigned int limit)
{
  const unsigned int top_row = body.rows.n_global - 1;
  const unsigned int end     = std::min(limit, stage.end);
  const unsigned int inner   = std::min(end, top_row);
  if (end <= stage.next)
    return;
  if (stage.next == stage.begin && stage.begin > 0)
    {
      // Forces of the cells below the first row.
      const unsigned int below = stage.begin - 1;
      stage.sweep.store(kernel_rows(stage, below), below, false);
    }
  if (stage.next == 0)
    advance_boundary(stage);
  while (stage.next < inner)
    advance_rows(stage, stage.next + at_once <= inner ? at_once : 1);
  if (stage.next == top_row && end > top_row)
    advance_boundary(stage);
}

template <typename Number>
void TemporalBlocking<Number>::advance_rows(Stage &stage, const unsigned int n)
{
  if (missing_above > 0 && stage.next + n >= body.rows.end)
    {
      receive(Halo::upper, body.rows.end, missing_above);
      missing_above = 0;
    }
  const unsigned int l = body.rows.local(stage.next);
  for (SideColumn *column : body.columns)
    {
      state.save(l, n, column->column, 1);
      column->save(stage.next, n);
    }
  stage.sweep.step(kernel_rows(stage, stage.next), stage.next, n > 1);
  if (damping != nullptr)
    damp_rows(stage, n);
  for (SideColumn *column : body.columns)
    {
      state.save(l, n, column->column, 1);
      column->advance(stage.next, n, stage.step);
      state.load(l, n, column->column, 1);
    }
  stage.next += n;
}

/** Adds damping by phase to the next @p n rows; the kernel omits it, and the motion is
 * linear in it. */
template <typename Number>
void TemporalBlocking<Number>::damp_rows(Stage &stage, const unsigned int n)
{
  const Number c_new        = kernels.constants->c_new;
  const unsigned int n_here = body.material.n_columns();
  // The factors are for kernel forces, which lack h/2.
  const auto damp = [&](const double *f, const double h, const Number *factor, Number *u,
                        Number *w) {
    for (unsigned int i = 0; i < n_here; ++i)
      {
        const Number by = static_cast<Number>(factor[i] * (2. / h) * f[i]);
        w[i] += by;
        u[i] += c_new * by;
      }
  };
  for (unsigned int j = stage.next; j < stage.next + n; ++j)
    {
      const kernels::Rows<Number> r   = kernel_rows(stage, j);
      const std::array<double, 2> h   = body.material.grid().spacing;
      const NodalField<double> &force = damping->force();
      damp(force.row(0, body.rows.local(j)), h[0], r.factor_x, r.ux, r.wx);
      damp(force.row(1, body.rows.local(j)), h[1], r.factor_y, r.uy, r.wy);
    }
}

/** Computes the forces on the bottom or top row for its SurfaceCondition. */
template <typename Number>
void TemporalBlocking<Number>::advance_boundary(Stage &stage)
{
  const unsigned int j = stage.next;
  const bool is_top    = j > 0;
  const unsigned int l = body.rows.local(j), n = body.material.n_columns();
  kernels::Rows<Number> r = kernel_rows(stage, j);
  SurfaceView<2> view;
  masses.set_boundary(r, view, is_top);
  if (is_top)
    stage.sweep.finish(r);
  else
    stage.sweep.store(r, 0, false);
  const std::array<double *, 2> force = boundary_forces(stage);
  for (unsigned int c = 0; damping != nullptr && c < 2; ++c)
    for (unsigned int i = 0; i < n; ++i)
      force[c][i] += damping->force().row(c, l)[i];

  view.n     = n;
  view.u     = {{body.u.row(0, l), body.u.row(1, l)}};
  view.w     = {{body.w.row(0, l), body.w.row(1, l)}};
  view.force = {{force[0], force[1]}};
  view.step  = stage.step;
  view.time  = stage.step * body.parameters.dt;
  for (SideColumn *column : body.columns)
    column->add_force(view, force, is_top);
  (is_top ? body.top : body.bottom)->advance(view);
  for (SideColumn *column : body.columns)
    column->account(view, is_top);
  state.load(l, 1, 0, n);
  ++stage.next;
}

/** The forces of the kernel on a row, in double precision. */
template <typename Number>
std::array<double *, 2> TemporalBlocking<Number>::boundary_forces(Stage &stage)
{
  if constexpr (std::is_same_v<Number, double>)
    return {{stage.forces.row(0, 0), stage.forces.row(1, 0)}};
  else
    {
      std::array<double *, 2> forces = {
        {boundary_force.row(0, 0), boundary_force.row(1, 0)}};
      for (unsigned int c = 0; c < 2; ++c)
        std::copy_n(stage.forces.row(c, 0), body.material.n_columns(), forces[c]);
      return forces;
    }
}

template class TemporalBlocking<double>;
template class TemporalBlocking<float>;
} // namespace mesoslip
