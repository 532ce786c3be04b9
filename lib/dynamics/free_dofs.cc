#include "dynamics/free_dofs.h"

#include <algorithm>
#include <numeric>

namespace mesoslip
{
FreeDofs::FreeDofs(const UniformMaterial &material,
                   const DofMask &held,
                   const std::optional<double> &platen_mass)
  : periodic(material.periodicity())
  , n_columns(material.n_columns())
  , n_rows(material.n_rows())
  , with_platen(platen_mass.has_value())
{
  const NodalField<double> layout(n_columns, n_rows);
  const auto add = [&](const Place &place, const double mass) {
    offsets.push_back(layout.row(place.component, place.j) - layout.begin() + place.i);
    masses.push_back(mass);
    places.push_back(place);
  };
  std::vector<double> row(n_columns);
  for (unsigned int j = 0; j + periodic.y < n_rows; ++j)
    {
      material.mass_row(j, row.data());
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i + periodic.x < n_columns; ++i)
          if (!held.is_held(c, i, j))
            add({c, i, j}, row[i]);
    }
  // The last row is that of the top.
  if (with_platen)
    add({1, 0, n_rows - 1},
        std::accumulate(row.begin(), row.end() - periodic.x, *platen_mass));
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
    field.begin()[offsets[k]] = values[k];
  if (with_platen)
    std::fill_n(field.row(1, n_rows - 1), n_columns, values[platen()]);
  for (unsigned int c = 0; c < 2; ++c)
    {
      for (unsigned int j = 0; periodic.x && j < n_rows; ++j)
        field.row(c, j)[n_columns - 1] = field.row(c, j)[0];
      if (periodic.y)
        std::copy_n(field.row(c, 0), n_columns, field.row(c, n_rows - 1));
    }
}

void FreeDofs::gather(Vector &values, const NodalField<double> &field) const
{
  for (std::size_t k = 0; k < size(); ++k)
    values[k] = field.begin()[offsets[k]];
}

void FreeDofs::gather_forces(Vector &values, const NodalField<double> &field) const
{
  gather(values, field);
  const double *top = field.row(1, n_rows - 1);
  if (with_platen)
    values[platen()] = std::accumulate(top, top + n_columns - periodic.x, 0.);
}
} // namespace mesoslip
