#include "base/errors.h"
#include "base/files.h"
#include "exchange/rve_file.h"
#include "grid/uniform_grid.h"
#include "material/stiffness.h"
#include "sliding/body_analysis.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** The phase of Body/Stiffness and Density. */
Phase<2> given_phase(const BodyParameters &body)
{
  try
    {
      return {"typed in", stiffness_from_coefficients<2>(body.stiffness), body.density,
              0.};
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError("Body/Stiffness is " + to_text(body.stiffness) + ": " + e.what() +
                      "; D11 D22 has to be larger than D12^2, and D33 positive");
    }
}

/** A body that is not the @p volume of its RVE file has to be homogeneous and larger. */
void check_size(const BodyParameters &body, const std::array<double, 2> &volume)
{
  bool equal = true, smaller = false;
  for (unsigned int d = 0; d < 2; ++d)
    {
      equal   = equal && std::fabs(body.size[d] - volume[d]) <= 1e-9 * volume[d];
      smaller = smaller || body.size[d] < (1. - 1e-9) * volume[d];
    }
  const std::string sizes = "Body/Size is " + to_text(body.size[0]) + " x " +
                            to_text(body.size[1]) + " m, but the volume in " +
                            body.rve_file + " measures " + to_text(volume[0]) + " x " +
                            to_text(volume[1]) + " m; ";
  if (!equal && (smaller || body.heterogeneous))
    throw UserError(sizes + "leave Size empty to take it from there" +
                    (smaller ? "" : ", a homogeneous body may be larger"));
  if (!equal && body.cells[0] == 0)
    throw UserError(sizes + "leave Size empty to take it from there, or set Body/Cells "
                            "to the numbers of cells of the larger body");
}

/** @p rve: null without a file. */
UniformGrid<2> make_grid(const BodyParameters &body, const RveFile<2> *rve)
{
  UniformGrid<2> grid;
  std::array<double, 2> size = {{56e-3, 16e-3}};
  grid.cells                 = {{560, 160}};
  if (rve != nullptr)
    {
      size       = {{rve->grid.extent(0), rve->grid.extent(1)}};
      grid.cells = rve->grid.cells;
    }
  if (rve != nullptr && body.size[0] > 0.)
    check_size(body, size);
  if (body.size[0] > 0.)
    size = body.size;
  if (body.cells[0] > 0)
    grid.cells = body.cells;
  else if (rve != nullptr && rve->is_mesh())
    throw UserError("Body/Cells is empty, and " + body.rve_file +
                    " holds a mesh, which has no rows and columns; set Body/Cells to the "
                    "numbers of cells of the body along x and y");
  for (unsigned int d = 0; d < 2; ++d)
    grid.spacing[d] = size[d] / grid.cells[d];
  return grid;
}

/** Phases of the cells of @p grid, each of which lies in one cell of the RVE. */
std::vector<std::uint8_t>
refine(const RveFile<2> &rve, const UniformGrid<2> &grid, const std::string &file)
{
  rve.require_grid("a heterogeneous body on a grid takes nothing");
  const std::array<unsigned int, 2> coarse = rve.grid.cells, fine = grid.cells;
  if (fine[0] % coarse[0] != 0 || fine[1] % coarse[1] != 0)
    throw UserError("Body/Cells: " + numbers_text(fine[0], fine[1]) +
                    " is no multiple of the " + numbers_text(coarse[0], coarse[1]) +
                    " cells of " + file +
                    ", whose morphology a heterogeneous body takes");
  const std::vector<std::uint8_t> coarse_id = rve.phase_id();
  std::vector<std::uint8_t> id;
  for (std::size_t j = 0; j < fine[1]; ++j)
    for (std::size_t i = 0; i < fine[0]; ++i)
      id.push_back(
        coarse_id[j / (fine[1] / coarse[1]) * coarse[0] + i / (fine[0] / coarse[0])]);
  return id;
}

void read_materials(const BodyParameters &given,
                    const RveFile<2> &rve,
                    BodyDescription &body)
{
  body.rve_digest = rve.digest;
  if (!rve.change_note().empty())
    body.warnings.push_back(rve.change_note());
  for (const Phase<2> &phase : rve.phases)
    if (!(phase.density > 0.))
      throw UserError(given.rve_file + ": phase '" + phase.name +
                      "' has no density; set Phases/" + phase.name +
                      "/Density and run rve_homogenization again");
  if (!given.heterogeneous)
    {
      body.phases = {
        {"effective", rve.stiffness(given.stiffness_name), rve.mean_density(), 0.}};
      return;
    }
  body.phases   = rve.phases;
  body.phase_id = refine(rve, body.grid, given.rve_file);
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

UniformMaterial make_material(const BodyDescription &body, const bool periodic)
{
  std::vector<ElasticPhase<2>> classes;
  for (const Phase<2> &phase : body.phases)
    classes.push_back({phase.stiffness, phase.density});
  try
    {
      return UniformMaterial(body.grid, classes, body.phase_id, {periodic, false});
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Body: ") + e.what());
    }
}

DofMask held_by_supports(const UniformMaterial &material,
                         const SideConstraints &sides,
                         const TopSetup &top)
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
      if (top.kind != TopSetup::Kind::pressure || (c == 0 && top.lateral_held))
        held.constrain_row(c, last_row);
    }
  return held;
}

BodyDescription make_body(const ContactParameters &parameters)
{
  const BodyParameters &given = parameters.body;
  BodyDescription body;
  std::optional<RveFile<2>> rve;
  if (!given.rve_file.empty())
    {
      require_readable_file("Body/RVE file: ", given.rve_file,
                            "run rve_homogenization first");
      rve.emplace(given.rve_file);
    }
  body.grid = make_grid(given, rve ? &*rve : nullptr);
  require_memory(field_memory(parameters.analysis, body.grid));
  if (rve)
    read_materials(given, *rve, body);
  else
    body.phases = {given_phase(given)};
  body.node_friction = friction_of_nodes(body, parameters.friction, parameters.periodic);
  return body;
}
} // namespace mesoslip
