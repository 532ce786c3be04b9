#include "body/elastic_body.h"

#include "base/exchange.h"
#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"

namespace mesoslip
{
/** Gathers value(component, node) at the nodes of side @p id on all ranks. */
template <int dim>
template <typename Value>
std::vector<double> ElasticBody<dim>::gather(const unsigned int id,
                                             const Value &value) const
{
  const SurfaceNodes<dim> &side = sides[id];
  std::vector<double> values(dim * side.normal_area.size(), 0.);
  for (std::size_t k = 0; k < side.nodes.size(); ++k)
    for (unsigned int c = 0; c < dim && is_counted(side.nodes[k]); ++c)
      values[dim * side.place(k) + c] = value(c, side.nodes[k]);
  sum_over_ranks(values, sharing);
  return values;
}

template <int dim>
std::vector<double>
ElasticBody<dim>::surface_values(const unsigned int id,
                                 const NodalField<double> &field) const
{
  return gather(
    id, [&field](const unsigned int c, const NodeIndex &node) { return field(c, node); });
}

template <int dim>
std::vector<double> ElasticBody<dim>::surface_values(const unsigned int id,
                                                     const DofMask &mask) const
{
  return gather(id, [&mask](const unsigned int c, const NodeIndex &node) {
    return mask.is_constrained(c, node) ? 1. : 0.;
  });
}

template <int dim>
void ElasticBody<dim>::stand_on(const Foundation &given)
{
  under         = given;
  is_on_springs = mpi::max(under.springs.empty() ? 0 : 1, sharing) > 0;
  extra.clear();
  if (mpi::max(under.masses.empty() ? 0 : 1, sharing) == 0)
    return;
  NodalField<double> field = zero_field();
  double counted           = 0.;
  for (const auto &[node, of_node] : under.masses)
    {
      field(0, node) += of_node;
      counted += is_counted(node) ? of_node : 0.;
    }
  mass += mpi::sum(counted, sharing);
  update_copies(field);
  for (unsigned int j = 0; j < rows; ++j)
    extra.insert(extra.end(), field.row(0, j), field.row(0, j) + columns);
}

template <int dim>
std::vector<double> ElasticBody<dim>::lumped_mass() const
{
  std::vector<double> masses = mass_of_cells();
  for (std::size_t k = 0; k < extra.size(); ++k)
    masses[k] += extra[k];
  return masses;
}

template <int dim>
void ElasticBody<dim>::vmult(NodalField<double> &Ku, const NodalField<double> &u) const
{
  multiply(Ku, u);
  if (!is_on_springs)
    return;
  for (const SpringEntry &spring : under.springs)
    Ku(spring.c, spring.node) += spring.stiffness * u(spring.d, spring.node);
  update_copies(Ku);
}

template <int dim>
std::vector<bool> ElasticBody<dim>::counted_masters() const
{
  std::vector<bool> counted(static_cast<std::size_t>(columns) * rows, false);
  std::fill_n(counted.begin(), n_counted, true);
  for (const auto &[copy, master] : copies)
    counted[index(copy)] = false;
  return counted;
}

template <int dim>
void ElasticBody<dim>::add_copies(NodalField<double> &field) const
{
  for (const auto &[copy, master] : copies)
    for (unsigned int c = 0; c < dim; ++c)
      field(c, copy) = field(c, master) = field(c, master) + field(c, copy);
}

template <int dim>
void ElasticBody<dim>::update_copies(NodalField<double> &field) const
{
  for (const auto &[copy, master] : copies)
    for (unsigned int c = 0; c < dim; ++c)
      field(c, copy) = field(c, master);
}

template <int dim>
void ElasticBody<dim>::update_copies(DofMask &mask) const
{
  for (const auto &[copy, master] : copies)
    for (unsigned int c = 0; c < dim; ++c)
      if (mask.is_constrained(c, master))
        mask.constrain(c, copy);
}

template <int dim>
std::vector<double> phase_volumes(const ElasticBody<dim> &body)
{
  std::vector<double> volumes(body.phases().size(), 0.);
  const NodalField<double> zero = body.zero_field();
  typename ElasticBody<dim>::Cells cells;
  for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
    {
      body.evaluate(zero, group, cells);
      for (std::size_t k = 0; k < cells.phase.size(); ++k)
        volumes[cells.phase[k]] += cells.volume[k];
    }
  return volumes;
}

std::unique_ptr<ElasticBody<2>> make_body(const UniformMaterial &material,
                                          const StaticSolverKind solver,
                                          const MPI_Comm communicator)
{
  if (solver == StaticSolverKind::ml)
    return std::make_unique<MeshBody<2>>(mesh_of_grid(material), communicator);
  return std::make_unique<GridBody<2>>(material, solver);
}

std::vector<SpringEntry> with_foundation(const Foundation &foundation,
                                         const std::vector<SpringEntry> &springs)
{
  std::vector<SpringEntry> all = foundation.springs;
  all.insert(all.end(), springs.begin(), springs.end());
  return all;
}

template class ElasticBody<2>;
template class ElasticBody<3>;
template std::vector<double> phase_volumes(const ElasticBody<2> &);
template std::vector<double> phase_volumes(const ElasticBody<3> &);
} // namespace mesoslip
