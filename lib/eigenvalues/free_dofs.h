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
 * normal displacement of the top as the last.
 */
template <int dim>
class FreeDofs
{
public:
  using Vector = dealii::Vector<double>; ///< one entry per degree of freedom

  /**
   * @p mask constrains the normal displacement of the top when there is a platen of mass @p platen_mass
   * (kg/m), which moves the top as one. @p body must outlive this object.
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
    const std::vector<double> mass = body.lumped_mass();
    const auto mass_of             = [&](const NodeIndex &node) {
      return mass[static_cast<std::size_t>(node.j) * body.n_columns() + node.i];
    };
    for (unsigned int j = 0; j < body.n_rows(); ++j)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 0; i < body.n_columns(); ++i)
          if (!duplicate.is_constrained(0, {i, j}) && !mask.is_constrained(c, {i, j}))
            add(c, {i, j}, mass_of({i, j}));
    if (!with_platen)
      return;
    double moved = *platen_mass;
    for (const NodeIndex &node : body.surface(ElasticBody<dim>::top).nodes)
      if (!duplicate.is_constrained(0, node))
        {
          platen_nodes.push_back(node);
          moved += mass_of(node);
        }
    add(dim - 1, platen_nodes.front(), moved);
  }

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

  /** dst = M src, the lumped mass (kg, in 2D kg/m) times a vector, as ARPACK wants it. */
  void vmult(Vector &dst, const Vector &src) const
  {
    for (std::size_t k = 0; k < size(); ++k)
      dst[k] = masses[k] * src[k];
  }

  /** Direction of degree of freedom @p k, 0: x. */
  unsigned int component(const std::size_t k) const
  {
    return components[k];
  }

  /** x.M y. */
  double mass_product(const Vector &x, const Vector &y) const
  {
    double sum = 0.;
    for (std::size_t k = 0; k < size(); ++k)
      sum += masses[k] * x[k] * y[k];
    return sum;
  }

  /** Constrained entries of @p field become zero, duplicates copies. */
  void scatter(NodalField<double> &field, const Vector &values) const
  {
    field.set_zero();
    for (std::size_t k = 0; k < size(); ++k)
      field(components[k], nodes[k]) = values[k];
    for (const NodeIndex &node : platen_nodes)
      field(dim - 1, node) = values[platen()];
    body.copy_duplicates(field);
  }

  /** Displacements of @p field. */
  void gather(Vector &values, const NodalField<double> &field) const
  {
    for (std::size_t k = 0; k < size(); ++k)
      values[k] = field(components[k], nodes[k]);
  }

  /** Nodal forces of @p field (N, in 2D N/m); the platen carries the sum of the top. */
  void gather_forces(Vector &values, const NodalField<double> &field) const
  {
    gather(values, field);
    if (!with_platen)
      return;
    values[platen()] = 0.;
    for (const NodeIndex &node : platen_nodes)
      values[platen()] += field(dim - 1, node);
  }

private:
  void add(const unsigned int c, const NodeIndex &node, const double mass)
  {
    components.push_back(c);
    nodes.push_back(node);
    masses.push_back(mass);
  }

  const ElasticBody<dim> &body;
  const bool with_platen;
  std::vector<NodeIndex> platen_nodes; ///< without duplicates
  std::vector<NodeIndex> nodes; ///< of the degrees of freedom; first one of the top
  std::vector<unsigned int> components;
  std::vector<double> masses;
};
} // namespace mesoslip

#endif
