#ifndef mesoslip_dynamics_grid_explicit_stepper_h
#define mesoslip_dynamics_grid_explicit_stepper_h

#include "dynamics/grid/temporal_blocking.h"
#include "elasticity/uniform_grid_operator.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Explicit time integration of the bulk on a uniform grid, force and update fused in one
 * pass over the rows, in place:
 *
 *     a = M^-1 (boundary forces + M (g - alpha w) - K (u + beta w)) / (1 + alpha dt / 2)
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a
 *
 * This is the beta2 scheme with v = w + beta2 dt a where a velocity is reported (w alone
 * is v_n - beta2 dt a_n, see doc/). The kernel advances inner rows, the given
 * SurfaceCondition<2> objects the bottom and the top row.
 *
 * Objects referenced by SteppedBody must outlive the stepper; its fields have
 * material.n_columns() columns and rows.n_local() rows. On a slab every rank needs at
 * least two owned rows, and at least as many as there are ghost rows.
 *
 * Between calls, the owned rows of the fields and the boundary rows are the complete
 * state; they may be set before the first call, not after it. After step() the nearest
 * ghost rows hold u_n and w_n; after advance() they are undefined.
 */
class ExplicitStepper : public Stepper
{
public:
  /** Throws std::invalid_argument for inconsistent arguments. */
  explicit ExplicitStepper(const SteppedBody &body,
                           const SideConstraints &sides = {},
                           const SweepOptions &options  = {})
    : Stepper(body.parameters,
              body.u,
              body.w,
              body.rows,
              checked(body, sides).n_columns() - (body.material.periodicity().x ? 1 : 0),
              body.communicator,
              body.damping != nullptr ? damping_of(body) : nullptr)
    , material(body.material)
    , isa(resolve(options.isa))
    , is_single(options.single_precision)
    , columns(body.columns)
    , platens(body.platens)
    , free_surface(body.parameters)
    , op(material, body.rows)
    , sweeps(options.single_precision ? make_sweeps<float>(body, sides, options)
                                      : make_sweeps<double>(body, sides, options))
  {
  }

  void advance(const std::uint64_t n_steps) override
  {
    const std::uint64_t end   = n_done + n_steps;
    const auto steps_of_sweep = [&](const std::uint64_t from) {
      const std::uint64_t left   = end - from;
      const std::uint64_t blocks = (left + sweeps->max_steps() - 1) / sweeps->max_steps();
      return static_cast<unsigned int>(left > 0 ? (left + blocks - 1) / blocks : 0);
    };

    for (SideColumn *column : columns)
      column->start(n_done);
    for (; (by_phase || !platens.empty()) && n_done < end; ++n_done)
      step_once();
    unsigned int n = steps_of_sweep(n_done);
    if (n == 0)
      return;
    if (!loaded)
      sweeps->load();
    assert(sweeps->is_current());
    sweeps->send(n);
    while (n > 0)
      {
        const unsigned int n_next = steps_of_sweep(n_done + n);
        sweeps->run(n_done, n, n_next);
        n_done += n;
        n = n_next;
      }
    sweeps->save();
    loaded = true;
  }

  void multiply(NodalField<double> &Kx, NodalField<double> &x) const override
  {
    update_ghost_rows(x, rows, communicator);
    op.vmult(Kx, x);
  }

  double elastic_energy() const override
  {
    update_ghost_rows(u, rows, communicator);
    return op.elastic_energy(u);
  }

  void mass_row(const unsigned int j, double *mass) const override
  {
    material.mass_row(j, mass);
  }

  Deformation deformation() const override
  {
    update_ghost_rows(u, rows, communicator);
    Deformation found = largest_deformation(material.grid(), rows, u, communicator);
    if (is_single)
      found.rounding = rounding_of_strain(material.grid(), rows, u, communicator);
    return found;
  }

  /** Kernel variant and instruction set. */
  std::string kernel_name() const override
  {
    return to_string(isa) + " " + sweeps->kernel_name();
  }

  /** Number of steps per sweep of advance(). */
  unsigned int steps_at_once() const
  {
    return sweeps->max_steps();
  }

private:
  /**
   * One sweep of one step; phase damping and platens act on all rows before and after it.
   */
  void step_once()
  {
    if (by_phase)
      by_phase->start_step(w);
    for (PlatenColumn *platen : platens)
      platen->save();
    sweeps->load();
    sweeps->send(1);
    sweeps->run(n_done, 1, 0);
    sweeps->save();
    for (PlatenColumn *platen : platens)
      platen->advance(n_done);
    loaded = false;
  }

  /** The material, after a check that everything fits it. */
  static const UniformMaterial &checked(const SteppedBody &body,
                                        const SideConstraints &sides)
  {
    const UniformMaterial &material = body.material;
    const NodeRows &rows            = body.rows;
    const StepParameters &p         = body.parameters;
    if (!(p.dt > 0.) || !(p.beta2 > 0.) || !(p.beta >= 0.) || !(p.alpha >= 0.))
      throw std::invalid_argument(
        "the time step and beta2 must be positive, alpha and beta not negative");
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

  static std::unique_ptr<PhaseDamping> damping_of(const SteppedBody &body)
  {
    const UniformMaterial &damping = *body.damping;
    NodalField<double> drags(body.u.n_columns(), body.u.n_rows(), 1);
    for (unsigned int l = 0; l < body.u.n_rows(); ++l)
      damping.mass_row(body.rows.first() + l, drags.row(0, l));
    const auto op = std::make_shared<const UniformGridOperator>(damping, body.rows);
    return std::make_unique<PhaseDamping>(
      body.parameters,
      [op, rows = body.rows, communicator = body.communicator](NodalField<double> &Kw,
                                                               NodalField<double> &w) {
        update_ghost_rows(w, rows, communicator);
        op->vmult(Kw, w);
      },
      std::move(drags), body.u);
  }

  /** Time steps per sweep: the number of ghost rows if there are neighbours. */
  static unsigned int max_steps(const SteppedBody &body, const SweepOptions &options)
  {
    if (body.damping != nullptr || !body.platens.empty())
      return 1;
    const NodeRows &rows = body.rows;
    if (rows.has_lower_ghost() || rows.has_upper_ghost())
      return rows.ghosts;
    return choose_steps_at_once(body.material.n_columns(), rows.n_global, 1,
                                options.steps_at_once);
  }

  template <typename Number>
  std::unique_ptr<Sweeps>
  make_sweeps(SteppedBody body, const SideConstraints &sides, const SweepOptions &options)
  {
    for (SurfaceCondition<2> **surface : {&body.bottom, &body.top})
      if (*surface == nullptr)
        *surface = &free_surface;
    return std::make_unique<TemporalBlocking<Number>>(
      body, sides, isa, max_steps(body, options), by_phase.get());
  }

  const UniformMaterial &material;
  const InstructionSet isa;
  const bool is_single;
  const std::vector<SideColumn *> columns;
  const std::vector<PlatenColumn *> platens;
  FreeSurface<2> free_surface;
  const UniformGridOperator op;
  const std::unique_ptr<Sweeps> sweeps;
  bool loaded = false; ///< whether the sweeps have the state of the fields
};
} // namespace mesoslip

#endif
