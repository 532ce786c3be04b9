#include "eigenvalues/free_dofs.h"

#include "base/exchange.h"

namespace mesoslip
{
namespace
{
template <int dim>
std::size_t index_of(const ElasticBody<dim> &body, const NodeIndex &node)
{
  return static_cast<std::size_t>(node.j) * body.n_columns() + node.i;
}
} // namespace

template <int dim>
FreeDofs<dim>::FreeDofs(const ElasticBody<dim> &body,
                        const DofMask &mask,
                        const std::vector<Platen> &platens)
  : body(body)
  , platens(platens)
{
  const std::vector<bool> counted = body.counted_masters();
  const std::vector<double> mass  = body.lumped_mass();
  for (unsigned int j = 0; j < body.n_rows(); ++j)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        if (counted[index_of(body, {i, j})] && !mask.is_constrained(c, {i, j}))
          add(c, {i, j}, mass[index_of(body, {i, j})]);
  for (std::size_t k = 0; k < platens.size(); ++k)
    add_platen(k, counted, mass);
  partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(
    masses.size(), 0, body.communicator());
}

template <int dim>
void FreeDofs<dim>::add_platen(const std::size_t k,
                               const std::vector<bool> &counted,
                               const std::vector<double> &mass)
{
  std::vector<NodeIndex> &of_platen = counted_nodes.emplace_back();
  double together                   = 0.;
  for (const NodeIndex &node : platens[k].nodes)
    if (counted[index_of(body, node)])
      {
        of_platen.push_back(node);
        together += mass[index_of(body, node)];
      }
  const MPI_Comm communicator = body.communicator();
  const unsigned int rank     = mpi::this_mpi_process(communicator),
                     none     = mpi::n_mpi_processes(communicator),
                     first    = mpi::min(of_platen.empty() ? none : rank, communicator);
  together = mpi::sum(together + (rank == first ? platens[k].mass : 0.), communicator);
  for (unsigned int c = 0; c < dim; ++c)
    if (platens[k].moves[c])
      {
        platen_dofs.push_back({k, c, platens[k].mass, first, masses.size()});
        if (rank == first)
          add(c, of_platen.front(), together);
      }
}

template <int dim>
std::vector<double> FreeDofs<dim>::of_platens(const Vector &x) const
{
  std::vector<double> values;
  for (const PlatenDof &dof : platen_dofs)
    values.push_back(mpi::broadcast(has(dof) ? x.local_element(dof.place) : 0.,
                                    static_cast<int>(dof.rank), body.communicator()));
  return values;
}

template <int dim>
void FreeDofs<dim>::set_platen(Vector &x, const std::size_t k, const double value) const
{
  if (has(platen_dofs[k]))
    x.local_element(platen_dofs[k].place) = value;
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
  const std::vector<double> pushed = of_platens(values);
  for (std::size_t k = 0; k < pushed.size(); ++k)
    for (const NodeIndex &node : counted_nodes[platen_dofs[k].platen])
      field(platen_dofs[k].component, node) = pushed[k];
  body.update_copies(field);
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
  for (std::size_t k = 0; k < platen_dofs.size(); ++k)
    {
      double sum = 0.;
      for (const NodeIndex &node : counted_nodes[platen_dofs[k].platen])
        sum += field(platen_dofs[k].component, node);
      set_platen(values, k, mpi::sum(sum, body.communicator()));
    }
}

template <int dim>
bool FreeDofs<dim>::has(const PlatenDof &dof) const
{
  return mpi::this_mpi_process(body.communicator()) == dof.rank;
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
