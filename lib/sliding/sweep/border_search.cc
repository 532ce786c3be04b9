#include "sliding/sweep/border_search.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesoslip
{
namespace
{
/** Distance of a trial from the zero of the line, relative to the tolerance: two such
 * trials on both sides of the zero enclose it closely enough. */
constexpr double beside = 0.45;

/** Trials after which a bracket is narrower than round-off. */
constexpr unsigned int most_trials = 150;

/** The value halfway, along the scale of the axis. */
double middle(const double a, const double b, const bool logarithmic)
{
  return logarithmic ? std::copysign(std::sqrt(a * b), a) : 0.5 * (a + b);
}
} // namespace

double BorderSearch::Edge::zero() const
{
  const double halfway = middle(stable.value, growing.value, logarithmic);
  if (growing_before)
    {
      const double slope = (growing_before->growth - growing.growth) /
                           (growing_before->value - growing.value),
                   found = growing.value - growing.growth / slope;
      if ((found - stable.value) * (growing.value - found) > 0.)
        return found;
    }
  if (n_trials == 0 || !std::isfinite(stable.growth))
    return halfway;
  return stable.value + (growing.value - stable.value) * stable.growth /
                          (stable.growth - growing.growth);
}

bool BorderSearch::Edge::is_known(const double tolerance) const
{
  return n_trials >= most_trials ||
         std::fabs(growing.value - stable.value) <=
           tolerance * std::max({std::fabs(growing.value), std::fabs(stable.value),
                                 tolerance * distance});
}

double BorderSearch::Edge::trial(const double tolerance) const
{
  if (n_trials % 4 == 0)
    return rounded(middle(stable.value, growing.value, logarithmic));
  // On the side of the farther end, which it moves close to the border of a straight line.
  const double at = zero(), to_stable = stable.value - at,
               to_growing = growing.value - at,
               to_farther =
                 std::fabs(to_stable) > std::fabs(to_growing) ? to_stable : to_growing,
               step = std::min(beside * tolerance * std::fabs(at),
                               0.5 * std::fabs(to_farther));
  return rounded(at + std::copysign(step, to_farther));
}

BorderSearch::BorderSearch(const SweepParameters &parameters,
                           const std::vector<FastestGrowth> &growth)
  : tolerance(parameters.border_tolerance)
{
  const std::vector<std::vector<double>> points = parameters.all_points();
  AssertDimension(points.size(), growth.size());
  const std::vector<std::size_t> extents = parameters.shape();
  // Both branches of a map that goes up and down have the same modes.
  const bool has_branches = parameters.continuation == Continuation::both;
  const std::size_t n     = has_branches ? points.size() / 2 : points.size();
  for (std::size_t a = extents.size(), stride = 1; a-- > (has_branches ? 1 : 0);)
    {
      for (std::size_t k = 0; k + stride < n; ++k)
        if (k / stride % extents[a] + 1 < extents[a] && growth[k] && growth[k + stride])
          {
            const End one   = {points[k][a], *growth[k]},
                      other = {points[k + stride][a], *growth[k + stride]};
            if ((one.growth < 0.) == (other.growth < 0.))
              continue;
            const bool grows = one.growth >= 0.;
            edges.push_back({points[k], a, parameters.axes[a].logarithmic,
                             grows ? other : one, grows ? one : other,
                             std::fabs(other.value - one.value)});
          }
      stride *= extents[a];
    }
}

std::vector<std::vector<double>> BorderSearch::wanted() const
{
  std::vector<std::vector<double>> result;
  for (const Edge &edge : edges)
    if (!edge.is_known(tolerance))
      {
        result.push_back(edge.values);
        result.back()[edge.axis] = edge.trial(tolerance);
      }
  return result;
}

void BorderSearch::take(const std::vector<FastestGrowth> &growth)
{
  auto found = growth.begin();
  std::vector<Edge> left;
  for (Edge &edge : edges)
    {
      if (!edge.is_known(tolerance))
        {
          const FastestGrowth of_trial = *found++;
          if (!of_trial)
            continue;
          const End end = {edge.trial(tolerance), *of_trial};
          if (end.growth < 0.)
            edge.stable = end;
          else
            edge.growing_before = std::exchange(edge.growing, end);
          ++edge.n_trials;
        }
      left.push_back(edge);
    }
  edges = left;
}

std::vector<BorderPoint> BorderSearch::border() const
{
  std::vector<BorderPoint> result;
  for (const Edge &edge : edges)
    {
      result.push_back({edge.values, edge.axis});
      result.back().values[edge.axis] = edge.zero();
    }
  return result;
}
} // namespace mesoslip
