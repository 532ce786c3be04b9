#include "dynamics/brick_stepper.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>

namespace mesoslip
{
namespace
{
/** Index of the component in the order of the sweep. */
std::uint32_t in_sweep(const unsigned int component)
{
  return component == 0 ? 0 : 3 - component;
}

/** Phase damping with an operator for phases_of_damping(). */
std::unique_ptr<PhaseDamping> damping_by(const std::shared_ptr<const BrickOperator> &op,
                                         const StepParameters &parameters,
                                         const NodalField<double> &u)
{
  return damping_of_points(
    parameters, op->lumped_mass(),
    [op](NodalField<double> &Kw, const NodalField<double> &w) { op->multiply(Kw, w); },
    u);
}
} // namespace

BrickStepper::BrickStepper(const BrickOperator &op,
                           const std::vector<HeldComponent> &held,
                           const StepParameters &parameters,
                           NodalField<double> &u,
                           NodalField<double> &w,
                           const std::shared_ptr<const BrickOperator> &damping)
  : SurfaceStepper<3>(parameters,
                      u,
                      w,
                      op.slab().part,
                      op.communicator,
                      damping ? damping_by(damping, parameters, u) : nullptr)
  , op(op)
{
  set_inverse_mass();
  set_held(held);
  if (!by_phase)
    return;
  mobility = u.zeros_alike(); // zero at repeated points
  for (const std::size_t start : op.slab().plane_start)
    for (unsigned int k = 0; k < op.slab().n_nodes[0] * op.slab().n_nodes[1]; ++k)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const auto i          = static_cast<unsigned int>(start) + k;
          mobility.row(c, 0)[i] = is_held(i, c) ? 0. : inverse_inertia(i);
        }
}

/** Equal rows are stored once: a few rows for bodies of uniform density. */
void BrickStepper::set_inverse_mass()
{
  const BrickSlab &slab = op.slab();
  const std::size_t n   = slab.n_nodes[0];
  std::vector<double> of;
  for (unsigned int i = 0; i < op.lumped_mass().size(); ++i)
    of.push_back(inverse_inertia(i));
  std::map<std::string, std::size_t> known;
  std::vector<std::size_t> first;
  for (const std::size_t start : slab.plane_start)
    for (std::size_t k = 0; k < slab.n_nodes[1]; ++k)
      {
        const double *row = of.data() + start + k * n;
        const std::string bytes(reinterpret_cast<const char *>(row), n * sizeof(double));
        const auto [place, is_new] = known.emplace(bytes, mass_rows.size());
        first.push_back(place->second);
        for (std::size_t i = 0; is_new && i < n; ++i)
          mass_rows.push_back(row[i]);
      }
  mass_rows.resize(mass_rows.size() + lanes<double>);
  for (const std::size_t place : first)
    inverse_mass.push_back(mass_rows.data() + place);
}

/** Inverse inertia: mass including alpha (1/kg). */
double BrickStepper::inverse_inertia(const unsigned int point) const
{
  return 1. / inertia_of({point, 0}, op.lumped_mass()[point]);
}

void BrickStepper::set_held(const std::vector<HeldComponent> &components)
{
  const BrickSlab &slab    = op.slab();
  const std::size_t n_rows = std::size_t{slab.n_planes} * slab.n_nodes[1];
  const PointIndex index(slab.part, points_of(components));
  std::vector<std::array<std::uint32_t, 3>> all; // row, component, node
  for (const HeldComponent &h : components)
    for (const unsigned int point : index.find(h.point))
      {
        const auto [node, row, plane] = slab.place_of(point);
        all.push_back({{plane * slab.n_nodes[1] + row, in_sweep(h.component), node}});
      }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  held_begin.assign(n_rows + 1, 0);
  for (const auto &[row, component, node] : all)
    {
      ++held_begin[row + 1];
      held.push_back({node, component});
    }
  std::partial_sum(held_begin.begin(), held_begin.end(), held_begin.begin());
}

bool BrickStepper::is_held(const unsigned int point, const unsigned int component) const
{
  const auto [node, row, plane] = op.slab().place_of(point);
  const std::size_t k           = std::size_t{plane} * op.slab().n_nodes[1] + row;
  return std::any_of(held.begin() + held_begin[k], held.begin() + held_begin[k + 1],
                     [&, node = node](const kernels::HeldNode &h) {
                       return h.node == node && h.component == in_sweep(component);
                     });
}

MeshSurface<3> &BrickStepper::add_surface(const SharedNodes &nodes,
                                          SurfaceCondition<3> &condition)
{
  const BrickSlab &slab   = op.slab();
  const unsigned int last = slab.n_nodes[1] - 1;
  // Either all ranks have nodes of bottom and top, or none has.
  bool is_top = false;
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (nodes.point(i) != SharedNodes::none)
      {
        const unsigned int row = slab.place_of(nodes.point(i))[1];
        if (row != 0 && row != last)
          throw std::invalid_argument("surfaces of a box are at its bottom and top");
        is_top = row == last;
      }
  Side &side          = sides[is_top ? 1 : 0];
  side.surface        = make_surface(nodes, condition);
  const std::size_t n = slab.n_nodes[0];
  side.force.resize(3 * n * slab.n_planes);
  for (const unsigned int point : side.surface->points())
    {
      const auto [node, row, plane] = slab.place_of(point);
      side.force_place.push_back(3 * n * plane + node);
      for (unsigned int c = 0; c < 3 && by_phase; ++c)
        mobility.row(c, 0)[point] = 0.; // advanced by the surface
    }
  if (side.force_place.size() < std::size_t{slab.box.grid.cells[0] + 1} * slab.n_planes)
    throw std::invalid_argument("a surface of a box has to be the whole bottom or top");
  return *side.surface;
}

MeshSurface<3> &BrickStepper::add_side(const SharedNodes &nodes,
                                       SurfaceCondition<3> &condition)
{
  lateral.push_back(make_surface(nodes, condition));
  return *lateral.back();
}

std::unique_ptr<MeshSurface<3>>
BrickStepper::make_surface(const SharedNodes &nodes, SurfaceCondition<3> &condition) const
{
  return std::make_unique<MeshSurface<3>>(
    nodes,
    [this](const unsigned int point, const unsigned int c) {
      return is_held(point, c) ? 0. : inverse_inertia(point);
    },
    condition, communicator);
}

kernels::BrickStep BrickStepper::brick_step()
{
  kernels::BrickStep step = {};
  for (unsigned int c = 0; c < 3; ++c)
    {
      const unsigned int axis = BrickOperator::sweep_axis[c];
      step.u[c]               = u.row(axis, 0);
      step.w[c]               = w.row(axis, 0);
      if (parameters.alpha_of_phases.empty()) // otherwise added by damp_by_phase()
        step.acceleration[c] = parameters.acceleration[axis] / parameters.inertia();
    }
  step.dt           = parameters.dt;
  step.c_new        = parameters.dt * (parameters.beta2 + 0.5);
  step.c_old        = -parameters.dt * (parameters.beta2 - 0.5);
  step.beta         = parameters.common_beta();
  step.alpha        = parameters.common_alpha() / parameters.inertia();
  step.inverse_mass = inverse_mass.data();
  step.held_begin   = held_begin.data();
  step.held         = held.data();
  for (unsigned int s = 0; s < 2; ++s)
    step.surface_force[s] = sides[s].surface ? sides[s].force.data() : nullptr;
  return step;
}

void BrickStepper::advance(const std::uint64_t n_steps)
{
  // The fields may have changed since the last step.
  for (const Side &side : sides)
    if (side.surface)
      side.surface->load(u, w);
  for (const auto &side : lateral)
    side->load(u, w);
  const kernels::BrickStep step = brick_step();
  const std::size_t n           = op.slab().n_nodes[0];
  const bool has_more           = parameters.acts_on_mass() || by_phase;
  for (std::uint64_t k = 0; k < n_steps; ++k, ++n_done)
    {
      const double time = static_cast<double>(n_done) * parameters.dt;
      if (by_phase)
        by_phase->start_step(w);
      op.advance(step);
      if (by_phase)
        damp_by_phase();
      for (const Side &side : sides)
        if (side.surface)
          side.surface->start(
            n_done, time, [&](const std::size_t i, const unsigned int c) {
              const double of_cells = side.force[side.force_place[i] + n * in_sweep(c)];
              return has_more ? of_cells + nodal_force(side.surface->points()[i], c)
                              : of_cells;
            });
      for (const Side &side : sides)
        if (side.surface)
          side.surface->finish(u, w);
      for (const auto &side : lateral)
        {
          // The sweep has advanced these nodes without surface forces.
          side->start_from_motion(n_done, time, w, parameters.dt);
          side->finish(u, w);
        }
    }
  op.set_copies(u);
  op.set_copies(w);
}

/**
 * Nodal forces other than cell forces: weight and damping that the sweep does not include
 * (N).
 */
double BrickStepper::nodal_force(const unsigned int point, const unsigned int c) const
{
  const double of_mass =
    parameters.common_alpha() * w.row(c, 0)[point] - parameters.acceleration[c];
  return of_mass * op.lumped_mass()[point] +
         (by_phase ? by_phase->force().row(c, 0)[point] : 0.);
}

/** The sweep omits these forces; the motion is linear in them. */
void BrickStepper::damp_by_phase()
{
  const double c_new = parameters.dt * (parameters.beta2 + 0.5);
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      {
        double force = by_phase->force().row(c, 0)[i];
        if (!parameters.alpha_of_phases.empty()) // the sweep has no weight in this case
          force -= op.lumped_mass()[i] * parameters.acceleration[c];
        const double by = -parameters.dt * mobility.row(c, 0)[i] * force;
        w.row(c, 0)[i] += by;
        u.row(c, 0)[i] += c_new * by;
      }
}

void BrickStepper::multiply(NodalField<double> &Kx, NodalField<double> &x) const
{
  op.multiply(Kx, x);
}

double BrickStepper::elastic_energy() const
{
  NodalField<double> Ku = u.zeros_alike();
  op.multiply(Ku, u);
  double sum = 0.;
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int i = 0; i < n_distinct; ++i)
      sum += u.row(c, 0)[i] * Ku.row(c, 0)[i];
  return 0.5 * sum;
}

void BrickStepper::mass_row(const unsigned int, double *mass) const
{
  std::copy(op.lumped_mass().begin(), op.lumped_mass().end(), mass);
}

Deformation BrickStepper::deformation() const
{
  return largest_deformation(op.slab(), u, communicator);
}

std::string BrickStepper::kernel_name() const
{
  return op.kernel_name();
}
} // namespace mesoslip
