#include "elasticity/boundary_row.h"

namespace mesoslip
{
FreeRow::FreeRow(const StepParameters &parameters)
  : dt(parameters.dt)
  , c_new(parameters.dt * (parameters.beta2 + 0.5))
  , c_old(-parameters.dt * (parameters.beta2 - 0.5))
{
}

void FreeRow::advance(const RowView &row)
{
  const auto move = [&](double *__restrict__ u, double *__restrict__ w,
                        const double *__restrict__ f,
                        const double *__restrict__ inverse_mass) {
    for (unsigned int i = 0; i < row.n_columns; ++i)
      {
        const double w_old = w[i];
        const double w_new = w_old - dt * inverse_mass[i] * f[i];
        w[i]               = w_new;
        u[i] += c_new * w_new + c_old * w_old;
      }
  };
  move(row.ux, row.wx, row.fx, row.inverse_mass_x);
  move(row.uy, row.wy, row.fy, row.inverse_mass_y);
}
} // namespace mesoslip
