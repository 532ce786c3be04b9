#include "dynamics/grid/step_masses.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Inverse inertias of a row (m/kg), zero where held. */
void set_inverse_row(const SideConstraints &sides,
                     const std::vector<double> &inertia,
                     double *x,
                     double *y)
{
  const std::size_t n = inertia.size();
  for (std::size_t i = 0; i < n; ++i)
    x[i] = y[i] = 1. / inertia[i];
  double *component[2] = {x, y};
  for (const unsigned int c : {0u, 1u})
    {
      if (sides.left_held[c])
        component[c][0] = 0.;
      if (sides.right_held[c])
        component[c][n - 1] = 0.;
    }
}
} // namespace

template <typename Number>
StepMasses<Number>::StepMasses(const UniformMaterial &material,
                               const NodeRows &rows,
                               const StepParameters &parameters,
                               const SideConstraints &sides,
                               const UniformMaterial *damping)
  : one_row(material.has_uniform_density() &&
            (damping == nullptr || damping->has_uniform_density()))
  , has_mass(parameters.acts_on_mass())
{
  const unsigned int n = material.n_columns(), top_row = material.grid().cells[1];
  const std::array<double, 2> h = material.grid().spacing;
  const auto inertia            = [&](const unsigned int j) {
    return inertia_row(material, damping, parameters, j);
  };
  std::vector<double> x(n), y(n), masses(n);
  const auto set_masses = [&](const unsigned int j, Number *of_row) {
    material.mass_row(j, masses.data());
    std::transform(masses.begin(), masses.end(), of_row,
                   [](const double m) { return static_cast<Number>(m); });
  };
  for (const bool top : {false, true})
    {
      inverse_boundary[top] = NodalField<double>(n, 1);
      mass_boundary[top]    = NodalField<Number>(n, 1);
      const unsigned int j  = top ? top_row : 0;
      set_inverse_row(sides, inertia(j), inverse_boundary[top].row(0, 0),
                      inverse_boundary[top].row(1, 0));
      set_masses(j, mass_boundary[top].row(0, 0));
    }

  const unsigned int n_rows = one_row ? 1 : rows.n_local();
  factor                    = NodalField<Number>(n, n_rows);
  mass                      = NodalField<Number>(n, has_mass ? n_rows : 1);
  for (unsigned int l = 0; l < n_rows; ++l)
    {
      const unsigned int j = one_row ? std::min(1u, top_row) : rows.first() + l;
      set_inverse_row(sides, inertia(j), x.data(), y.data());
      set_masses(j, mass.row(0, has_mass ? l : 0));
      for (unsigned int i = 0; i < n; ++i)
        {
          factor.row(0, l)[i] = static_cast<Number>(x[i] * (-parameters.dt * h[0] / 2.));
          factor.row(1, l)[i] = static_cast<Number>(y[i] * (-parameters.dt * h[1] / 2.));
        }
    }
  equal_components = h[0] == h[1] && sides.left_held[0] == sides.left_held[1] &&
                     sides.right_held[0] == sides.right_held[1];
}

template <typename Number>
void StepMasses<Number>::add_guests(const bool top,
                                    const std::vector<SideColumn *> &columns)
{
  for (SideColumn *column : columns)
    for (unsigned int c = 0; c < 2; ++c)
      if (double &inverse = inverse_boundary[top].row(c, 0)[column->column]; inverse > 0.)
        inverse = 1. / (1. / inverse + column->guest_mass(top, c));
}

template <typename Number>
void StepMasses<Number>::set_inner(kernels::Rows<Number> &r, const unsigned int l) const
{
  const unsigned int row = one_row ? 0 : l;
  r.factor_x             = factor.row(0, row);
  r.factor_y             = factor.row(equal_components ? 0 : 1, row);
  r.factor_stride        = one_row ? 0 : factor.stride();
  r.mass                 = mass.row(0, has_mass ? row : 0);
  r.mass_stride          = one_row ? 0 : mass.stride();
}

template <typename Number>
void StepMasses<Number>::set_boundary(kernels::Rows<Number> &r,
                                      SurfaceView<2> &view,
                                      const bool top) const
{
  r.mass               = mass_boundary[top].row(0, 0);
  view.inverse_mass[0] = inverse_boundary[top].row(0, 0);
  view.inverse_mass[1] = inverse_boundary[top].row(1, 0);
}

template class StepMasses<double>;
template class StepMasses<float>;
} // namespace mesoslip
