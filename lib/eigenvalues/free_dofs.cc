#include "eigenvalues/free_dofs.h"

#include "base/exchange.h"

namespace mesoslip
{
template <int dim>
FreeDofs<dim>::FreeDofs(const ElasticBody<dim> &body,
                        const DofMask &mask,
                        const std::optional<double> &platen_mass)
  : body(body)
  , of_platen_alone(platen_mass)
{
  const std::vector<bool> counted = body.counted_originals();
  const std::vector<double> mass  = body.lumped_mass();
  const auto index                = [&](const NodeIndex &node) {
    return static_cast<std::size_t>(node.j) * body.n_columns() + node.i;
  };
  const auto is_counted = [&](const NodeIndex &node) { return counted[index(node)]; };
  const auto mass_of    = [&](const NodeIndex &node) { return mass[index(node)]; };
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        if (is_counted({i, j}) && !mask.is_constrained(c, {i, j}))
          add(c, {i, j}, mass_of({i, j}));
  if (has_platen())
    {
      for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
        if (is_counted(node))
          platen_nodes.push_back(node);
      find_platen_rank();
      double moved = owns_platen() ? *platen_mass : 0.;
      for (const NodeIndex &node : platen_nodes)
        moved += mass_of(node);
      moved = mpi::sum(moved, body.communicator());
      if (owns_platen())
        add(dim - 1, platen_nodes.front(), moved);
    }
  partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(
    masses.size(), 0, body.communicator());
}

template <int dim>
double FreeDofs<dim>::of_platen(const Vector &x) const
{
  const double own = owns_platen() ? x.local_element(masses.size() - 1) : 0.;
  return mpi::broadcast(own, static_cast<int>(platen_rank), body.communicator());
}

template <int dim>
void FreeDofs<dim>::set_platen(Vector &x, const double value) const
{
  if (owns_platen())
    x.local_element(masses.size() - 1) = value;
}

template <int dim>
void FreeDofs<dim>::vmult(Vector &dst, const Vector &src) const
{
  for (std::size_t k = 0; k < masses.size(); ++k)
    dst.local_element(k) = masses[k] * src.local_element(k);
}

template <int dim>
std::array<double, dim> FreeDofs<dim>::sums(const Vector &x) const
{
  std::array<double, dim> result = {};
  for (std::size_t k = 0; k < masses.size(); ++k)
    result[components[k]] += x.local_element(k);
  for (double &sum : result)
    sum = mpi::sum(sum, body.communicator());
  return result;
}

template <int dim>
double FreeDofs<dim>::mass_product(const Vector &x, const Vector &y) const
{
  double sum = 0.;
  for (std::size_t k = 0; k < masses.size(); ++k)
    sum += masses[k] * x.local_element(k) * y.local_element(k);
  return mpi::sum(sum, body.communicator());
}

template <int dim>
void FreeDofs<dim>::scatter(NodalField<double> &field, const Vector &values) const
{
  field.set_zero();
  for (std::size_t k = 0; k < masses.size(); ++k)
    field(components[k], nodes[k]) = values.local_element(k);
  const double pushed = has_platen() ? of_platen(values) : 0.;
  for (const NodeIndex &node : platen_nodes)
    field(dim - 1, node) = pushed;
  body.copy_duplicates(field);
}

template <int dim>
void FreeDofs<dim>::gather(Vector &values, const NodalField<double> &field) const
{
  for (std::size_t k = 0; k < masses.size(); ++k)
    values.local_element(k) = field(components[k], nodes[k]);
}

template <int dim>
void FreeDofs<dim>::gather_forces(Vector &values, const NodalField<double> &field) const
{
  gather(values, field);
  if (!has_platen())
    return;
  double sum = 0.;
  for (const NodeIndex &node : platen_nodes)
    sum += field(dim - 1, node);
  set_platen(values, mpi::sum(sum, body.communicator()));
}

template <int dim>
bool FreeDofs<dim>::owns_platen() const
{
  return has_platen() && mpi::this_mpi_process(body.communicator()) == platen_rank;
}

template <int dim>
void FreeDofs<dim>::find_platen_rank()
{
  const unsigned int rank = mpi::this_mpi_process(body.communicator()),
                     none = mpi::n_mpi_processes(body.communicator());
  platen_rank = mpi::min(platen_nodes.empty() ? none : rank, body.communicator());
}

template <int dim>
void FreeDofs<dim>::add(const unsigned int c, const NodeIndex &node, const double mass)
{
  components.push_back(c);
  nodes.push_back(node);
  masses.push_back(mass);
}

template class FreeDofs<2>;
template class FreeDofs<3>;
} // namespace mesoslip
