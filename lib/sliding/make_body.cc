#include "base/errors.h"
#include "base/files.h"
#include "exchange/rve_file.h"
#include "grid/uniform_grid.h"
#include "material/stiffness.h"
#include "sliding/body_grid.h"
#include "sliding/given_grid.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
void read_materials(const BodyParameters &given,
                    const RveFile<2> &rve,
                    BodyDescription &body)
{
  body.rve_digest  = rve.digest;
  body.rve_content = rve.content();
  if (!rve.change_note().empty())
    body.warnings.push_back(rve.change_note());
  require_densities(rve);
  if (!given.heterogeneous)
    {
      body.phases = {
        {"effective", rve.stiffness(given.stiffness_name), rve.mean_density(), 0.}};
      return;
    }
  body.phases = rve.phases;
  for (const std::uint16_t id :
       constituents_in(given.section, rve, body.grid, whole_block(body.grid)))
    body.phase_id.push_back(static_cast<std::uint8_t>(rve.materials.phase_of(id)));
}

std::vector<double> friction_of_nodes(const BodyDescription &body,
                                      const FrictionParameters &friction,
                                      const bool periodic)
{
  if (friction.coefficient_by_phase && body.phase_id.empty())
    throw UserError(
      "Friction/Coefficient from is 'phases', but the body is homogeneous; use "
      "'constant' (analysis 'friction homogenization' gives the coefficient)");
  const std::size_t n = body.grid.cells[0];
  std::vector<double> nodes(n + 1);
  for (std::size_t i = 0; i <= n; ++i)
    {
      const Phase<2> &left =
        body.phases[body.phase_of(i > 0 ? i - 1 : (periodic ? n - 1 : 0))];
      const Phase<2> &right =
        body.phases[body.phase_of(i < n ? i : (periodic ? 0 : n - 1))];
      const bool by_phase = friction.coefficient_by_phase;
      const double a      = by_phase ? left.friction_coefficient : friction.coefficient,
                   b      = by_phase ? right.friction_coefficient : friction.coefficient,
                   A = left.stiffness(1, 1), B = right.stiffness(1, 1);
      nodes[i] = friction.node_rule == "stiffness" ? (A * a + B * b) / (A + B)
                 : friction.node_rule == "mean"    ? 0.5 * (a + b)
                 : friction.node_rule == "largest" ? std::max(a, b)
                                                   : std::min(a, b);
    }
  return nodes;
}
} // namespace

UniformMaterial make_material(const BodyDescription &body,
                              const MeanDilatation choice,
                              const bool periodic)
{
  try
    {
      return UniformMaterial(body.grid, elastic_phases<2>(body.phases, choice),
                             body.phase_id, {periodic, false});
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Body: ") + e.what());
    }
}

DofMask held_by_supports(const UniformMaterial &material,
                         const SideConstraints &sides,
                         const TopSetup &top,
                         const bool bottom_held)
{
  const unsigned int last_column = material.n_columns() - 1,
                     last_row    = material.n_rows() - 1;
  DofMask held(last_column + 1, last_row + 1);
  for (unsigned int c = 0; c < 2; ++c)
    {
      if (sides.left_held[c])
        held.constrain_column(c, 0);
      if (sides.right_held[c])
        held.constrain_column(c, last_column);
      if (top.is_fixed(c, 2))
        held.constrain_row(c, last_row);
    }
  if (bottom_held)
    held.constrain_row(1, 0);
  return held;
}

BodyDescription make_body(const ContactParameters &parameters,
                          const unsigned int n_copies)
{
  const BodyParameters &given = parameters.body;
  BodyDescription body;
  std::optional<RveFile<2>> rve;
  if (!given.rve_file.empty())
    {
      require_readable_file(given.section + "/RVE file: ", given.rve_file,
                            "run rve_homogenization first, or mend the name");
      rve.emplace(given.rve_file);
    }
  body.grid          = make_grid<2>(given, rve ? &*rve : nullptr);
  const double bytes = n_copies * field_memory(parameters, body.grid);
  require_memory(
    {bytes, cells_that_fit({body.grid.cells.begin(), body.grid.cells.end()}, bytes) +
              "; reduce Body/Cells"});
  if (rve)
    read_materials(given, *rve, body);
  else
    body.phases = {given_phase<2>(given)};
  body.node_friction = friction_of_nodes(body, parameters.friction, parameters.periodic);
  return body;
}
} // namespace mesoslip
