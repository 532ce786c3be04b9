#include "sliding/flat/profile_check.h"

#include "base/errors.h"
#include "base/text.h"
#include "material/plausibility.h"
#include "sliding/flat/flat_way.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
constexpr double steepest = 0.1, steep = 0.02; // slopes
constexpr unsigned int per_spacing = 4;        // samples between neighbouring nodes

/** Range of the body's own motion along an axis (m): initial velocity and far-end motions
 * of its supports. */
Interval own_way(const ContactParameters &p, const unsigned int axis)
{
  Interval way;
  if (p.analysis != ContactAnalysis::transient)
    return way;
  constexpr unsigned int n = 1000;
  const auto add           = [&](const double moved) {
    way.from = std::min(way.from, moved);
    way.to   = std::max(way.to, moved);
  };
  add(p.body.initial_velocity[axis] * p.time.end_time);
  for (const SideSupport *side : p.suspended())
    for (unsigned int k = 0; k <= n; ++k)
      add(side->suspension.motion[axis](p.time.end_time * k / n));
  return way;
}

/** Range of the flat that passes below the body, along an axis. */
Interval part_along(const ContactParameters &p,
                    const Interval &way,
                    const std::vector<double> &place,
                    const unsigned int axis)
{
  if (place.empty())
    return {};
  const auto [first, last] = std::minmax_element(place.begin(), place.end());
  const double by =
                 axis < p.static_load.of_flat.size() ? p.static_load.of_flat[axis] : 0.,
               along       = p.contact.flat_direction[axis];
  const auto [back, forth] = std::minmax({along * way.from, along * way.to, by, 0.});
  const Interval own       = own_way(p, axis);
  return {*first - forth + own.from, *last - back + own.to};
}

/** Samples of the profile in rows along x. */
class Survey
{
public:
  Survey(const FlatProfile &profile,
         const std::array<Interval, 2> &part,
         const double spacing)
    : profile(profile)
    , spacing(spacing)
    , part(part)
  {
    const double most = profile.varies_along_y() ? 2e3 : 4e6;
    for (unsigned int c = 0; c < 2; ++c)
      {
        const double length = part[c].to - part[c].from;
        n[c]                = c == 1 && !profile.varies_along_y()
                                ? 1
                                : 1 + static_cast<std::size_t>(
                         std::min(most, std::ceil(per_spacing * length / spacing)));
        step[c]             = n[c] > 1 ? length / static_cast<double>(n[c] - 1) : 1.;
        complete = complete && (n[c] == 1 || step[c] <= 1.01 * spacing / per_spacing);
      }
    look();
  }

  double lowest  = std::numeric_limits<double>::infinity();  ///< m
  double highest = -std::numeric_limits<double>::infinity(); ///< m
  double slope   = 0.;                                       ///< largest
  double missed  = 0.;   ///< largest error of the height between neighbouring nodes (m)
  bool complete  = true; ///< whether there are per_spacing samples between neighbours

private:
  std::string place(const std::size_t i, const std::size_t j) const
  {
    return "x = " + brief_text(4, at(0, i)) + " m" +
           (profile.varies_along_y() ? ", y = " + brief_text(4, at(1, j)) + " m"
                                     : std::string());
  }

  double at(const unsigned int axis, const std::size_t i) const
  {
    return part[axis].from + static_cast<double>(i) * step[axis];
  }

  void look()
  {
    std::vector<double> row(n[0]), before;
    for (std::size_t j = 0; j < n[1]; ++j, before = row)
      for (std::size_t i = 0; i < n[0]; ++i)
        {
          row[i] = profile(at(0, i), at(1, j));
          if (!std::isfinite(row[i]))
            throw UserError(
              "Flat/Profile is not finite at " + place(i, j) +
              ", which comes below the body; give heights in m for all places "
              "with x from " +
              brief_text(4, part[0].from, " to ", part[0].to) + " m");
          lowest              = std::min(lowest, row[i]);
          highest             = std::max(highest, row[i]);
          const double along  = i > 0 ? (row[i] - row[i - 1]) / step[0] : 0.,
                       across = !before.empty() ? (row[i] - before[i]) / step[1] : 0.;
          judge(std::hypot(along, across), i, j);
          if (i % per_spacing == 0 && j % per_spacing == 0)
            miss(row[i], i, j);
        }
  }

  /** Updates the error of linear interpolation between neighbouring nodes around the
   * height @p here. */
  void miss(const double here, const std::size_t i, const std::size_t j)
  {
    const double x = at(0, i), y = at(1, j), half = 0.5 * spacing,
                 by_x =
                   std::fabs(here - 0.5 * (profile(x - half, y) + profile(x + half, y))),
                 by_y =
                   std::fabs(here - 0.5 * (profile(x, y - half) + profile(x, y + half)));
    if (std::isfinite(by_x + by_y)) // may be infinite beyond the way
      missed = std::max({missed, by_x, by_y});
  }

  void judge(const double found, const std::size_t i, const std::size_t j)
  {
    slope = std::max(slope, std::fabs(found));
    if (std::fabs(found) > steepest)
      throw UserError(
        "Flat/Profile has the slope " + brief_text(3, found) + " at " + place(i, j) +
        ", but its forces act along the normal of the flat, as for slopes up to " +
        to_text(steepest) + "; make it lower or longer. Heights are in m");
  }

  const FlatProfile &profile;
  const double spacing;
  const std::array<Interval, 2> part;
  std::array<std::size_t, 2> n = {};
  std::array<double, 2> step   = {};
};

double height_of(const ContactPlaces &nodes, const std::size_t i)
{
  return nodes.height.empty() ? 0. : nodes.height[i];
}

double below(const FlatProfile &profile,
             const ContactPlaces &nodes,
             const std::size_t i,
             const std::array<double, 2> &way = {})
{
  const auto &[x, y] = nodes.place;
  return profile(x[i] - way[0], y.empty() ? 0. : y[i] - way[1]);
}

/** Checks that no node is below the profile at the start. */
void require_gap(const ContactParameters &p,
                 const ContactPlaces &nodes,
                 const double range)
{
  double needed  = 0.;
  std::size_t at = 0;
  const auto &x  = nodes.place[0];
  for (std::size_t i = 0; i < x.size(); ++i)
    if (const double in = below(*p.contact.profile, nodes, i) - height_of(nodes, i);
        in > needed)
      {
        needed = in;
        at     = i;
      }
  if (p.contact.gap < needed - 1e-9 * range)
    throw UserError("Flat/Profile reaches " + quantity_text(needed - p.contact.gap, "m") +
                    " into the body at the start, at x = " + to_text(x[at]) +
                    " m; set Flat/Gap to " + to_text(needed) + " or more");
}

/** Checks that the profile is periodic with the period of the body. */
void require_period(const ContactParameters &p,
                    const BodyScales &body,
                    const std::array<Interval, 2> &part,
                    const double range)
{
  const bool is_periodic[] = {p.periodic || !p.mesh.periodic[0].empty(),
                              !p.mesh.periodic[1].empty()};
  const FlatProfile &h     = *p.contact.profile;
  constexpr unsigned int n = 200;
  for (unsigned int axis = 0; axis < 2; ++axis)
    for (unsigned int i = 0; is_periodic[axis] && i <= n; ++i)
      for (unsigned int j = 0; j <= (h.varies_along_y() ? n : 0); ++j)
        {
          const double x    = part[0].from + (part[0].to - part[0].from) * i / n,
                       y    = part[1].from + (part[1].to - part[1].from) * j / n,
                       here = h(x, y),
                       there =
                         axis == 0 ? h(x + body.extent[0], y) : h(x, y + body.extent[1]);
          if (std::fabs(here - there) > 1e-6 * range)
            throw UserError(
              "Flat/Profile is " + to_text(here) + " m high at x = " + to_text(x) +
              " m and " + to_text(there) + " m one period of the body, " +
              to_text(body.extent[axis]) + " m along " + "xy"[axis] +
              ", further; of a periodic body it has to be periodic as well");
        }
}
} // namespace

Interval way_of_flat(const ContactParameters &p)
{
  Interval way;
  if (p.analysis != ContactAnalysis::transient)
    return way;
  constexpr unsigned int n = 10000;
  const double step        = p.time.end_time / n;
  double now               = 0.;
  for (unsigned int k = 0; k < n; ++k)
    {
      now += step * p.contact.flat_velocity((k + 0.5) * step);
      way.from = std::min(way.from, now);
      way.to   = std::max(way.to, now);
    }
  return way;
}

std::vector<std::string> look_at_profile(const ContactParameters &p,
                                         const BodyScales &body,
                                         const ContactPlaces &nodes)
{
  if (!p.contact.profile || nodes.place[0].empty())
    return {};
  const Interval way                 = way_of_flat(p);
  const std::array<Interval, 2> part = {
    {part_along(p, way, nodes.place[0], 0), part_along(p, way, nodes.place[1], 1)}};
  const Survey found(*p.contact.profile, part, nodes.spacing);
  const double range = found.highest - found.lowest;
  require_period(p, body, part, range);
  if (p.analysis == ContactAnalysis::transient)
    require_gap(p, nodes, range);
  std::vector<std::string> warnings;
  if (found.slope > steep)
    warnings.push_back("Flat/Profile has slopes up to " + brief_text(2, found.slope) +
                       ": its forces act along the normal of the flat, so that those "
                       "along the flat lack up to that "
                       "share of the normal force");
  if (!found.complete)
    warnings.emplace_back(
      "Flat/Profile is longer along the way of the flat than could be looked at in "
      "steps of a quarter of the distance of nodes: steep or sharp parts may have been "
      "missed");
  else if (found.missed > 0.1 * range)
    warnings.push_back(
      "Flat/Profile has parts that are finer than the distance of the contact nodes, " +
      quantity_text(nodes.spacing, "m") +
      ": between the nodes they do not touch; refine the body, or smooth the profile");
  return warnings;
}

std::vector<double> gaps_over_profile(const FlatProfile &profile,
                                      const ContactPlaces &nodes,
                                      const std::array<double, 2> &way,
                                      const std::vector<double> &displaced)
{
  std::vector<double> gaps;
  const std::size_t n = nodes.place[0].size(), n_axes = nodes.place[1].empty() ? 1 : 2;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i)
    {
      std::array<double, 2> moved = way;
      for (std::size_t c = 0; c < n_axes && !displaced.empty(); ++c)
        moved[c] -= displaced[n_axes * i + c];
      gaps.push_back(height_of(nodes, i) - below(profile, nodes, i, moved));
      least = std::min(least, height_of(nodes, i) - below(profile, nodes, i));
    }
  for (double &gap : gaps)
    gap -= least;
  return gaps;
}
} // namespace mesoslip
