#ifndef mesoslip_eigenvalues_free_dofs_h
#define mesoslip_eigenvalues_free_dofs_h

#include "body/elastic_body.h"
#include "elasticity/dof_mask.h"
#include "grid/nodal_field.h"

#include <deal.II/lac/vector.h>

#include <limits>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * The degrees of freedom that can vibrate, numbered, with their lumped masses: the free
 * ones of a body, without the duplicates of periodic sides, and, with a platen, the one
 * u_y of the top as the last.
 */
class FreeDofs
{
public:
  using Vector = dealii::Vector<double>; ///< one entry per degree of freedom

  /**
   * @p mask constrains u_y of the top when there is a platen of mass @p platen_mass
   * (kg/m), which moves the top as one. @p body must outlive this object.
   */
  FreeDofs(const ElasticBody<2> &body,
           const DofMask &mask,
           const std::optional<double> &platen_mass);

  /** What platen() is without one. */
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /** Number of degrees of freedom. */
  std::size_t size() const
  {
    return masses.size();
  }

  /** Number of the platen's degree of freedom, or none. */
  std::size_t platen() const
  {
    return with_platen ? size() - 1 : none;
  }

  /** dst = M src, the lumped mass (kg/m) times a vector, as ARPACK wants it. */
  void vmult(Vector &dst, const Vector &src) const;

  /** Direction of degree of freedom @p k, 0: x, 1: y. */
  unsigned int component(const std::size_t k) const
  {
    return components[k];
  }

  /** x.M y. */
  double mass_product(const Vector &x, const Vector &y) const;

  /** Constrained entries of @p field become zero, duplicates copies. */
  void scatter(NodalField<double> &field, const Vector &values) const;

  /** Displacements of @p field. */
  void gather(Vector &values, const NodalField<double> &field) const;

  /** Nodal forces of @p field (N/m); the platen carries the sum of the top. */
  void gather_forces(Vector &values, const NodalField<double> &field) const;

private:
  void add(const unsigned int c, const NodeIndex &node, const double mass);

  const ElasticBody<2> &body;
  const bool with_platen;
  std::vector<NodeIndex> platen_nodes; ///< without duplicates
  std::vector<NodeIndex> nodes; ///< of the degrees of freedom; first one of the top
  std::vector<unsigned int> components;
  std::vector<double> masses;
};
} // namespace mesoslip

#endif
