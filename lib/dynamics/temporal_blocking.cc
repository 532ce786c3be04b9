#include "dynamics/temporal_blocking.h"

#include <algorithm>

namespace mesoslip
{
StepMasses::StepMasses(const UniformMaterial &material,
                       const NodeRows &rows,
                       const StepParameters &parameters,
                       const SideConstraints &sides,
                       const UniformMaterial *damping)
  : one_row(material.has_uniform_density() &&
            (damping == nullptr || damping->has_uniform_density()))
  , has_mass(parameters.acts_on_mass())
{
  const unsigned int n = material.n_columns(), top_row = material.grid().cells[1];
  const std::array<double, 2> h = material.grid().spacing;
  const auto inertia            = [&](const unsigned int j) {
    return inertia_row(material, damping, parameters, j);
  };
  for (const bool top : {false, true})
    {
      inverse_boundary[top] = NodalField<double>(n, 1);
      mass_boundary[top]    = NodalField<double>(n, 1);
      const unsigned int j  = top ? top_row : 0;
      inverse_mass_row(material, sides, inertia(j), j, inverse_boundary[top].row(0, 0),
                       inverse_boundary[top].row(1, 0), mass_boundary[top].row(0, 0));
    }

  const unsigned int n_rows = one_row ? 1 : rows.n_local();
  factor                    = NodalField<double>(n, n_rows);
  mass                      = NodalField<double>(n, has_mass ? n_rows : 1);
  for (unsigned int l = 0; l < n_rows; ++l)
    {
      double *x            = factor.row(0, l);
      double *y            = factor.row(1, l);
      const unsigned int j = one_row ? std::min(1u, top_row) : rows.first() + l;
      inverse_mass_row(material, sides, inertia(j), j, x, y,
                       mass.row(0, has_mass ? l : 0));
      for (unsigned int i = 0; i < n; ++i)
        {
          x[i] *= -parameters.dt * h[0] / 2.;
          y[i] *= -parameters.dt * h[1] / 2.;
        }
    }
  equal_components = h[0] == h[1] && sides.left_held[0] == sides.left_held[1] &&
                     sides.right_held[0] == sides.right_held[1];
}

void StepMasses::inverse_mass_row(const UniformMaterial &material,
                                  const SideConstraints &sides,
                                  const std::vector<double> &inertia,
                                  const unsigned int j,
                                  double *x,
                                  double *y,
                                  double *m) const
{
  const unsigned int n = material.n_columns();
  material.mass_row(j, m);
  for (unsigned int i = 0; i < n; ++i)
    x[i] = y[i] = 1. / inertia[i];
  double *component[2] = {x, y};
  for (const unsigned int c : {0u, 1u})
    {
      if (sides.left_held[c])
        component[c][0] = 0.;
      if (sides.right_held[c])
        component[c][n - 1] = 0.;
    }
}

void StepMasses::add_guests(const bool top, const std::vector<SideColumn *> &columns)
{
  for (SideColumn *column : columns)
    for (unsigned int c = 0; c < 2; ++c)
      if (double &inverse = inverse_boundary[top].row(c, 0)[column->column]; inverse > 0.)
        inverse = 1. / (1. / inverse + column->guest_mass(top, c));
}

void StepMasses::set_inner(kernels::Rows<double> &r, const unsigned int l) const
{
  const unsigned int row = one_row ? 0 : l;
  r.factor_x             = factor.row(0, row);
  r.factor_y             = factor.row(equal_components ? 0 : 1, row);
  r.factor_stride        = one_row ? 0 : factor.stride();
  r.mass                 = mass.row(0, has_mass ? row : 0);
  r.mass_stride          = one_row ? 0 : mass.stride();
}

void StepMasses::set_boundary(kernels::Rows<double> &r,
                              SurfaceView<2> &view,
                              const bool top) const
{
  r.mass               = mass_boundary[top].row(0, 0);
  view.inverse_mass[0] = inverse_boundary[top].row(0, 0);
  view.inverse_mass[1] = inverse_boundary[top].row(1, 0);
}

TemporalBlocking::Stage::Stage(const UniformMaterial &material,
                               const RowKernels<double> &kernels)
  : sweep(material, kernels)
  , forces(material.n_columns(), 1)
{
}

TemporalBlocking::TemporalBlocking(const SteppedBody &body,
                                   const RowKernels<double> &kernels,
                                   const StepMasses &masses,
                                   const unsigned int max_steps,
                                   const PhaseDamping *damping)
  : body(body)
  , kernels(kernels)
  , masses(masses)
  , damping(damping)
  , at_once(kernels.functions.rows_at_once)
{
  for (unsigned int i = 0; i < max_steps; ++i)
    stages.emplace_back(body.material, kernels);
}

RowBlock TemporalBlocking::block(const unsigned int j, const unsigned int n) const
{
  const unsigned int l = body.rows.local(j);
  return {body.u.row(0, l), body.u.row(1, l), body.w.row(0, l),
          body.w.row(1, l), body.u.stride(),  n};
}

/** Kernel pointers for node row @p j and the rows above. */
kernels::Rows<double> TemporalBlocking::kernel_rows(Stage &stage,
                                                    const unsigned int j) const
{
  const RowBlock state = block(j, 1);
  kernels::Rows<double> r;
  r.ux     = state.ux;
  r.uy     = state.uy;
  r.wx     = state.wx;
  r.wy     = state.wy;
  r.stride = state.stride;
  r.fx     = stage.forces.row(0, 0);
  r.fy     = stage.forces.row(1, 0);
  masses.set_inner(r, body.rows.local(j));
  return r;
}

void TemporalBlocking::send(const unsigned int n_steps)
{
  const NodeRows &rows = body.rows;
  if (rows.has_lower_ghost())
    body.halo->send(Halo::lower, block(rows.begin, n_steps));
  if (rows.has_upper_ghost())
    body.halo->send(Halo::upper, block(rows.end - n_steps, n_steps));
}

void TemporalBlocking::run(const std::uint64_t first,
                           const unsigned int n_steps,
                           const unsigned int n_next)
{
  const NodeRows &rows = body.rows;
  const bool below = rows.has_lower_ghost(), above = rows.has_upper_ghost();
  for (unsigned int s = 0; s < n_steps; ++s)
    start(stages[s], first + s, n_steps - 1 - s);
  if (below)
    body.halo->receive(Halo::lower, block(rows.begin - n_steps, n_steps));
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
          body.halo->send(Halo::lower, block(rows.begin, n_next));
          lower_waits = false;
        }
      if (below || above)
        body.halo->progress();
    }
  if (above && n_next > 0)
    body.halo->send(Halo::upper, block(rows.end - n_next, n_next));
}

/** Starts a stage; @p n_more ghost rows are advanced at sides with a neighbour. */
void TemporalBlocking::start(Stage &stage,
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

/**
 * The first stage advances by @p stride rows; the bottom row belongs to its
 * SurfaceCondition, not to the kernel.
 */
unsigned int TemporalBlocking::first_limit(const unsigned int stride) const
{
  const unsigned int next = stages[0].next;
  return next + stride + (next == 0 ? 1 : 0);
}

/** A row needs the row above it to have finished the previous step. */
unsigned int TemporalBlocking::limit_behind(const Stage &before) const
{
  return before.next == before.end ? before.end : std::max(before.next, 1u) - 1;
}

/**
 * Advances rows below @p limit, several at a time if possible. A stage soon lags one row
 * behind the previous one: the fewer rows between the first and the last stage, the more
 * steps fit the cache.
 */
void TemporalBlocking::advance(Stage &stage, const unsigned int limit)
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

void TemporalBlocking::advance_rows(Stage &stage, const unsigned int n)
{
  if (missing_above > 0 && stage.next + n >= body.rows.end)
    {
      body.halo->receive(Halo::upper, block(body.rows.end, missing_above));
      missing_above = 0;
    }
  for (SideColumn *column : body.columns)
    column->save(stage.next, n);
  stage.sweep.step(kernel_rows(stage, stage.next), stage.next, n > 1);
  if (damping != nullptr)
    damp_rows(stage, n);
  for (SideColumn *column : body.columns)
    column->advance(stage.next, n, stage.step);
  stage.next += n;
}

/**
 * Adds damping by phase to the next @p n rows; the kernel omits it, and the motion is
 * linear in it.
 */
void TemporalBlocking::damp_rows(Stage &stage, const unsigned int n)
{
  const double c_new        = kernels.constants->c_new;
  const unsigned int n_here = body.material.n_columns();
  // The factors are for kernel forces, which lack h/2.
  const auto damp = [&](const double *f, const double h, const double *factor, double *u,
                        double *w) {
    for (unsigned int i = 0; i < n_here; ++i)
      {
        const double by = factor[i] * (2. / h) * f[i];
        w[i] += by;
        u[i] += c_new * by;
      }
  };
  for (unsigned int j = stage.next; j < stage.next + n; ++j)
    {
      const kernels::Rows<double> r   = kernel_rows(stage, j);
      const std::array<double, 2> h   = body.material.grid().spacing;
      const NodalField<double> &force = damping->force();
      damp(force.row(0, body.rows.local(j)), h[0], r.factor_x, r.ux, r.wx);
      damp(force.row(1, body.rows.local(j)), h[1], r.factor_y, r.uy, r.wy);
    }
}

/** Computes the forces on the bottom or top row for its SurfaceCondition. */
void TemporalBlocking::advance_boundary(Stage &stage)
{
  const unsigned int j    = stage.next;
  const bool is_top       = j > 0;
  kernels::Rows<double> r = kernel_rows(stage, j);
  SurfaceView<2> view;
  masses.set_boundary(r, view, is_top);
  if (is_top)
    stage.sweep.finish(r);
  else
    stage.sweep.store(r, 0, false);
  for (unsigned int i = 0; damping != nullptr && i < body.material.n_columns(); ++i)
    {
      r.fx[i] += damping->force().row(0, body.rows.local(j))[i];
      r.fy[i] += damping->force().row(1, body.rows.local(j))[i];
    }

  view.n     = body.material.n_columns();
  view.u     = {{r.ux, r.uy}};
  view.w     = {{r.wx, r.wy}};
  view.force = {{r.fx, r.fy}};
  view.step  = stage.step;
  view.time  = stage.step * body.parameters.dt;
  for (SideColumn *column : body.columns)
    column->add_force(view, {{r.fx, r.fy}}, is_top);
  (is_top ? body.top : body.bottom)->advance(view);
  for (SideColumn *column : body.columns)
    column->account(view, is_top);
  ++stage.next;
}
} // namespace mesoslip
