#include "eigenvalues/free_dofs.h"

namespace mesoslip
{
FreeDofs::FreeDofs(const ElasticBody<2> &body,
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
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        if (!duplicate.is_constrained(0, {i, j}) && !mask.is_constrained(c, {i, j}))
          add(c, {i, j}, mass_of({i, j}));
  if (!with_platen)
    return;
  double moved = *platen_mass;
  for (const NodeIndex &node : body.surface(ElasticBody<2>::top).nodes)
    if (!duplicate.is_constrained(0, node))
      {
        platen_nodes.push_back(node);
        moved += mass_of(node);
      }
  add(1, platen_nodes.front(), moved);
}

void FreeDofs::add(const unsigned int c, const NodeIndex &node, const double mass)
{
  components.push_back(c);
  nodes.push_back(node);
  masses.push_back(mass);
}

void FreeDofs::vmult(Vector &dst, const Vector &src) const
{
  for (std::size_t k = 0; k < size(); ++k)
    dst[k] = masses[k] * src[k];
}

double FreeDofs::mass_product(const Vector &x, const Vector &y) const
{
  double sum = 0.;
  for (std::size_t k = 0; k < size(); ++k)
    sum += masses[k] * x[k] * y[k];
  return sum;
}

void FreeDofs::scatter(NodalField<double> &field, const Vector &values) const
{
  field.set_zero();
  for (std::size_t k = 0; k < size(); ++k)
    field(components[k], nodes[k]) = values[k];
  for (const NodeIndex &node : platen_nodes)
    field(1, node) = values[platen()];
  body.copy_duplicates(field);
}

void FreeDofs::gather(Vector &values, const NodalField<double> &field) const
{
  for (std::size_t k = 0; k < size(); ++k)
    values[k] = field(components[k], nodes[k]);
}

void FreeDofs::gather_forces(Vector &values, const NodalField<double> &field) const
{
  gather(values, field);
  if (!with_platen)
    return;
  values[platen()] = 0.;
  for (const NodeIndex &node : platen_nodes)
    values[platen()] += field(1, node);
}
} // namespace mesoslip
