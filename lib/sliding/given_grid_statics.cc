#include "body/grid_body.h"
#include "eigenvalues/free_dofs.h"
#include "material/shear_impedance.h"
#include "sliding/given_grid.h"
#include "sliding/supports/side_platen.h"

namespace mesoslip
{
// Fields are replicated in any case.
void GivenGrid::make_elastic(const MPI_Comm communicator, const bool /*whole*/)
{
  of_statics = mesoslip::make_body(material, parameters.static_solver, communicator);
  of_statics->stand_on(foundation());
}

const ElasticBody<2> &GivenGrid::elastic() const
{
  return *of_statics;
}

DampingByPhase GivenGrid::make_damping(const StepParameters &step,
                                       const MPI_Comm communicator) const
{
  const UniformMaterial of_phases =
    material.with_phases(phases_of_damping(material.phases(), step));
  const auto damped =
    mesoslip::make_body(of_phases, parameters.static_solver, communicator);
  return {whole_stiffness(*damped, communicator), damped->lumped_mass()};
}

DofMask GivenGrid::held(const TopSetup &top, const bool contact_held) const
{
  DofMask held = held_by_supports(material, parameters.sides, top, contact_held);
  const std::vector<SideSupport> sides  = parameters.loaded_sides();
  const std::vector<SupportNodes> nodes = side_nodes();
  for (std::size_t k = 0; k < sides.size() && sides[k].is_platen; ++k)
    for (const NodeIndex &node : nodes[k].nodes)
      for (unsigned int c = 0; c < 2; ++c)
        held.constrain(c, node);
  return held;
}

std::size_t GivenGrid::n_free(const TopSetup &top, const bool contact_held) const
{
  return FreeDofs<2>(GridBody<2>(material), held(top, contact_held), {}).size();
}

SupportNodes GivenGrid::top_nodes() const
{
  SupportNodes top;
  for (unsigned int i = 0; i < material.n_columns(); ++i)
    {
      top.nodes.push_back({i, body.grid.cells[1]});
      top.carried.area.push_back(tributary_width(body.grid, i, parameters.periodic));
      top.carried.position[0].push_back(body.grid.origin[0] + i * body.grid.spacing[0]);
      top.carried.position[1].push_back(place_of_row(body.grid.cells[1]));
    }
  if (parameters.top.suspension.absorbing)
    top.carried.impedance = top_impedance();
  return top;
}

std::vector<SupportNodes> GivenGrid::side_nodes() const
{
  std::vector<SupportNodes> sides;
  for (const SideSupport &side : parameters.loaded_sides())
    {
      const SideNodes column = column_of(side);
      const unsigned int i   = side.name == "Left" ? 0 : material.n_columns() - 1;
      SupportNodes &found    = sides.emplace_back();
      std::vector<unsigned int> rows;
      for (unsigned int j = 0; j < material.n_rows(); ++j)
        if (column.area[j] > 0.)
          {
            rows.push_back(j);
            found.nodes.push_back({i, j});
          }
      found.carried = column.at(rows);
    }
  return sides;
}

/** Nodes of a side, one per row. */
SideNodes GivenGrid::column_of(const SideSupport &side) const
{
  const unsigned int n = body.grid.cells[1], m = body.grid.cells[0];
  const double half = 0.5 * body.grid.spacing[1];
  const bool left   = side.name == "Left";
  SideNodes nodes;
  nodes.impedance.resize(side.suspension.absorbing ? 4 : 0);
  std::vector<Eigen::Matrix2d> of_phase;
  for (const Phase<2> &phase : body.phases)
    of_phase.push_back(
      impedance<2>(phase.stiffness, phase.density, Eigen::Vector2d::UnitX()));
  for (unsigned int j = 0; j <= n; ++j)
    {
      const double below = j > 0 ? half : 0., above = j < n ? half : 0.,
                   area = below + above;
      nodes.area.push_back(area);
      nodes.position[0].push_back(body.grid.origin[0] +
                                  (left ? 0. : body.grid.extent(0)));
      nodes.position[1].push_back(place_of_row(j));
      nodes.push[0].push_back(left ? area : -area);
      const auto behind = [&](const unsigned int row) {
        return of_phase[body.phase_of(std::size_t{m} * row + (left ? 0 : m - 1))];
      };
      const Eigen::Matrix2d Z =
        (below * behind(j > 0 ? j - 1 : 0) + above * behind(j < n ? j : n - 1)) / area;
      for (unsigned int k = 0; k < nodes.impedance.size(); ++k)
        nodes.impedance[k].push_back(Z(k / 2, k % 2));
    }
  if (side.is_platen)
    {
      std::vector<bool> own(n + 1, true);
      own.front() = own.back() = false; // belong to contact and top
      carry_whole_side(nodes, own, side);
    }
  return nodes;
}

/** Nodes have the mean of the adjacent cells, which have the same area. */
std::vector<std::vector<double>> GivenGrid::top_impedance() const
{
  const unsigned int n    = body.grid.cells[0];
  const std::size_t first = std::size_t{n} * (body.grid.cells[1] - 1);
  std::vector<Eigen::Matrix2d> of_phase;
  for (const Phase<2> &phase : body.phases)
    of_phase.push_back(impedance<2>(phase.stiffness, phase.density));
  std::vector<std::vector<double>> result(4);
  for (unsigned int i = 0; i <= n; ++i)
    {
      const unsigned int left  = i > 0 ? i - 1 : (parameters.periodic ? n - 1 : 0),
                         right = i < n ? i : (parameters.periodic ? 0 : n - 1);
      const Eigen::Matrix2d Z  = 0.5 * (of_phase[body.phase_of(first + left)] +
                                       of_phase[body.phase_of(first + right)]);
      for (unsigned int k = 0; k < 4; ++k)
        result[k].push_back(Z(k / 2, k % 2));
    }
  return result;
}

NodalField<double> GivenGrid::compressed(const double strain) const
{
  const unsigned int n = material.n_columns(), top = body.grid.cells[1];
  const DofMask held = this->held(parameters.top, false);
  const bool platen  = parameters.top.is_platen; // a platen holds its nodes
  NodalField<double> u(n, top + 1);
  for (unsigned int j = 0; j <= top; ++j)
    for (unsigned int i = 0; i < n; ++i)
      if (!held.is_constrained(1, {i, j}) || (j == top && platen))
        u.row(1, j)[i] = -strain * j * body.grid.spacing[1];
  return u;
}

std::vector<ContactCell> GivenGrid::contact_cells(const NodalField<double> &u) const
{
  const unsigned int n = body.grid.cells[0];
  std::vector<double> exx(n), eyy(n), gxy(n);
  UniformGridOperator(material).strain(u, 0, exx.data(), eyy.data(), gxy.data());
  std::vector<ContactCell> cells;
  for (unsigned int i = 0; i < n; ++i)
    {
      const auto phase        = static_cast<unsigned int>(body.phase_of(i));
      const VoigtMatrix<2> &D = body.phases[phase].stiffness;
      const double pressure   = -(D(1, 0) * exx[i] + D(1, 1) * eyy[i] + D(1, 2) * gxy[i]);
      cells.push_back({phase, body.grid.spacing[0], pressure});
    }
  return cells;
}

std::vector<std::vector<double>> GivenGrid::contact_places() const
{
  return {known.contact_place[0]};
}

ContactParts GivenGrid::contact_parts() const
{
  // A node has half of each adjacent cell, a node at the end of the body one half cell.
  const std::size_t n = body.grid.cells[0];
  const bool periodic = parameters.periodic;
  ContactParts parts;
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    {
      parts.names.push_back(body.phases[p].name);
      std::vector<double> &shares = parts.shares.emplace_back();
      const auto has              = [&](const std::size_t cell) {
        return body.phase_of(cell) == p ? 0.5 : 0.;
      };
      for (std::size_t i = 0; i <= n; ++i)
        shares.push_back(has(i > 0 ? i - 1 : (periodic ? n - 1 : 0)) +
                         has(i < n ? i : (periodic ? 0 : n - 1)));
    }
  return parts;
}

Deformation GivenGrid::deformation(const NodalField<double> &u) const
{
  return largest_deformation(body.grid, NodeRows::all(u.n_rows()), u, MPI_COMM_SELF);
}
} // namespace mesoslip
