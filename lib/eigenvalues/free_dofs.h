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
/** A rigid platen, with which nodes move as one along some axes. */
struct Platen
{
  std::vector<NodeIndex> nodes;   ///< that this rank has
  std::array<bool, 3> moves = {}; ///< along x, y and z
  double mass               = 0.; ///< kg, in 2D kg/m, without that of the nodes
};

/** A component in which a platen moves. */
struct PlatenDof
{
  std::size_t platen     = 0;  ///< which one
  unsigned int component = 0;  ///< 0: x
  double mass            = 0.; ///< Platen::mass (kg, in 2D kg/m)
  unsigned int rank = 0; ///< that has the degree of freedom, the first one with a node
  std::size_t place = 0; ///< its number there
};

/**
 * The degrees of freedom that can vibrate, numbered, with their lumped masses: the free
 * ones of a body, without the duplicates of periodic sides, and the displacements of platens.
 * A rank has those of the nodes that it counts.
 */
template <int dim>
class FreeDofs
{
public:
  /** One entry per degree of freedom, divided among the ranks as fields are. */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** @p mask constrains the displacements that @p platens have. @p body must outlive this object. Collective. */
  FreeDofs(const ElasticBody<dim> &body,
           const DofMask &mask,
           const std::vector<Platen> &platens);

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

  /** Those of platens. */
  const std::vector<PlatenDof> &of_platens() const
  {
    return platen_dofs;
  }

  /** The nodes of this rank that platen number @p k moves. */
  const std::vector<NodeIndex> &nodes_of_platen(const std::size_t k) const
  {
    return platens[k].nodes;
  }

  /** The platens' entries of @p x in the order of of_platens(), on all ranks. Collective. */
  std::vector<double> of_platens(const Vector &x) const;

  /** Sets entry @p k of them. */
  void set_platen(Vector &x, const std::size_t k, const double value) const;

  /** dst = M src, the lumped mass (kg, in 2D kg/m) times a vector, as ARPACK wants it. */
  void vmult(Vector &dst, const Vector &src) const;

  /** Sums of the entries of @p x along each axis. Collective. */
  std::array<double, dim> sums(const Vector &x) const;

  /** x.M y. Collective. */
  double mass_product(const Vector &x, const Vector &y) const;

  /** Constrained entries of @p field become zero, duplicates copies. Collective. */
  void scatter(NodalField<double> &field, const Vector &values) const;

  /** Displacements of @p field. */
  void gather(Vector &values, const NodalField<double> &field) const;

  /** Nodal forces of @p field (N, in 2D N/m); platens carry the sums of their nodes.
   * Collective. */
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
    counted_nodes; ///< of each platen, of this rank without duplicates
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  std::vector<NodeIndex>
    nodes; ///< of the degrees of freedom; of those of a platen one of its nodes
  std::vector<unsigned int> components;
  std::vector<double> masses;
};
} // namespace mesoslip

#endif
