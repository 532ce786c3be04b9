#include "sliding/analyses/static_springs.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
std::vector<double> spring_areas(const std::vector<double> &areas)
{
  constexpr double smallest = 1e-9;
  double largest            = 0.;
  for (const double a : areas)
    largest = std::max(largest, std::fabs(a));
  std::vector<double> result;
  for (const double a : areas)
    result.push_back(std::max(std::fabs(a), smallest * largest));
  return result;
}

StaticSprings::StaticSprings(const PowerSpring &spring,
                             const std::vector<double> &areas,
                             const double pressure)
  : spring(spring)
  , area(spring_areas(areas))
  , least(spring.depth_under(1e-9 * pressure))
  , depth(areas.size(), spring.depth_under(pressure))
{
}

void StaticSprings::linearize(StaticContactProblem &problem,
                              const std::vector<double> &gaps) const
{
  problem.stiffness.clear();
  problem.gap = gaps;
  if (!are_linear())
    problem.gap.resize(area.size(), 0.);
  for (std::size_t i = 0; i < area.size(); ++i)
    {
      const double tangent = spring.tangent(depth[i]);
      problem.stiffness.push_back(area[i] * tangent);
      if (!are_linear())
        problem.gap[i] += depth[i] - spring.pressure(depth[i]) / tangent;
    }
}

double StaticSprings::settle(const StaticContactSolution &solution,
                             const std::vector<double> &displacements,
                             const std::vector<double> &gaps)
{
  double off = 0., all = 0.;
  for (std::size_t i = 0; i < area.size(); ++i)
    {
      if (solution.state[i] == ContactState::held)
        continue;
      const double h = -displacements[i] - (gaps.empty() ? 0. : gaps[i]),
                   f = area[i] * spring.pressure(std::max(0., h));
      depth[i]       = std::max(least, h);
      off += std::fabs(f - solution.normal_force[i]);
      all += f;
    }
  return off / all;
}
} // namespace mesoslip
