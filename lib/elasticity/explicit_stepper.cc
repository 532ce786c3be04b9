#include "elasticity/explicit_stepper.h"

#include "elasticity/row_sweep.h"
#include "elasticity/step_masses.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace mesoslip
{
FreeRow::FreeRow(const StepParameters &parameters)
  : dt(parameters.dt)
  , c_new(parameters.dt * (parameters.beta2 + 0.5))
  , c_old(-parameters.dt * (parameters.beta2 - 0.5))
{
}

void FreeRow::advance(const RowView &row)
{
  const auto move = [&](double *__restrict__ u, double *__restrict__ w,
                        const double *__restrict__ f,
                        const double *__restrict__ inverse_mass) {
    for (unsigned int i = 0; i < row.n_columns; ++i)
      {
        const double w_old = w[i];
        const double w_new = w_old - dt * inverse_mass[i] * f[i];
        w[i]               = w_new;
        u[i] += c_new * w_new + c_old * w_old;
      }
  };
  move(row.ux, row.wx, row.fx, row.inverse_mass_x);
  move(row.uy, row.wy, row.fy, row.inverse_mass_y);
}

namespace
{
constexpr unsigned int max_wavefront = 16;

std::size_t second_level_cache()
{
  const long size = sysconf(_SC_LEVEL2_CACHE_SIZE);
  return size > 0 ? size : 1 << 20;
}

/** One time step in flight: how far its sweep is. */
struct Stage
{
  Stage(const UniformMaterial &material, const RowKernels<double> &kernels)
    : sweep(material, kernels)
    , forces(material.n_columns(), 1)
  {
  }

  RowSweep<double> sweep;
  NodalField<double> forces;
  std::uint64_t step = 0;
  /** All node rows below (global number) have done the step. */
  unsigned int next = 0;
};

/** The material, once everything is known to fit it. */
const UniformMaterial &checked(const UniformMaterial &material,
                               const NodeRows &rows,
                               const StepParameters &p,
                               const SideConstraints &sides,
                               const NodalField<double> &u,
                               const NodalField<double> &w,
                               const Halo *halo)
{
  if (!(p.dt > 0.) || !(p.beta2 > 0.) || !(p.beta >= 0.))
    throw std::invalid_argument(
      "the time step and beta2 must be positive, beta not negative");
  if (material.periodicity().y)
    throw std::invalid_argument(
      "the stepper has a bottom and a top: no periodicity in y");
  for (const NodalField<double> *field : {&u, &w})
    if (field->n_columns() != material.n_columns() || field->n_rows() != rows.n_local())
      throw std::invalid_argument("the state of the stepper does not fit its grid");
  const bool neighbours = rows.has_lower_ghost() || rows.has_upper_ghost();
  if (rows.n_global != material.n_rows() || rows.end > rows.n_global ||
      rows.begin + (neighbours ? 2 : 1) > rows.end)
    throw std::invalid_argument("the rows of the stepper do not fit its grid");
  if (neighbours && halo == nullptr)
    throw std::invalid_argument("a slab with neighbours needs a halo");
  const auto held = [](const std::array<bool, 2> &side) { return side[0] || side[1]; };
  if (material.periodicity().x && (held(sides.left_held) || held(sides.right_held)))
    throw std::invalid_argument("the sides of a grid periodic in x cannot be held");
  return material;
}
} // namespace

struct ExplicitStepper::Implementation
{
  const UniformMaterial &material;
  const NodeRows rows;
  const StepParameters parameters;
  const SideConstraints sides;
  NodalField<double> &u;
  NodalField<double> &w;
  FreeRow free_row;
  BoundaryRow *const bottom;
  BoundaryRow *const top;
  Halo *const halo;
  const RowKernels<double> kernels;
  const unsigned int at_once;

  const StepMasses masses;

  std::vector<Stage> stages;
  std::uint64_t step_number = 0;
  std::string name;

  Implementation(const UniformMaterial &m,
                 const NodeRows &r,
                 const StepParameters &p,
                 const SideConstraints &s,
                 NodalField<double> &u_,
                 NodalField<double> &w_,
                 BoundaryRow *bottom_,
                 BoundaryRow *top_,
                 Halo *halo_,
                 const SweepOptions &options);

  void set_constants();
  unsigned int choose_depth(const unsigned int requested) const;

  kernels::Rows<double> state(const unsigned int j, Stage &stage);
  RowState row_state(const unsigned int j);
  void boundary(Stage &stage, const unsigned int j);

  void start(Stage &stage, const std::uint64_t step);
  void run_until(Stage &stage, const unsigned int end);
  void plain_sweep(const bool last);
  void wavefront(const unsigned int n_steps);
};

ExplicitStepper::Implementation::Implementation(const UniformMaterial &m,
                                                const NodeRows &r,
                                                const StepParameters &p,
                                                const SideConstraints &s,
                                                NodalField<double> &u_,
                                                NodalField<double> &w_,
                                                BoundaryRow *bottom_,
                                                BoundaryRow *top_,
                                                Halo *halo_,
                                                const SweepOptions &options)
  : material(checked(m, r, p, s, u_, w_, halo_))
  , rows(r)
  , parameters(p)
  , sides(s)
  , u(u_)
  , w(w_)
  , free_row(p)
  , bottom(bottom_ ? bottom_ : &free_row)
  , top(top_ ? top_ : &free_row)
  , halo(halo_)
  , kernels(m, options.isa, p.beta != 0., p.acceleration != std::array<double, 2>{})
  , at_once(kernels.functions.rows_at_once)
  , masses(m, r, p, s)
{
  set_constants();
  const unsigned int depth = choose_depth(options.wavefront);
  for (unsigned int i = 0; i < depth; ++i)
    stages.emplace_back(material, kernels);
  name = to_string(resolve(options.isa)) + " " + kernels::name(kernels.choice);
}

void ExplicitStepper::Implementation::set_constants()
{
  auto &c         = *kernels.constants;
  const double hx = material.grid().spacing[0], hy = material.grid().spacing[1];
  c.beta      = parameters.beta;
  c.c_new     = parameters.dt * (parameters.beta2 + 0.5);
  c.c_old     = -parameters.dt * (parameters.beta2 - 0.5);
  c.gravity_x = parameters.acceleration[0];
  c.gravity_y = parameters.acceleration[1];
  // Stepping kernels have forces times 2/h.
  c.scaled_gravity_x = parameters.acceleration[0] * 2. / hx;
  c.scaled_gravity_y = parameters.acceleration[1] * 2. / hy;
}

unsigned int
ExplicitStepper::Implementation::choose_depth(const unsigned int requested) const
{
  if (rows.has_lower_ghost() || rows.has_upper_ghost() || rows.n_global < 3)
    return 1;
  if (requested > 0)
    return std::min(requested, 64u);
  const std::size_t cache = second_level_cache();
  if (2 * u.size() * sizeof(double) < cache / 2)
    return 1;
  // What a stage has just written is read by the next one, so more stages pay even when
  // they do not all fit: measured on rows of 0.6 to 36 kB.
  const std::size_t stage = (at_once + 2) * 4 * u.stride() * sizeof(double);
  return std::max<std::size_t>(8,
                               std::min<std::size_t>(max_wavefront, cache / 2 / stage));
}

/** Pointers of the kernel for node row @p j and those above. */
kernels::Rows<double> ExplicitStepper::Implementation::state(const unsigned int j,
                                                             Stage &stage)
{
  const unsigned int l = rows.local(j);
  kernels::Rows<double> r;
  r.ux     = u.row(0, l);
  r.uy     = u.row(1, l);
  r.wx     = w.row(0, l);
  r.wy     = w.row(1, l);
  r.stride = u.stride();
  r.fx     = stage.forces.row(0, 0);
  r.fy     = stage.forces.row(1, 0);
  masses.set_inner(r, l);
  return r;
}

RowState ExplicitStepper::Implementation::row_state(const unsigned int j)
{
  const unsigned int l = rows.local(j);
  return {u.row(0, l), u.row(1, l), w.row(0, l), w.row(1, l)};
}

/** Forces of the bottom or top row, handed to whoever moves it. */
void ExplicitStepper::Implementation::boundary(Stage &stage, const unsigned int j)
{
  const bool is_top       = j > 0;
  kernels::Rows<double> r = state(j, stage);
  RowView view;
  masses.set_boundary(r, view, is_top);
  if (is_top)
    stage.sweep.finish(r);
  else
    stage.sweep.store(r, 0, false);

  view.ux        = r.ux;
  view.uy        = r.uy;
  view.wx        = r.wx;
  view.wy        = r.wy;
  view.fx        = r.fx;
  view.fy        = r.fy;
  view.n_columns = material.n_columns();
  view.step      = stage.step;
  view.time      = stage.step * parameters.dt;
  (is_top ? top : bottom)->advance(view);
}

void ExplicitStepper::Implementation::start(Stage &stage, const std::uint64_t step)
{
  stage.step = step;
  stage.next = rows.begin;
  stage.sweep.reset();
  if (rows.has_lower_ghost())
    {
      halo->receive_lower(row_state(rows.first()));
      stage.sweep.store(state(rows.first(), stage), rows.first(), false);
    }
}

/** Advance the sweep until all rows below @p end have done the step. */
void ExplicitStepper::Implementation::run_until(Stage &stage, const unsigned int end)
{
  const unsigned int top_row = rows.n_global - 1;
  const unsigned int inner   = std::min(end, top_row);
  if (stage.next == 0 && end > 0)
    {
      boundary(stage, 0);
      stage.next = 1;
    }
  while (stage.next < inner)
    {
      const bool several   = stage.next + at_once <= inner;
      const unsigned int n = several ? at_once : 1;
      if (stage.next + n == rows.end && rows.has_upper_ghost())
        halo->receive_upper(row_state(rows.end));
      stage.sweep.step(state(stage.next, stage), stage.next, several);
      stage.next += n;
    }
  if (stage.next == top_row && end > top_row)
    {
      boundary(stage, top_row);
      ++stage.next;
    }
}

/** One time step; on a slab, tell the neighbours unless it is the last one. */
void ExplicitStepper::Implementation::plain_sweep(const bool last)
{
  Stage &stage = stages[0];
  start(stage, step_number);
  if (!rows.has_lower_ghost() && !rows.has_upper_ghost())
    run_until(stage, rows.end);
  else
    {
      run_until(stage, std::min(rows.begin + at_once, rows.end - 1));
      if (rows.has_lower_ghost() && !last)
        halo->send_lower(row_state(rows.begin));
      constexpr unsigned int n_rows_between = 16;
      while (stage.next + n_rows_between < rows.end)
        {
          run_until(stage, stage.next + n_rows_between);
          halo->progress();
        }
      run_until(stage, rows.end);
      if (rows.has_upper_ghost() && !last)
        halo->send_upper(row_state(rows.end - 1));
    }
  ++step_number;
}

/** As many steps as there are stages at most, each lagging one row behind the last. */
void ExplicitStepper::Implementation::wavefront(const unsigned int n_steps)
{
  for (unsigned int s = 0; s < n_steps; ++s)
    start(stages[s], step_number + s);
  while (stages[n_steps - 1].next < rows.end)
    for (unsigned int s = 0; s < n_steps; ++s)
      {
        unsigned int end = std::min(stages[s].next + at_once, rows.end);
        if (s > 0)
          {
            // A row needs the row above it to have finished the step before.
            const unsigned int ahead = stages[s - 1].next;
            end = ahead == rows.end ? ahead : std::max(ahead, 1u) - 1;
          }
        run_until(stages[s], end);
      }
  step_number += n_steps;
}

ExplicitStepper::ExplicitStepper(const UniformMaterial &material,
                                 const StepParameters &parameters,
                                 const SideConstraints &sides,
                                 NodalField<double> &u,
                                 NodalField<double> &w,
                                 BoundaryRow *bottom,
                                 BoundaryRow *top,
                                 const SweepOptions &options)
  : ExplicitStepper(material,
                    NodeRows::all(material.n_rows()),
                    parameters,
                    sides,
                    u,
                    w,
                    bottom,
                    top,
                    nullptr,
                    options)
{
}

ExplicitStepper::ExplicitStepper(const UniformMaterial &material,
                                 const NodeRows &rows,
                                 const StepParameters &parameters,
                                 const SideConstraints &sides,
                                 NodalField<double> &u,
                                 NodalField<double> &w,
                                 BoundaryRow *bottom,
                                 BoundaryRow *top,
                                 Halo *halo,
                                 const SweepOptions &options)
  : implementation(std::make_unique<Implementation>(
      material, rows, parameters, sides, u, w, bottom, top, halo, options))
{
}

ExplicitStepper::~ExplicitStepper() = default;

void ExplicitStepper::step()
{
  advance(1);
}

void ExplicitStepper::advance(const std::uint64_t n_steps)
{
  Implementation &s       = *implementation;
  const NodeRows &rows    = s.rows;
  const std::uint64_t end = s.step_number + n_steps;
  if (n_steps > 0 && rows.has_lower_ghost())
    s.halo->send_lower(s.row_state(rows.begin));
  if (n_steps > 0 && rows.has_upper_ghost())
    s.halo->send_upper(s.row_state(rows.end - 1));
  while (s.step_number < end)
    {
      const std::uint64_t n =
        std::min<std::uint64_t>(end - s.step_number, s.stages.size());
      if (n == 1)
        s.plain_sweep(s.step_number + 1 == end);
      else
        s.wavefront(n);
    }
}

std::uint64_t ExplicitStepper::step_number() const
{
  return implementation->step_number;
}

void ExplicitStepper::set_step_number(const std::uint64_t n)
{
  implementation->step_number = n;
}

unsigned int ExplicitStepper::wavefront_depth() const
{
  return implementation->stages.size();
}

const char *ExplicitStepper::kernel_name() const
{
  return implementation->name.c_str();
}
} // namespace mesoslip
