#ifndef mesoslip_eigenvalues_free_dofs_h
#define mesoslip_eigenvalues_free_dofs_h

#include "body/elastic_body.h"
#include "elasticity/dof_mask.h"
#include "grid/nodal_field.h"

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace mesoslip
{
/** A rigid platen, with which the nodes of the top move as one: along the normal, and along the flat where it
 * slides. */
struct Platen
{
  double mass                = 0.; ///< kg, in 2D kg/m, without that of the top
  std::array<bool, 2> slides = {}; ///< along x and, in 3D, y
};

/**
 * The degrees of freedom that can vibrate, numbered, with their lumped masses: the free
 * ones of a body, without the duplicates of periodic sides, and, with a platen, the
 * displacements of the top. A rank has those of the nodes that it counts; the platen's
 * are the last ones of the first rank that has a node of the top.
 */
template <int dim>
class FreeDofs
{
public:
  /** One entry per degree of freedom, divided among the ranks as fields are. */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /**
   * @p mask constrains the displacements of the top that a @p platen has, if there is one. @p body must outlive
   * this object. Collective.
   */
  FreeDofs(const ElasticBody<dim> &body,
           const DofMask &mask,
           const std::optional<Platen> &platen);

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

  /** The components in which a platen moves the top, in the order of its degrees of freedom; without one none. */
  const std::vector<unsigned int> &platen_components() const
  {
    return moved;
  }

  /** Mass of the platen without that of the top (kg, in 2D kg/m). */
  double platen_mass() const
  {
    return of_platen_alone;
  }

  /** The platen's entries of @p x, on all ranks. Collective. */
  std::vector<double> of_platen(const Vector &x) const;

  /** Sets entry @p k of the platen's of @p x. */
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

  /** Nodal forces of @p field (N, in 2D N/m); the platen carries the sum of the top.
   * Collective. */
  void gather_forces(Vector &values, const NodalField<double> &field) const;

private:
  bool owns_platen() const;

  std::size_t first_of_platen() const
  {
    return masses.size() - moved.size();
  }

  void add_platen(const Platen &platen, const std::vector<double> &mass);

  void add(const unsigned int c, const NodeIndex &node, const double mass);

  const ElasticBody<dim> &body;
  std::vector<unsigned int> moved; ///< see platen_components()
  double of_platen_alone = 0.;     ///< see platen_mass()
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  unsigned int platen_rank = 0;        ///< that has its degree of freedom
  std::vector<NodeIndex> platen_nodes; ///< that this rank counts, without duplicates
  std::vector<NodeIndex>
    nodes; ///< of the degrees of freedom; of those of the platen one of the top
  std::vector<unsigned int> components;
  std::vector<double> masses;
};
} // namespace mesoslip

#endif
