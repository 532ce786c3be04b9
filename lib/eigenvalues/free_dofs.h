#ifndef mesoslip_eigenvalues_free_dofs_h
#define mesoslip_eigenvalues_free_dofs_h

#include "body/elastic_body.h"
#include "elasticity/dof_mask.h"
#include "grid/nodal_field.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * The degrees of freedom that can vibrate, numbered, with their lumped masses: the free
 * ones of a body, without the duplicates of periodic sides, and, with a platen, the one
 * normal displacement of the top. A rank has those of the nodes that it counts; the platen's
 * is the last one of the first rank that has a node of the top.
 */
template <int dim>
class FreeDofs
{
public:
  /** One entry per degree of freedom, divided among the ranks as fields are. */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * @p mask constrains the normal displacement of the top when there is a platen of mass @p platen_mass
   * (kg/m), which moves the top as one. @p body must outlive this object. Collective.
   */
  FreeDofs(const ElasticBody<dim> &body,
           const DofMask &mask,
           const std::optional<double> &platen_mass)
    : body(body)
    , with_platen(platen_mass.has_value())
  {
    DofMask duplicate(body.n_columns(), body.n_rows());
    for (const auto &pair : body.duplicate_nodes())
      duplicate.constrain(0, pair[0]);
    const auto is_counted = [&](const NodeIndex &node) {
      return body.is_counted(node) && !duplicate.is_constrained(0, node);
    };
    const std::vector<double> mass = body.lumped_mass();
    const auto mass_of             = [&](const NodeIndex &node) {
      return mass[static_cast<std::size_t>(node.j) * body.n_columns() + node.i];
    };
    for (unsigned int j = 0; j < body.n_rows(); ++j)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 0; i < body.n_columns(); ++i)
          if (is_counted({i, j}) && !mask.is_constrained(c, {i, j}))
            add(c, {i, j}, mass_of({i, j}));
    if (with_platen)
      {
        for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
          if (is_counted(node))
            platen_nodes.push_back(node);
        find_platen_rank();
        double moved = owns_platen() ? *platen_mass : 0.;
        for (const NodeIndex &node : platen_nodes)
          moved += mass_of(node);
        moved = dealii::Utilities::MPI::sum(moved, body.communicator());
        if (owns_platen())
          add(dim - 1, platen_nodes.front(), moved);
      }
    const auto owned = dealii::Utilities::MPI::create_ascending_partitioning(
      body.communicator(), masses.size());
    partitioner = std::make_shared<dealii::Utilities::MPI::Partitioner>(
      owned[dealii::Utilities::MPI::this_mpi_process(body.communicator())],
      body.communicator());
  }

  /** A vector that is zero. */
  Vector zero() const
  {
    return Vector(partitioner);
  }

  /** Number of degrees of freedom, on all ranks. */
  std::size_t size() const
  {
    return partitioner->size();
  }

  /** Whether there is a platen. */
  bool has_platen() const
  {
    return with_platen;
  }

  /** The platen's entry of @p x, on all ranks. Collective. */
  double of_platen(const Vector &x) const
  {
    const double own = owns_platen() ? x.local_element(masses.size() - 1) : 0.;
    return dealii::Utilities::MPI::broadcast(body.communicator(), own, platen_rank);
  }

  /** Sets the platen's entry of @p x. */
  void set_platen(Vector &x, const double value) const
  {
    if (owns_platen())
      x.local_element(masses.size() - 1) = value;
  }

  /** dst = M src, the lumped mass (kg, in 2D kg/m) times a vector, as ARPACK wants it. */
  void vmult(Vector &dst, const Vector &src) const
  {
    for (std::size_t k = 0; k < masses.size(); ++k)
      dst.local_element(k) = masses[k] * src.local_element(k);
  }

  /** Sums of the entries of @p x along each axis. Collective. */
  std::array<double, dim> sums(const Vector &x) const
  {
    std::array<double, dim> result = {};
    for (std::size_t k = 0; k < masses.size(); ++k)
      result[components[k]] += x.local_element(k);
    for (double &sum : result)
      sum = dealii::Utilities::MPI::sum(sum, body.communicator());
    return result;
  }

  /** x.M y. Collective. */
  double mass_product(const Vector &x, const Vector &y) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < masses.size(); ++k)
      sum += masses[k] * x.local_element(k) * y.local_element(k);
    return dealii::Utilities::MPI::sum(sum, body.communicator());
  }

  /** Constrained entries of @p field become zero, duplicates copies. Collective. */
  void scatter(NodalField<double> &field, const Vector &values) const
  {
    field.set_zero();
    for (std::size_t k = 0; k < masses.size(); ++k)
      field(components[k], nodes[k]) = values.local_element(k);
    const double pushed = with_platen ? of_platen(values) : 0.;
    for (const NodeIndex &node : platen_nodes)
      field(dim - 1, node) = pushed;
    body.copy_duplicates(field);
  }

  /** Displacements of @p field. */
  void gather(Vector &values, const NodalField<double> &field) const
  {
    for (std::size_t k = 0; k < masses.size(); ++k)
      values.local_element(k) = field(components[k], nodes[k]);
  }

  /** Nodal forces of @p field (N, in 2D N/m); the platen carries the sum of the top.
   * Collective. */
  void gather_forces(Vector &values, const NodalField<double> &field) const
  {
    gather(values, field);
    if (!with_platen)
      return;
    double sum = 0.;
    for (const NodeIndex &node : platen_nodes)
      sum += field(dim - 1, node);
    set_platen(values, dealii::Utilities::MPI::sum(sum, body.communicator()));
  }

private:
  bool owns_platen() const
  {
    return with_platen &&
           dealii::Utilities::MPI::this_mpi_process(body.communicator()) == platen_rank;
  }

  void find_platen_rank()
  {
    namespace mpi           = dealii::Utilities::MPI;
    const unsigned int rank = mpi::this_mpi_process(body.communicator()),
                       none = mpi::n_mpi_processes(body.communicator());
    platen_rank = mpi::min(platen_nodes.empty() ? none : rank, body.communicator());
  }

  void add(const unsigned int c, const NodeIndex &node, const double mass)
  {
    components.push_back(c);
    nodes.push_back(node);
    masses.push_back(mass);
  }

  const ElasticBody<dim> &body;
  const bool with_platen;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  unsigned int platen_rank = 0;        ///< that has its degree of freedom
  std::vector<NodeIndex> platen_nodes; ///< that this rank counts, without duplicates
  std::vector<NodeIndex>
    nodes; ///< of the degrees of freedom; of the platen one of the top
  std::vector<unsigned int> components;
  std::vector<double> masses;
};
} // namespace mesoslip

#endif
