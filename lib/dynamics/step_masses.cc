#include "dynamics/step_masses.h"

#include <algorithm>

namespace mesoslip
{
StepMasses::StepMasses(const UniformMaterial &material,
                       const NodeRows &rows,
                       const StepParameters &parameters,
                       const SideConstraints &sides)
  : one_row(material.has_uniform_density())
  , has_mass(parameters.acceleration != std::array<double, 2>{})
{
  const unsigned int n = material.n_columns(), top_row = material.grid().cells[1];
  const std::array<double, 2> h = material.grid().spacing;
  for (const bool top : {false, true})
    {
      inverse_boundary[top] = NodalField<double>(n, 1);
      mass_boundary[top]    = NodalField<double>(n, 1);
      inverse_mass_row(material, sides, top ? top_row : 0,
                       inverse_boundary[top].row(0, 0), inverse_boundary[top].row(1, 0),
                       mass_boundary[top].row(0, 0));
    }

  const unsigned int n_rows = one_row ? 1 : rows.n_local();
  factor                    = NodalField<double>(n, n_rows);
  mass                      = NodalField<double>(n, has_mass ? n_rows : 1);
  for (unsigned int l = 0; l < n_rows; ++l)
    {
      double *x = factor.row(0, l);
      double *y = factor.row(1, l);
      inverse_mass_row(material, sides,
                       one_row ? std::min(1u, top_row) : rows.first() + l, x, y,
                       mass.row(0, has_mass ? l : 0));
      for (unsigned int i = 0; i < n; ++i)
        {
          x[i] *= -parameters.dt * h[0] / 2.;
          y[i] *= -parameters.dt * h[1] / 2.;
        }
    }
  equal_components = h[0] == h[1] && sides.left_held[0] == sides.left_held[1] &&
                     sides.right_held[0] == sides.right_held[1];
}

void StepMasses::inverse_mass_row(const UniformMaterial &material,
                                  const SideConstraints &sides,
                                  const unsigned int j,
                                  double *x,
                                  double *y,
                                  double *m) const
{
  const unsigned int n = material.n_columns();
  material.mass_row(j, m);
  for (unsigned int i = 0; i < n; ++i)
    x[i] = y[i] = 1. / m[i];
  double *component[2] = {x, y};
  for (const unsigned int c : {0u, 1u})
    {
      if (sides.left_held[c])
        component[c][0] = 0.;
      if (sides.right_held[c])
        component[c][n - 1] = 0.;
    }
}

void StepMasses::set_inner(kernels::Rows<double> &r, const unsigned int l) const
{
  const unsigned int row = one_row ? 0 : l;
  r.factor_x             = factor.row(0, row);
  r.factor_y             = factor.row(equal_components ? 0 : 1, row);
  r.factor_stride        = one_row ? 0 : factor.stride();
  r.mass                 = mass.row(0, has_mass ? row : 0);
  r.mass_stride          = one_row ? 0 : mass.stride();
}

void StepMasses::set_boundary(kernels::Rows<double> &r,
                              SurfaceView<2> &view,
                              const bool top) const
{
  r.mass               = mass_boundary[top].row(0, 0);
  view.inverse_mass[0] = inverse_boundary[top].row(0, 0);
  view.inverse_mass[1] = inverse_boundary[top].row(1, 0);
}
} // namespace mesoslip
