#include "observation/probe_recorder.h"

#include "base/exchange.h"
#include "grid/row_partition.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
ProbeRecorder::ProbeRecorder(const std::vector<Point> &points,
                             const UniformMaterial &material,
                             const Stepper &stepper,
                             const ContactSurface<2> &contact,
                             const std::uint64_t interval)
  : material(material)
  , stepper(stepper)
  , rows(stepper.rows)
  , contact(contact)
  , interval(interval)
{
  int between   = 0;
  const auto &h = material.grid().spacing;
  for (Point point : points)
    {
      for (unsigned int d = 0; d < 2 && point.nearest_node; ++d)
        point.position[d] = std::round(point.position[d] / h[d]) * h[d];
      const Place place = locate(point.position);
      places.push_back(place);
      histories.push_back(
        {point.name, point.position, material.phase_of(place.i, place.j)});
      if (place.owned && place.j + 1 == rows.end && rows.has_upper_ghost())
        between = 1;
    }
  MPI_Allreduce(MPI_IN_PLACE, &between, 1, MPI_INT, MPI_MAX, stepper.communicator);
  needs_ghosts = between != 0;
}

ProbeRecorder::Place ProbeRecorder::locate(const std::array<double, 2> &position) const
{
  const UniformGrid<2> &grid = material.grid();
  Place place;
  std::array<unsigned int, 2> cell = {};
  for (unsigned int d = 0; d < 2; ++d)
    {
      // A point on a line between cells, up to round-off, belongs to the upper one.
      const double s = position[d] / grid.spacing[d] + 1e-9;
      cell[d] = std::min(static_cast<unsigned int>(std::max(s, 0.)), grid.cells[d] - 1);
      place.xi[d] = std::clamp(position[d] / grid.spacing[d] - cell[d], 0., 1.);
    }
  place.i     = cell[0];
  place.j     = cell[1];
  place.owned = rows.begin <= place.j && place.j < rows.end;
  return place;
}

void ProbeRecorder::sample_contact(const Place &place,
                                   std::vector<double> &traction) const
{
  if (place.j > 0 || place.xi[1] >= 1e-6)
    return;
  const unsigned int node = place.i + (place.xi[0] > 0.5 ? 1 : 0);
  const double width = tributary_width(material.grid(), node, material.periodicity().x);
  traction.insert(traction.end(), {contact.tangential_force()[node] / width,
                                   contact.normal_force()[node] / width});
}

std::array<double, 2> ProbeRecorder::interpolate(const NodalField<double> &field,
                                                 const Place &place) const
{
  std::array<double, 2> value = {};
  const unsigned int j        = rows.local(place.j);
  for (unsigned int c = 0; c < 2; ++c)
    {
      const double *lower = field.row(c, j) + place.i,
                   *upper = field.row(c, j + 1) + place.i;
      value[c] =
        (1. - place.xi[1]) * ((1. - place.xi[0]) * lower[0] + place.xi[0] * lower[1]) +
        place.xi[1] * ((1. - place.xi[0]) * upper[0] + place.xi[0] * upper[1]);
    }
  return value;
}

VoigtVector<2> ProbeRecorder::strain(const Place &place) const
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

void ProbeRecorder::update_ghosts(NodalField<double> &field) const
{
  if (needs_ghosts)
    update_ghost_rows(field, rows, stepper.communicator);
}

void ProbeRecorder::before_step(const std::uint64_t n)
{
  if (n % interval != 0 || places.empty())
    return;
  update_ghosts(stepper.u);
  update_ghosts(stepper.w);
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k].owned)
      {
        ProbeHistory &history  = histories[k];
        const auto value       = interpolate(stepper.u, places[k]);
        const VoigtVector<2> e = strain(places[k]);
        const VoigtVector<2> s = material.phases()[history.phase].stiffness * e;
        history.time.push_back(n * stepper.parameters.dt);
        history.displacement.insert(history.displacement.end(), value.begin(),
                                    value.end());
        history.strain.insert(history.strain.end(), e.data(), e.data() + 3);
        history.stress.insert(history.stress.end(), s.data(), s.data() + 3);
        places[k].w_before = interpolate(stepper.w, places[k]);
      }
}

// v_n = (1 - b) w_n + b w_(n+1); the contact forces of step n are known after it.
void ProbeRecorder::after_step(const std::uint64_t n)
{
  if (n % interval != 0 || places.empty())
    return;
  update_ghosts(stepper.w);
  const double beta2 = stepper.parameters.beta2;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k].owned)
      {
        const auto w_after = interpolate(stepper.w, places[k]);
        for (unsigned int c = 0; c < 2; ++c)
          histories[k].velocity.push_back((1. - beta2) * places[k].w_before[c] +
                                          beta2 * w_after[c]);
        sample_contact(places[k], histories[k].traction);
      }
}

std::vector<ProbeHistory> ProbeRecorder::gather() const
{
  int rank = 0;
  MPI_Comm_rank(stepper.communicator, &rank);
  std::vector<ProbeHistory> all = histories;
  for (std::size_t k = 0; k < all.size(); ++k)
    {
      int owner = places[k].owned ? rank : -1;
      MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MAX, stepper.communicator);
      bring_object_to_root(stepper.communicator, all[k], owner);
    }
  if (rank != 0)
    all.clear();
  return all;
}
} // namespace mesoslip
