#include "exchange/grid_file.h"
#include "observation/grid_probes.h"
#include "program/run_context.h"
#include "sliding/given_grid.h"

namespace mesoslip
{
void turn_over(BodyDescription &body)
{
  const std::size_t n = body.grid.cells[0];
  std::vector<std::uint8_t> rows;
  for (std::size_t end = body.phase_id.size(); end > 0; end -= n)
    rows.insert(rows.end(), body.phase_id.begin() + static_cast<std::ptrdiff_t>(end - n),
                body.phase_id.begin() + static_cast<std::ptrdiff_t>(end));
  body.phase_id = rows;
  for (Phase<2> &phase : body.phases) // shear changes its sign
    for (unsigned int k = 0; k < 2; ++k)
      {
        phase.stiffness(k, 2) *= -1.;
        phase.stiffness(2, k) *= -1.;
      }
}

/** y (m) of a row of nodes. */
double GivenGrid::place_of_row(const double row) const
{
  return (parameters.is_turned_over() ? -row : row) * body.grid.spacing[1];
}

CounterMotion<2> GivenGrid::start_below(const SlidingSetup &given,
                                        RunContext &context) const
{
  CounterMotion<2> below;
  if (!context.root())
    return below;
  below.partner         = std::make_unique<PartnerSurface<2>>();
  below.partner->normal = -1.;
  auto sliding = std::make_unique<SlidingGrid>(material, with_sides(given), MPI_COMM_SELF,
                                               below.partner.get());
  below.partner->nodes = nodes_of_contact(sliding->setup);
  sliding->set_initial_velocity(parameters.body.initial_velocity);
  below.displacement = [&moving = *sliding]() {
    const NodalField<double> &u = moving.u;
    NodalField<double> upright  = u.zeros_alike();
    for (unsigned int j = 0; j < u.n_rows(); ++j)
      for (unsigned int i = 0; i < u.n_columns(); ++i)
        {
          upright.row(0, u.n_rows() - 1 - j)[i] = u.row(0, j)[i];
          upright.row(1, u.n_rows() - 1 - j)[i] = -u.row(1, j)[i];
        }
    return FieldRows{0, interleaved(upright)};
  };
  if (const auto &probes = parameters.observation.probes; !probes.empty())
    below.probes = std::make_unique<GridProbes>(probes, material, sliding->stepper,
                                                nullptr, true, given.probe_interval);
  below.body = std::move(sliding);
  return below;
}

/** The body as files have it: upright, below the origin. */
BodyDescription GivenGrid::described() const
{
  BodyDescription upright = body;
  if (!parameters.is_turned_over())
    return upright;
  turn_over(upright);
  upright.grid.origin[1] = -body.grid.extent(1);
  return upright;
}
} // namespace mesoslip
