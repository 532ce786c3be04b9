#include "dynamics/explicit_stepper.h"

#include "dynamics/step_masses.h"
#include "dynamics/wavefront.h"
#include "elasticity/row_sweep.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace mesoslip
{
namespace
{
/** The material, once everything is known to fit it. */
const UniformMaterial &checked(const SteppedBody &body, const SideConstraints &sides)
{
  const UniformMaterial &material = body.material;
  const NodeRows &rows            = body.rows;
  const StepParameters &p         = body.parameters;
  if (!(p.dt > 0.) || !(p.beta2 > 0.) || !(p.beta >= 0.))
    throw std::invalid_argument(
      "the time step and beta2 must be positive, beta not negative");
  if (material.periodicity().y)
    throw std::invalid_argument(
      "the stepper has a bottom and a top: no periodicity in y");
  for (const NodalField<double> *field : {&body.u, &body.w})
    if (field->n_columns() != material.n_columns() || field->n_rows() != rows.n_local())
      throw std::invalid_argument("the state of the stepper does not fit its grid");
  const bool neighbours    = rows.has_lower_ghost() || rows.has_upper_ghost();
  const unsigned int least = neighbours ? std::max(2u, rows.ghosts) : 1;
  if (rows.n_global != material.n_rows() || rows.end > rows.n_global ||
      rows.begin + least > rows.end || (neighbours && rows.ghosts == 0))
    throw std::invalid_argument("the rows of the stepper do not fit its grid");
  if (neighbours && body.halo == nullptr)
    throw std::invalid_argument("a slab with neighbours needs a halo");
  const auto held = [](const std::array<bool, 2> &side) { return side[0] || side[1]; };
  if (material.periodicity().x && (held(sides.left_held) || held(sides.right_held)))
    throw std::invalid_argument("the sides of a grid periodic in x cannot be held");
  return material;
}

RowKernels<double> make_kernels(const UniformMaterial &material,
                                const StepParameters &parameters,
                                const InstructionSet isa)
{
  RowKernels<double> kernels(material, isa, parameters.beta != 0.,
                             parameters.acceleration != std::array<double, 2>{});
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
  return kernels;
}

/** Time steps in flight: with neighbours as many as there are ghost rows. */
unsigned int max_steps(const SteppedBody &body, const SweepOptions &options)
{
  const NodeRows &rows = body.rows;
  if (rows.has_lower_ghost() || rows.has_upper_ghost())
    return rows.ghosts;
  return steps_in_flight(body.material.n_columns(), rows.n_global, 1, options.wavefront);
}
} // namespace

struct ExplicitStepper::Implementation
{
  FreeSurface<2> free_row;
  const RowKernels<double> kernels;
  const StepMasses masses;
  const std::string name;
  Wavefront wavefront;
  std::uint64_t step_number = 0;

  Implementation(const SteppedBody &body,
                 const SideConstraints &sides,
                 const SweepOptions &options)
    : free_row(body.parameters)
    , kernels(make_kernels(checked(body, sides), body.parameters, options.isa))
    , masses(body.material, body.rows, body.parameters, sides)
    , name(to_string(resolve(options.isa)) + " " + kernels::name(kernels.choice))
    , wavefront(with_free_rows(body), kernels, masses, max_steps(body, options))
  {
  }

  SteppedBody with_free_rows(SteppedBody body)
  {
    for (SurfaceCondition<2> **row : {&body.bottom, &body.top})
      if (*row == nullptr)
        *row = &free_row;
    return body;
  }
};

ExplicitStepper::ExplicitStepper(const UniformMaterial &material,
                                 const StepParameters &parameters,
                                 const SideConstraints &sides,
                                 NodalField<double> &u,
                                 NodalField<double> &w,
                                 SurfaceCondition<2> *bottom,
                                 SurfaceCondition<2> *top,
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
                                 SurfaceCondition<2> *bottom,
                                 SurfaceCondition<2> *top,
                                 Halo *halo,
                                 const SweepOptions &options)
  : implementation(std::make_unique<Implementation>(
      SteppedBody{material, rows, parameters, u, w, bottom, top, halo}, sides, options))
{
}

ExplicitStepper::~ExplicitStepper() = default;

void ExplicitStepper::step()
{
  advance(1);
}

void ExplicitStepper::advance(const std::uint64_t n_steps)
{
  Wavefront &wavefront     = implementation->wavefront;
  std::uint64_t &step      = implementation->step_number;
  const std::uint64_t end  = step + n_steps;
  const auto steps_at_once = [&](const std::uint64_t from) {
    const std::uint64_t left = end - from;
    const std::uint64_t blocks =
      (left + wavefront.max_steps() - 1) / wavefront.max_steps();
    return static_cast<unsigned int>(left > 0 ? (left + blocks - 1) / blocks : 0);
  };
  unsigned int n = steps_at_once(step);
  if (n > 0)
    wavefront.send(n);
  while (n > 0)
    {
      const unsigned int n_next = steps_at_once(step + n);
      wavefront.run(step, n, n_next);
      step += n;
      n = n_next;
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
  return implementation->wavefront.max_steps();
}

const char *ExplicitStepper::kernel_name() const
{
  return implementation->name.c_str();
}
} // namespace mesoslip
