#include "morphology/statistics.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** Number of runs of equal phase along one direction, for each phase. */
std::vector<std::size_t>
n_runs(const PhaseMap<2> &map, const unsigned int n_phases, const unsigned int direction)
{
  const std::size_t n_x = map.grid.cells[0];
  const std::size_t n_y = map.grid.cells[1];
  std::vector<std::size_t> runs(n_phases, 0);
  for (std::size_t y = 0; y < n_y; ++y)
    for (std::size_t x = 0; x < n_x; ++x)
      {
        const std::size_t i      = y * n_x + x;
        const std::size_t before = direction == 0 ? i - 1 : i - n_x;
        const bool first         = (direction == 0 ? x : y) == 0;
        if (map.id[i] < n_phases && (first || map.id[before] != map.id[i]))
          ++runs[map.id[i]];
      }
  return runs;
}

/** Number of regions of each phase, cells joined across edges. */
std::vector<std::size_t> n_regions(const PhaseMap<2> &map, const unsigned int n_phases)
{
  const std::size_t n_x = map.grid.cells[0];
  const std::size_t n_y = map.grid.cells[1];
  std::vector<std::size_t> regions(n_phases, 0);
  std::vector<char> seen(map.id.size(), 0);
  std::vector<std::size_t> open;
  const auto visit = [&](const std::size_t i, const std::uint8_t phase) {
    if (seen[i] == 0 && map.id[i] == phase)
      {
        seen[i] = 1;
        open.push_back(i);
      }
  };
  for (std::size_t start = 0; start < map.id.size(); ++start)
    {
      const std::uint8_t phase = map.id[start];
      if (seen[start] != 0 || phase >= n_phases)
        continue;
      ++regions[phase];
      visit(start, phase);
      while (!open.empty())
        {
          const std::size_t i = open.back();
          open.pop_back();
          if (i % n_x > 0)
            visit(i - 1, phase);
          if (i % n_x + 1 < n_x)
            visit(i + 1, phase);
          if (i / n_x > 0)
            visit(i - n_x, phase);
          if (i / n_x + 1 < n_y)
            visit(i + n_x, phase);
        }
    }
  return regions;
}
} // namespace

std::vector<PhaseStatistics> phase_statistics(const PhaseMap<2> &map,
                                              const unsigned int n_phases)
{
  std::vector<PhaseStatistics> statistics(n_phases);
  for (const std::uint8_t phase : map.id)
    if (phase < n_phases)
      ++statistics[phase].n_cells;

  const std::vector<std::size_t> x_runs  = n_runs(map, n_phases, 0);
  const std::vector<std::size_t> y_runs  = n_runs(map, n_phases, 1);
  const std::vector<std::size_t> regions = n_regions(map, n_phases);
  for (unsigned int p = 0; p < n_phases; ++p)
    {
      PhaseStatistics &s = statistics[p];
      const auto n       = static_cast<double>(s.n_cells);
      s.area_fraction    = n / static_cast<double>(map.id.size());
      s.n_regions        = regions[p];
      if (s.n_cells > 0)
        {
          s.mean_chord_x = n * map.grid.spacing[0] / static_cast<double>(x_runs[p]);
          s.mean_chord_y = n * map.grid.spacing[1] / static_cast<double>(y_runs[p]);
        }
    }
  return statistics;
}

std::vector<double> area_fractions(const PhaseMap<2> &map, const unsigned int n_phases)
{
  std::vector<std::size_t> counts(n_phases, 0);
  for (const std::uint8_t phase : map.id)
    if (phase < n_phases)
      ++counts[phase];
  std::vector<double> fractions;
  for (const std::size_t count : counts)
    fractions.push_back(static_cast<double>(count) / static_cast<double>(map.id.size()));
  return fractions;
}

std::vector<double> two_point_probability(const PhaseMap<2> &map,
                                          const std::uint8_t phase,
                                          const unsigned int direction,
                                          const unsigned int max_lag)
{
  const std::size_t n_x = map.grid.cells[0];
  const std::size_t n_y = map.grid.cells[1];
  std::vector<double> probability;
  for (std::size_t lag = 0; lag <= max_lag && lag < map.grid.cells[direction]; ++lag)
    {
      const std::size_t lag_x = direction == 0 ? lag : 0;
      const std::size_t lag_y = direction == 0 ? 0 : lag;
      std::size_t hits        = 0;
      for (std::size_t y = 0; y + lag_y < n_y; ++y)
        for (std::size_t x = 0; x + lag_x < n_x; ++x)
          if (map.id[y * n_x + x] == phase &&
              map.id[(y + lag_y) * n_x + x + lag_x] == phase)
            ++hits;
      probability.push_back(static_cast<double>(hits) /
                            static_cast<double>((n_x - lag_x) * (n_y - lag_y)));
    }
  return probability;
}

std::uint64_t morphology_digest(const PhaseMap<2> &map)
{
  std::uint64_t state = 0xcbf29ce484222325u;
  const auto add      = [&](const std::uint8_t byte) {
    state = (state ^ byte) * 0x100000001b3u;
  };
  for (const unsigned int n : map.grid.cells)
    for (unsigned int shift = 0; shift < 32; shift += 8)
      add(static_cast<std::uint8_t>(n >> shift));
  for (const std::uint8_t phase : map.id)
    add(phase);
  return state;
}
} // namespace mesoslip
