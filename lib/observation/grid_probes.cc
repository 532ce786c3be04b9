#include "observation/grid_probes.h"

#include "base/errors.h"
#include "base/text.h"
#include "grid/row_partition.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
std::array<double, 3> place_of_probe(const ProbePoint &point, const UniformGrid<2> &grid)
{
  std::array<double, 3> position = point.position;
  for (unsigned int d = 0; d < 2 && point.nearest_node; ++d)
    position[d] =
      grid.origin[d] +
      std::round((position[d] - grid.origin[d]) / grid.spacing[d]) * grid.spacing[d];
  return position;
}

void check_probes(const std::vector<ProbePoint> &points,
                  const UniformGrid<2> &grid,
                  const bool turned_over)
{
  constexpr double rounding       = 1e-12; // relative to the extent
  const std::array<double, 2> low = {
    {grid.origin[0], turned_over ? -grid.extent(1) : 0.}};
  for (const ProbePoint &point : points)
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double length = grid.extent(d), from_low = point.position[d] - low[d];
        if (!(from_low >= -rounding * length && from_low <= (1. + rounding) * length))
          throw UserError(point.section + "/" + point.name + "/Position: (" +
                          to_text(point.position[0]) + ", " + to_text(point.position[1]) +
                          ") m lies outside the body, which reaches from (" +
                          to_text(low[0]) + ", " + to_text(low[1]) + ") to (" +
                          to_text(low[0] + grid.extent(0)) + ", " +
                          to_text(low[1] + grid.extent(1)) + ") m; positions are in m");
      }
}

GridProbes::GridProbes(const std::vector<ProbePoint> &points,
                       const UniformMaterial &material,
                       const Stepper &stepper,
                       const ContactSurface<2> *contact,
                       const bool turned_over,
                       const std::uint64_t interval)
  : ProbeRecorder(stepper, 2, interval)
  , material(material)
  , rows(stepper.rows)
  , contact(contact)
  , upwards(turned_over ? -1. : 1.)
{
  int between = 0;
  for (const ProbePoint &point : points)
    {
      const Vector position = place_of_probe(point, material.grid());
      const Vector stored   = {
          {position[0] - material.grid().origin[0], upwards * position[1]}};
      const Place place = locate(stored);
      const bool owned  = rows.begin <= place.j && place.j < rows.end;
      places.push_back(place);
      add({point.name, position, place.phase}, owned);
      if (owned && place.j + 1 == rows.end && rows.has_upper_ghost())
        between = 1;
    }
  MPI_Allreduce(MPI_IN_PLACE, &between, 1, MPI_INT, MPI_MAX, stepper.communicator);
  needs_ghosts = between != 0;
}

GridProbes::Place GridProbes::locate(const Vector &position) const
{
  const UniformGrid<2> &grid = material.grid();
  Place place;
  std::array<unsigned int, 2> cell = {};
  for (unsigned int d = 0; d < 2; ++d)
    {
      // A point on a line between cells, up to round-off, belongs to the upper one.
      const double up = d == 1 ? upwards : 1.,
                   s  = position[d] / grid.spacing[d] + up * 1e-9;
      cell[d] = std::min(static_cast<unsigned int>(std::max(s, 0.)), grid.cells[d] - 1);
      place.xi[d] = std::clamp(position[d] / grid.spacing[d] - cell[d], 0., 1.);
    }
  place.i     = cell[0];
  place.j     = cell[1];
  place.phase = material.phase_of(place.i, place.j);
  return place;
}

void GridProbes::sample_contact(const std::size_t k, ProbeHistory &history) const
{
  const Place &place = places[k];
  if (contact == nullptr || place.j > 0 || place.xi[1] >= 1e-6)
    return;
  // The last node of a periodic side is the first one.
  const unsigned int right = place.i + (place.xi[0] > 0.5 ? 1 : 0),
                     n     = material.grid().cells[0],
                     node  = material.periodicity().x && right == n ? 0 : right;
  const double width = tributary_width(material.grid(), node, material.periodicity().x);
  history.traction.insert(
    history.traction.end(),
    {contact->tangential_force()[node] / width, contact->normal_force()[node] / width});
}

ProbeRecorder::Vector GridProbes::interpolate(const NodalField<double> &field,
                                              const std::size_t k) const
{
  const Place &place   = places[k];
  Vector value         = {};
  const unsigned int j = rows.local(place.j);
  for (unsigned int c = 0; c < 2; ++c)
    {
      const double *lower = field.row(c, j) + place.i,
                   *upper = field.row(c, j + 1) + place.i;
      value[c] =
        (1. - place.xi[1]) * ((1. - place.xi[0]) * lower[0] + place.xi[0] * lower[1]) +
        place.xi[1] * ((1. - place.xi[0]) * upper[0] + place.xi[0] * upper[1]);
    }
  value[1] *= upwards;
  return value;
}

VoigtVector<2> GridProbes::strain(const Place &place) const
{
  const auto &h        = material.grid().spacing;
  const unsigned int j = rows.local(place.j);
  double gradient[2][2];
  for (unsigned int c = 0; c < 2; ++c)
    {
      const double *lower = stepper.u.row(c, j) + place.i,
                   *upper = stepper.u.row(c, j + 1) + place.i;
      gradient[c][0]      = ((1. - place.xi[1]) * (lower[1] - lower[0]) +
                        place.xi[1] * (upper[1] - upper[0])) /
                       h[0];
      gradient[c][1] = ((1. - place.xi[0]) * (upper[0] - lower[0]) +
                        place.xi[0] * (upper[1] - lower[1])) /
                       h[1];
    }
  return VoigtVector<2>(gradient[0][0], gradient[1][1], gradient[0][1] + gradient[1][0]);
}

void GridProbes::update_ghosts(NodalField<double> &field) const
{
  if (needs_ghosts)
    update_ghost_rows(field, rows, stepper.communicator);
}

void GridProbes::sample_strain(const std::size_t k, ProbeHistory &history) const
{
  const ElasticPhase<2> &phase = material.phases()[history.phase];
  VoigtVector<2> e             = strain(places[k]);
  if (phase.mean_dilatation)
    {
      Place middle = places[k];
      middle.xi    = {{0.5, 0.5}};
      e.head<2>().array() += (strain(middle) - e).head<2>().mean();
    }
  VoigtVector<2> s = phase.stiffness * e;
  e[2] *= upwards;
  s[2] *= upwards;
  history.strain.insert(history.strain.end(), e.data(), e.data() + 3);
  history.stress.insert(history.stress.end(), s.data(), s.data() + 3);
}
} // namespace mesoslip
