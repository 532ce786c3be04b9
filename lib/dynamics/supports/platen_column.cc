#include "dynamics/supports/platen_column.h"

#include "base/exchange.h"
#include "dynamics/phase_damping.h"

#include <algorithm>

namespace mesoslip
{
std::vector<unsigned int> inner_rows(const NodeRows &rows)
{
  std::vector<unsigned int> places;
  for (unsigned int j = std::max(rows.begin, 1U);
       j < std::min(rows.end, rows.n_global - 1); ++j)
    places.push_back(rows.local(j));
  return places;
}

PlatenColumn::PlatenColumn(RigidPlaten<2> &platen,
                           const unsigned int column,
                           const UniformMaterial &material,
                           const NodeRows &rows,
                           const StepParameters &step,
                           const UniformMaterial *damping,
                           NodalField<double> &u,
                           NodalField<double> &w,
                           const MPI_Comm communicator)
  : column(column)
  , platen(platen)
  , step(step)
  , u(u)
  , w(w)
  , communicator(communicator)
  , places(inner_rows(rows))
{
  for (const unsigned int l : places)
    inverse_mass.push_back(
      1. / inertia_row(material, damping, step, rows.first() + l)[column]);
  for (Components *values : {&u_before, &w_before, &force})
    values->fill(std::vector<double>(places.size()));
}

void PlatenColumn::save()
{
  for (unsigned int c = 0; c < 2; ++c)
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        u_before[c][k] = u.row(c, places[k])[column];
        w_before[c][k] = w.row(c, places[k])[column];
      }
}

void PlatenColumn::advance(const std::uint64_t step_number)
{
  SurfaceView<2> view;
  std::array<double, 2> total;
  view.n           = places.size();
  view.step        = step_number;
  view.time        = static_cast<double>(step_number) * step.dt;
  view.total_force = total.data();
  for (unsigned int c = 0; c < 2; ++c)
    {
      for (std::size_t k = 0; k < places.size(); ++k)
        force[c][k] =
          (w_before[c][k] - w.row(c, places[k])[column]) / (step.dt * inverse_mass[k]);
      view.u[c]            = u_before[c].data();
      view.w[c]            = w_before[c].data();
      view.force[c]        = force[c].data();
      view.inverse_mass[c] = inverse_mass.data();
      total[c]             = sum_of(view.force[c], view.n);
    }
  sum_over_ranks(total.data(), total.size(), communicator);
  platen.advance(view);
  for (unsigned int c = 0; c < 2; ++c)
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        u.row(c, places[k])[column] = u_before[c][k];
        w.row(c, places[k])[column] = w_before[c][k];
      }
}
} // namespace mesoslip
