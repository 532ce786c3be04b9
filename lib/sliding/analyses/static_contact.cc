#include "sliding/analyses/static_contact.h"

#include "base/errors.h"
#include "elasticity/uniform_grid_operator.h"
#include "material/engineering_constants.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mesoslip
{
namespace
{
int sliding_direction(const ContactParameters &parameters)
{
  const double v = parameters.contact.flat_velocity.amplitude();
  return v > 0. ? 1 : (v < 0. ? -1 : 0);
}

StaticContactProblem make_problem(const ContactParameters &parameters,
                                  const BodyDescription &body,
                                  const UniformMaterial &material)
{
  const unsigned int nx = material.n_columns(), top = material.n_rows() - 1;
  const double pressure = parameters.top.pressure.amplitude();
  StaticContactProblem problem;
  problem.constrained  = held_by_supports(material, parameters.sides, parameters.top);
  problem.displacement = NodalField<double>(nx, top + 1);
  problem.force        = NodalField<double>(nx, top + 1);
  problem.friction_coefficient = body.node_friction;
  problem.sliding              = sliding_direction(parameters);

  // Uniform compression as a first guess; under a platen its size does not matter, as the
  // solution is proportional to the displacement of the top.
  const double strain = pressure / body.phases[0].stiffness(1, 1);
  for (unsigned int j = 0; j <= top; ++j)
    for (unsigned int i = 0; i < nx; ++i)
      if (!problem.constrained.is_constrained(1, {i, j}) || j == top)
        problem.displacement.row(1, j)[i] = -strain * j * body.grid.spacing[1];
  if (parameters.top.kind == TopSetup::Kind::platen)
    return problem;

  std::vector<double> mass(nx);
  for (unsigned int j = 0; j <= top; ++j)
    {
      material.mass_row(j, mass.data());
      for (unsigned int i = 0; i < nx; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          problem.force.row(c, j)[i] = mass[i] * parameters.step.acceleration[c];
    }
  for (unsigned int i = 0; i < nx; ++i)
    problem.force.row(1, top)[i] -=
      pressure * tributary_width(body.grid, i, parameters.periodic);
  return problem;
}

double sum_of_nodes(const std::vector<double> &values, const bool periodic)
{
  return std::accumulate(values.begin(), values.end() - (periodic ? 1 : 0), 0.);
}

void scale(StaticContactSolution &solution, const double factor)
{
  NodalField<double> &u = solution.displacement;
  for (std::size_t k = 0; k < u.size(); ++k)
    u.begin()[k] *= factor;
  for (auto *forces : {&solution.normal_force, &solution.tangential_force})
    for (double &f : *forces)
      f *= factor;
}

std::vector<double> bottom_cell_pressures(const BodyDescription &body,
                                          const UniformMaterial &material,
                                          const NodalField<double> &u)
{
  const unsigned int nx = body.grid.cells[0];
  std::vector<double> exx(nx), eyy(nx), gxy(nx), pressure(nx);
  const UniformGridOperator stiffness(material);
  stiffness.strain(u, 0, exx.data(), eyy.data(), gxy.data());
  for (unsigned int i = 0; i < nx; ++i)
    {
      const auto &D = body.phases[body.phase_of(i)].stiffness;
      pressure[i]   = -(D(1, 0) * exx[i] + D(1, 1) * eyy[i] + D(1, 2) * gxy[i]);
    }
  return pressure;
}

PhasePressures pressures_of_phases(const ContactParameters &parameters,
                                   const BodyDescription &body,
                                   const StaticContactResult &result)
{
  const unsigned int nx = body.grid.cells[0];
  std::vector<double> sum(body.phases.size(), 0.);
  for (unsigned int i = 0; i < nx; ++i)
    sum[body.phase_of(i)] += result.cell_pressure[i] / nx;
  return phase_pressures<2>(parameters, body.phases, body.fractions(nx), sum,
                            result.normal_force / body.grid.extent(0));
}
} // namespace

void check_static_contact(const ContactParameters &parameters,
                          const BodyDescription &body)
{
  const auto require = [](const bool holds, const std::string &otherwise) {
    if (!holds)
      throw UserError(otherwise);
  };
  const TopSetup &top          = parameters.top;
  const SideConstraints &sides = parameters.sides;
  const auto [least, largest] =
    std::minmax_element(body.node_friction.begin(), body.node_friction.end());
  const bool platen = top.kind == TopSetup::Kind::platen,
             slides = sliding_direction(parameters) != 0,
             held_x = sides.left_held[0] || sides.right_held[0],
             held_y = sides.left_held[1] || sides.right_held[1],
             pulled = parameters.step.is_heavy();
  require(top.kind != TopSetup::Kind::held,
          "Top/Kind is held, so nothing presses the body on the flat; use platen or "
          "pressure for a static contact analysis");
  require(top.pressure.amplitude() > 0.,
          "Top/Pressure is " + to_text(top.pressure.amplitude()) +
            " Pa; a static contact analysis needs a positive one");
  require(parameters.contact.gap == 0.,
          "Flat/Gap is " + to_text(parameters.contact.gap) +
            " m; a static contact analysis starts from a body that touches the flat, "
            "set it to 0");
  require(
    !platen || !pulled,
    "Body/Acceleration is not zero, which a static contact analysis under a "
    "platen does not take; set it to 0, or Top/Kind = pressure, which loads each node "
    "by itself");
  require(top.holds_tangentially() || held_x || !(*largest > 0.) || !slides,
          "Nothing holds the body against the friction of the sliding flat: set "
          "Top/Lateral held, hold a side in u_x, use a platen, Friction/Coefficient = 0 "
          "or Flat/Velocity = 0");
  // The pressure's resultant acts in the middle, the reaction at most half the width from
  // there, and their moment has to hold that of the friction between the flat and the top.
  const double height = body.grid.extent(1), half = 0.5 * body.grid.extent(0);
  require(platen || !top.lateral_held || parameters.periodic || held_x || held_y ||
            !slides || pulled || !(*least * height > half),
          "Friction/Coefficient: the friction of the sliding flat tips the body, as a "
          "coefficient of " +
            to_text(*least) + " times the height of " + to_text(height) +
            " m is more than half the width, " + to_text(half) +
            " m: there is no equilibrium; reduce it, or set Top/Kind = platen");
}

StaticContactResult compute_static_contact(const ContactParameters &parameters,
                                           const BodyDescription &body,
                                           const UniformMaterial &material,
                                           const StaticContactOptions &options,
                                           const MPI_Comm communicator)
{
  StaticContactResult result;
  const auto elastic = make_body(material, parameters.static_solver, communicator);
  result.solution =
    solve_static_contact(*elastic, make_problem(parameters, body, material), options);

  const double pressure = parameters.top.pressure.amplitude();
  if (parameters.top.kind == TopSetup::Kind::platen)
    scale(result.solution,
          pressure * body.grid.extent(0) /
            sum_of_nodes(result.solution.normal_force, parameters.periodic));

  result.normal_force = sum_of_nodes(result.solution.normal_force, parameters.periodic);
  result.tangential_force =
    sum_of_nodes(result.solution.tangential_force, parameters.periodic);
  for (unsigned int i = 0; i <= body.grid.cells[0]; ++i)
    {
      const double width = tributary_width(body.grid, i, parameters.periodic);
      result.node_pressure.push_back(result.solution.normal_force[i] / width);
      result.node_shear.push_back(result.solution.tangential_force[i] / width);
    }
  result.cell_pressure =
    bottom_cell_pressures(body, material, result.solution.displacement);
  result.phases = pressures_of_phases(parameters, body, result);
  return result;
}
} // namespace mesoslip
