#include "sliding/analyses/static_contact.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Traction of a node; faces that stand on the flat have no @p area. */
double traction(const double force, const double area)
{
  return force == 0. ? 0. : force / std::fabs(area);
}

template <int dim>
PhasePressures pressures_of_phases(const GivenBody<dim> &body,
                                   const std::vector<ContactCell> &cells,
                                   const double normal_force)
{
  const std::vector<Phase<dim>> &phases = body.facts().phases;
  std::vector<double> area(phases.size()), force(phases.size());
  double total = 0.;
  for (const ContactCell &cell : cells)
    {
      area[cell.phase] += cell.area;
      force[cell.phase] += cell.area * cell.pressure;
      total += cell.area;
    }
  for (std::size_t p = 0; p < area.size(); ++p)
    {
      area[p] /= total;
      force[p] /= total;
    }
  return phase_pressures<dim>(body.parameters, phases, area, force, normal_force / total);
}
} // namespace

template <int dim>
StaticContactResult<dim> compute_static_contact(const GivenBody<dim> &body,
                                                const StaticContactOptions &options)
{
  const BodySize &size = body.facts().size;
  StaticContactResult<dim> result;
  StaticLoad<dim> load(body, body.parameters, size.friction);
  result.solution     = load.follow(options);
  result.steps        = load.steps();
  const auto &forces  = result.solution.tangential_force;
  const std::size_t n = size.n_contact_nodes;
  result.normal_force = total_normal_force(result.solution, n);
  for (unsigned int c = 0; c + 1 < dim; ++c)
    result.tangential_force[c] = total_tangential_force(result.solution, n, c, dim - 1);
  for (std::size_t i = 0; i < result.solution.state.size(); ++i)
    {
      result.node_pressure.push_back(
        traction(result.solution.normal_force[i], size.area[i]));
      for (unsigned int c = 0; c + 1 < dim; ++c)
        result.node_shear[c].push_back(traction(forces[(dim - 1) * i + c], size.area[i]));
    }
  const std::vector<ContactCell> cells = body.contact_cells(result.solution.displacement);
  for (const ContactCell &cell : cells)
    result.cell_pressure.push_back(cell.pressure);
  if (!cells.empty())
    result.phases = pressures_of_phases(body, cells, result.normal_force);
  return result;
}

template StaticContactResult<2> compute_static_contact(const GivenBody<2> &,
                                                       const StaticContactOptions &);
template StaticContactResult<3> compute_static_contact(const GivenBody<3> &,
                                                       const StaticContactOptions &);
} // namespace mesoslip
