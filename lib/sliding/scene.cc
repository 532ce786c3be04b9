#include "sliding/scene.h"

#include "base/errors.h"
#include "exchange/rve_file.h"
#include "material/stiffness.h"
#include "parameters/parameters.h"
#include "sliding/transient/run_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mesoslip
{
namespace
{
std::string size_text(const std::array<unsigned int, 2> &cells)
{
  return std::to_string(cells[0]) + " x " + std::to_string(cells[1]);
}

VoigtMatrix<2> typed_stiffness(const std::vector<double> &d)
{
  VoigtMatrix<2> D;
  if (d.size() == 4)
    D << d[0], d[1], 0., d[1], d[2], 0., 0., 0., d[3];
  else
    D << d[0], d[1], d[2], d[1], d[3], d[4], d[2], d[4], d[5];
  try
    {
      check_stiffness<2>(D);
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError("Body/Stiffness is " + to_text(d) + ": " + e.what() +
                      "; D11 D22 has to be larger than D12^2, and D33 positive");
    }
  return D;
}

UniformGrid<2> make_grid(const BodyParameters &body, const UniformGrid<2> *rve)
{
  UniformGrid<2> grid;
  std::array<double, 2> size = body.size;
  grid.cells                 = body.cells;
  if (size[0] == 0.)
    size = rve != nullptr ? std::array<double, 2>{{rve->extent(0), rve->extent(1)}}
                          : std::array<double, 2>{{56e-3, 16e-3}};
  if (grid.cells[0] == 0)
    grid.cells = rve != nullptr ? rve->cells : std::array<unsigned int, 2>{{560, 160}};
  for (unsigned int d = 0; d < 2; ++d)
    grid.spacing[d] = size[d] / grid.cells[d];
  if (rve != nullptr)
    for (unsigned int d = 0; d < 2; ++d)
      if (!(std::fabs(size[d] - rve->extent(d)) <= 1e-9 * rve->extent(d)))
        throw UserError("Body/Size is " + to_text(size[0]) + " x " + to_text(size[1]) +
                        " m, but the volume in " + body.rve_file + " measures " +
                        to_text(rve->extent(0)) + " x " + to_text(rve->extent(1)) +
                        " m; leave Size empty to take it from there");
  return grid;
}

// Each cell of the body lies in one cell of the RVE.
std::vector<std::uint8_t>
refine(const RveFile &rve, const UniformGrid<2> &grid, const std::string &file)
{
  const UniformGrid<2> &coarse = rve.grid();
  for (unsigned int d = 0; d < 2; ++d)
    if (grid.cells[d] % coarse.cells[d] != 0)
      throw UserError("Body/Cells: " + size_text(grid.cells) + " is no multiple of the " +
                      size_text(coarse.cells) + " cells of " + file +
                      ", whose morphology a heterogeneous body takes");
  const std::vector<std::uint8_t> coarse_id = rve.phase_id();
  std::vector<std::uint8_t> id(grid.n_cells());
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const std::size_t ci = i / (grid.cells[0] / coarse.cells[0]);
        const std::size_t cj = j / (grid.cells[1] / coarse.cells[1]);
        id[static_cast<std::size_t>(j) * grid.cells[0] + i] =
          coarse_id[cj * coarse.cells[0] + ci];
      }
  return id;
}

Phase<2> effective_phase(const RveFile &rve, const std::string &name)
{
  Phase<2> phase;
  phase.name      = "effective";
  phase.stiffness = rve.stiffness(name);
  phase.density   = rve.mean_density();
  return phase;
}

std::vector<double> bottom_friction(const Scene &scene,
                                    const FrictionParameters &friction)
{
  std::vector<double> mu(scene.grid.cells[0], friction.coefficient);
  if (friction.coefficient_by_phase)
    {
      if (scene.phase_id.empty())
        throw UserError(
          "Friction/Coefficient from is 'phases', but the body is homogeneous; use "
          "'constant' (analysis 'friction homogenization' gives the coefficient)");
      for (unsigned int i = 0; i < scene.grid.cells[0]; ++i)
        mu[i] = scene.phases[scene.phase_id[i]].friction_coefficient;
    }
  return mu;
}

std::vector<double> bottom_stiffness(const Scene &scene)
{
  std::vector<double> D22(scene.grid.cells[0]);
  for (unsigned int i = 0; i < scene.grid.cells[0]; ++i)
    D22[i] = scene.phases[scene.phase_id.empty() ? 0 : scene.phase_id[i]].stiffness(1, 1);
  return D22;
}
} // namespace

std::vector<double>
friction_of_nodes(const std::vector<double> &friction_of_bottom_cells,
                  const std::vector<double> &stiffness_of_bottom_cells,
                  const std::string &rule,
                  const bool periodic)
{
  const std::vector<double> &mu = friction_of_bottom_cells,
                            &D  = stiffness_of_bottom_cells;
  const std::size_t n           = mu.size();
  std::vector<double> nodes(n + 1);
  for (std::size_t i = 0; i <= n; ++i)
    {
      const std::size_t left  = i > 0 ? i - 1 : (periodic ? n - 1 : 0);
      const std::size_t right = i < n ? i : (periodic ? 0 : n - 1);
      if (rule == "stiffness")
        nodes[i] = (D[left] * mu[left] + D[right] * mu[right]) / (D[left] + D[right]);
      else
        nodes[i] = rule == "mean"      ? 0.5 * (mu[left] + mu[right])
                   : rule == "largest" ? std::max(mu[left], mu[right])
                                       : std::min(mu[left], mu[right]);
    }
  return nodes;
}

UniformMaterial Scene::make_material(const bool periodic) const
{
  std::vector<ElasticPhase<2>> classes;
  for (const Phase<2> &phase : phases)
    classes.push_back({phase.stiffness, phase.density});
  try
    {
      return UniformMaterial(grid, classes, phase_id, {periodic, false});
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Body: ") + e.what());
    }
}

std::vector<double> Scene::surface_fractions() const
{
  std::vector<double> fractions(phases.size(), 0.);
  for (unsigned int i = 0; i < grid.cells[0]; ++i)
    fractions[phase_id.empty() ? 0 : phase_id[i]] += 1. / grid.cells[0];
  return fractions;
}

Scene make_scene(const ContactParameters &parameters)
{
  const BodyParameters &body = parameters.body;
  Scene scene;
  if (body.rve_file.empty())
    {
      scene.grid = make_grid(body, nullptr);
      require_memory(field_memory(parameters.analysis, scene.grid));
      Phase<2> phase;
      phase.name      = "typed in";
      phase.stiffness = typed_stiffness(body.stiffness);
      phase.density   = body.density;
      scene.phases    = {phase};
    }
  else
    {
      const RveFile rve = RveFile::open(body.rve_file);
      scene.rve_digest  = rve.digest();
      if (!rve.change_note().empty())
        scene.warnings.push_back(rve.change_note());
      scene.grid = make_grid(body, &rve.grid());
      require_memory(field_memory(parameters.analysis, scene.grid));
      for (const Phase<2> &phase : rve.phases())
        if (!(phase.density > 0.))
          throw UserError(body.rve_file + ": phase '" + phase.name +
                          "' has no density; set Phases/" + phase.name +
                          "/Density and run rve_homogenization again");
      if (body.heterogeneous)
        {
          scene.phases   = rve.phases();
          scene.phase_id = refine(rve, scene.grid, body.rve_file);
        }
      else
        scene.phases = {effective_phase(rve, body.stiffness_name)};
    }
  scene.node_friction = friction_of_nodes(
    bottom_friction(scene, parameters.friction), bottom_stiffness(scene),
    parameters.friction.node_rule, parameters.periodic);
  return scene;
}
} // namespace mesoslip
