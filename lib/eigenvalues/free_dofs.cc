#include "eigenvalues/free_dofs.h"

#include "base/exchange.h"

namespace mesoslip
{
template <int dim>
FreeDofs<dim>::FreeDofs(const ElasticBody<dim> &body,
                        const DofMask &mask,
                        const std::optional<Platen> &platen)
  : body(body)
{
  const std::vector<bool> counted = body.counted_originals();
  const std::vector<double> mass  = body.lumped_mass();
  const auto index                = [&](const NodeIndex &node) {
    return static_cast<std::size_t>(node.j) * body.n_columns() + node.i;
  };
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        if (counted[index({i, j})] && !mask.is_constrained(c, {i, j}))
          add(c, {i, j}, mass[index({i, j})]);
  if (platen)
    {
      std::vector<double> of_nodes;
      for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
        if (counted[index(node)])
          {
            platen_nodes.push_back(node);
            of_nodes.push_back(mass[index(node)]);
          }
      add_platen(*platen, of_nodes);
    }
  partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(
    masses.size(), 0, body.communicator());
}

/** @p mass: of its nodes (kg, in 2D kg/m). */
template <int dim>
void FreeDofs<dim>::add_platen(const Platen &platen, const std::vector<double> &mass)
{
  for (unsigned int c = 0; c < dim; ++c)
    if (c + 1 == dim || platen.slides[c])
      moved.push_back(c);
  of_platen_alone         = platen.mass;
  const unsigned int rank = mpi::this_mpi_process(body.communicator()),
                     none = mpi::n_mpi_processes(body.communicator());
  platen_rank     = mpi::min(platen_nodes.empty() ? none : rank, body.communicator());
  double together = owns_platen() ? platen.mass : 0.;
  for (const double of_node : mass)
    together += of_node;
  together = mpi::sum(together, body.communicator());
  for (const unsigned int c : moved)
    if (owns_platen())
      add(c, platen_nodes.front(), together);
}

template <int dim>
std::vector<double> FreeDofs<dim>::of_platen(const Vector &x) const
{
  std::vector<double> values(moved.size(), 0.);
  for (std::size_t k = 0; k < moved.size(); ++k)
    values[k] =
      mpi::broadcast(owns_platen() ? x.local_element(first_of_platen() + k) : 0.,
                     static_cast<int>(platen_rank), body.communicator());
  return values;
}

template <int dim>
void FreeDofs<dim>::set_platen(Vector &x, const std::size_t k, const double value) const
{
  if (owns_platen())
    x.local_element(first_of_platen() + k) = value;
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
  const std::vector<double> pushed = of_platen(values);
  for (std::size_t k = 0; k < moved.size(); ++k)
    for (const NodeIndex &node : platen_nodes)
      field(moved[k], node) = pushed[k];
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
  for (std::size_t k = 0; k < moved.size(); ++k)
    {
      double sum = 0.;
      for (const NodeIndex &node : platen_nodes)
        sum += field(moved[k], node);
      set_platen(values, k, mpi::sum(sum, body.communicator()));
    }
}

template <int dim>
bool FreeDofs<dim>::owns_platen() const
{
  return !moved.empty() && mpi::this_mpi_process(body.communicator()) == platen_rank;
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
