#ifndef mesoslip_eigenvalues_free_dofs_h
#define mesoslip_eigenvalues_free_dofs_h

#include "body/elastic_body.h"
#include "elasticity/dof_mask.h"
#include "grid/nodal_field.h"

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <memory>
#include <vector>

namespace mesoslip
{
/** A rigid platen; its nodes move as a rigid unit along some axes. */
struct Platen
{
  std::vector<NodeIndex> nodes;   ///< nodes on this rank
  std::array<bool, 3> moves = {}; ///< whether it moves along x, y and z
  double mass               = 0.; ///< mass without its nodes (kg, in 2D kg/m)
};

/** A displacement component of a platen. */
struct PlatenDof
{
  std::size_t platen     = 0;  ///< index of the platen
  unsigned int component = 0;  ///< component, 0: x
  double mass            = 0.; ///< Platen::mass (kg, in 2D kg/m)
  unsigned int rank      = 0;  ///< rank that owns it, the first one with a node
  std::size_t place      = 0;  ///< local index on that rank
};

/**
 * Numbering of the degrees of freedom that can vibrate, with their lumped masses: the
 * free degrees of freedom of a body without periodic copies, and the displacements of
 * platens. Each rank owns those of its locally owned nodes.
 */
template <int dim>
class FreeDofs
{
public:
  /** One entry per degree of freedom, distributed over the ranks like the fields. */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * @p mask must constrain the displacements that @p platens move. @p body must outlive
   * this object. Collective.
   */
  FreeDofs(const ElasticBody<dim> &body,
           const DofMask &mask,
           const std::vector<Platen> &platens);

  /** A zero vector. */
  Vector zero() const
  {
    return Vector(partitioner);
  }

  /** Number of degrees of freedom, on all ranks. */
  std::size_t size() const
  {
    return partitioner->size();
  }

  /** Degrees of freedom of platens. */
  const std::vector<PlatenDof> &of_platens() const
  {
    return platen_dofs;
  }

  /** Nodes of this rank that platen @p k moves. */
  const std::vector<NodeIndex> &nodes_of_platen(const std::size_t k) const
  {
    return platens[k].nodes;
  }

  /** Platen entries of @p x in the order of of_platens(), on all ranks. Collective. */
  std::vector<double> of_platens(const Vector &x) const;

  /** Sets platen entry @p k of @p x. */
  void set_platen(Vector &x, const std::size_t k, const double value) const;

  /** dst = M src with the lumped mass (kg, in 2D kg/m); interface of ARPACK. */
  void vmult(Vector &dst, const Vector &src) const;

  /** Sums of the entries of @p x along each axis. Collective. */
  std::array<double, dim> sums(const Vector &x) const;

  /** x.M y. Collective. */
  double mass_product(const Vector &x, const Vector &y) const;

  /**
   * Copies @p values to @p field; constrained entries become zero, periodic copies are
   * updated. Collective.
   */
  void scatter(NodalField<double> &field, const Vector &values) const;

  /** Copies the displacements of @p field to @p values. */
  void gather(Vector &values, const NodalField<double> &field) const;

  /**
   * Copies the nodal forces of @p field (N, in 2D N/m); platens get the sums of their
   * nodes. Collective.
   */
  void gather_forces(Vector &values, const NodalField<double> &field) const;

private:
  bool has(const PlatenDof &dof) const;

  void add_platen(const std::size_t k,
                  const std::vector<bool> &counted,
                  const std::vector<double> &mass);

  void add(const unsigned int c, const NodeIndex &node, const double mass);

  const ElasticBody<dim> &body;
  std::vector<Platen> platens;
  std::vector<PlatenDof> platen_dofs;
  std::vector<std::vector<NodeIndex>>
    counted_nodes; ///< locally owned nodes of each platen, without periodic copies
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  std::vector<NodeIndex>
    nodes; ///< node of each degree of freedom; for a platen one of its nodes
  std::vector<unsigned int> components;
  std::vector<double> masses;
};
} // namespace mesoslip

#endif
