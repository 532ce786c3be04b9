#include "base/object_exchange.h"
#include "program/run_context.h"
#include "sliding/sweep/sweep_analysis.h"

namespace mesoslip
{
/** Growth of the points from number @p first on. */
std::vector<FastestGrowth> SweepAnalysis::growth_of(const std::size_t first,
                                                    const RunContext &context) const
{
  std::vector<FastestGrowth> growth;
  for (std::size_t k = first; k < points.size(); ++k)
    growth.push_back(fastest_growth(context.file(points[k].folder)));
  return growth;
}

/** Computes complex modes between the points of the map until the border of growth is
 * known.
 * @return false if it was stopped. Collective. */
bool SweepAnalysis::find_border(RunContext &context)
{
  const std::size_t of_map = points.size();
  std::optional<BorderSearch> search;
  on_root(context.communicator(),
          [&]() { search.emplace(parameters, growth_of(0, context)); });
  bool is_complete = true;
  for (unsigned int round = 1; is_complete; ++round)
    {
      std::vector<SweepPoint> trials;
      on_root(context.communicator(), [&]() {
        for (const std::vector<double> &values : search->wanted())
          trials.push_back(folders->point(values));
      });
      broadcast_object(context.communicator(), trials);
      if (trials.empty())
        break;
      points.insert(points.end(), trials.begin(), trials.end());
      is_complete = compute_missing("Border, round " + std::to_string(round), of_map,
                                    {true}, context);
      on_root(context.communicator(), [&]() {
        if (is_complete)
          search->take(growth_of(of_map, context));
      });
      points.resize(of_map);
    }
  if (is_complete)
    on_root(context.communicator(), [&]() { border = search->border(); });
  return is_complete;
}

} // namespace mesoslip
