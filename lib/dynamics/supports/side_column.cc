#include "dynamics/supports/side_column.h"

#include "dynamics/phase_damping.h"

namespace mesoslip
{
SideColumn::SideColumn(SideSurface<2> &surface,
                       const unsigned int column,
                       const UniformMaterial &material,
                       const NodeRows &rows,
                       const StepParameters &step,
                       const UniformMaterial *damping,
                       const std::array<bool, 2> &held,
                       NodalField<double> &u,
                       NodalField<double> &w)
  : column(column)
  , surface(surface)
  , rows(rows)
  , step(step)
  , u(u)
  , w(w)
{
  for (unsigned int l = 0; l < rows.n_local(); ++l)
    {
      const double inertia =
        inertia_row(material, damping, step, rows.first() + l)[column];
      std::array<double, 2> &inverse = inverse_mass.emplace_back();
      for (unsigned int c = 0; c < 2; ++c)
        inverse[c] = held[c] ? 0. : 1. / inertia;
    }
}

/** View of a single node with state @p node and @p force. */
SurfaceView<2>
SideColumn::view(const unsigned int local, Node &node, std::array<double, 2> &force)
{
  SurfaceView<2> one;
  one.n = 1;
  for (unsigned int c = 0; c < 2; ++c)
    {
      one.u[c]            = &node.u[c];
      one.w[c]            = &node.w[c];
      one.force[c]        = &force[c];
      one.inverse_mass[c] = &inverse_mass[local][c];
    }
  return one;
}

void SideColumn::start(const std::uint64_t first)
{
  for (unsigned int l = 0; l < rows.n_local() && surface.is_at_start(); ++l)
    {
      Node node                   = {{{u.row(0, l)[column], u.row(1, l)[column]}},
                                     {{w.row(0, l)[column], w.row(1, l)[column]}}};
      std::array<double, 2> force = {};
      SurfaceView<2> one          = view(l, node, force);
      one.step                    = first;
      one.time                    = static_cast<double>(first) * step.dt;
      const unsigned int j        = rows.first() + l;
      if (j > 0 && j + 1 < rows.n_global)
        surface.start(l, one, 0);
      else
        surface.start_guest(l, one, 0);
    }
  surface.has_started();
}

/** Local index of the bottom or @p top row. */
unsigned int SideColumn::boundary_row(const bool top) const
{
  return rows.local(top ? rows.n_global - 1 : 0);
}

double SideColumn::guest_mass(const bool top, const unsigned int c)
{
  const unsigned int local = boundary_row(top);
  const double inverse     = inverse_mass[local][c];
  return inverse > 0. ? surface.guest_mass(local, c, 1. / inverse) : 0.;
}

void SideColumn::add_force(const SurfaceView<2> &view,
                           const std::array<double *, 2> &force,
                           const bool top)
{
  surface.add_force(boundary_row(top), view, column, force);
}

void SideColumn::account(const SurfaceView<2> &view, const bool top)
{
  surface.account(boundary_row(top), view, column);
}

void SideColumn::save(const unsigned int row, const unsigned int n)
{
  saved.resize(n);
  for (unsigned int k = 0; k < n; ++k)
    for (unsigned int c = 0; c < 2; ++c)
      {
        saved[k].u[c] = u.row(c, rows.local(row + k))[column];
        saved[k].w[c] = w.row(c, rows.local(row + k))[column];
      }
}

void SideColumn::advance(const unsigned int row,
                         const unsigned int n,
                         const std::uint64_t step_number)
{
  for (unsigned int k = 0; k < n; ++k)
    {
      const unsigned int local    = rows.local(row + k);
      std::array<double, 2> force = {};
      for (unsigned int c = 0; c < 2; ++c)
        if (const double inverse = inverse_mass[local][c]; inverse > 0.)
          force[c] = (saved[k].w[c] - w.row(c, local)[column]) / (step.dt * inverse);
      SurfaceView<2> one = view(local, saved[k], force);
      one.step           = step_number;
      one.time           = static_cast<double>(step_number) * step.dt;
      surface.advance(local, one, 0);
      for (unsigned int c = 0; c < 2; ++c)
        {
          u.row(c, local)[column] = saved[k].u[c];
          w.row(c, local)[column] = saved[k].w[c];
        }
    }
}
} // namespace mesoslip
