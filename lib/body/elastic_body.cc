#include "body/elastic_body.h"

#include "base/exchange.h"
#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"

namespace mesoslip
{
/** Of the values (component, node) at the nodes of side @p id. */
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
void ElasticBody<dim>::add_duplicates(NodalField<double> &field) const
{
  for (const auto &[duplicate, original] : duplicates)
    for (unsigned int c = 0; c < dim; ++c)
      field(c, duplicate) = field(c, original) = field(c, original) + field(c, duplicate);
}

template <int dim>
void ElasticBody<dim>::copy_duplicates(NodalField<double> &field) const
{
  for (const auto &[duplicate, original] : duplicates)
    for (unsigned int c = 0; c < dim; ++c)
      field(c, duplicate) = field(c, original);
}

template <int dim>
void ElasticBody<dim>::copy_duplicates(DofMask &mask) const
{
  for (const auto &[duplicate, original] : duplicates)
    for (unsigned int c = 0; c < dim; ++c)
      if (mask.is_constrained(c, original))
        mask.constrain(c, duplicate);
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

template class ElasticBody<2>;
template class ElasticBody<3>;
template std::vector<double> phase_volumes(const ElasticBody<2> &);
template std::vector<double> phase_volumes(const ElasticBody<3> &);
} // namespace mesoslip
