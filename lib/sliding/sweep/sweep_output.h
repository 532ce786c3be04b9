#ifndef mesoslip_sliding_sweep_sweep_output_h
#define mesoslip_sliding_sweep_sweep_output_h

#include "sliding/sweep/sweep_points.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** All points of a map. */
struct SweepMap
{
  const SweepParameters &parameters; ///< axes
  std::vector<std::string> units;    ///< per axis, such as Pa; "-" for pure numbers
  unsigned int dim;                  ///< dimension of the body
  std::vector<SweepPoint> points;    ///< in the order of the map
  std::vector<SweepResult> results;  ///< in the order of points
  /** Where growth of the complex modes begins; empty if it is not known. */
  std::optional<std::vector<BorderPoint>> border;
};

/** Names of all numbers that occur in a result. */
std::vector<std::string> names_of_numbers(const SweepMap &map);

/** Writes map.h5 (a group for the axes, one for the numbers, where each is known, status,
 * messages and folders). */
void write_map_file(const std::string &path, const SweepMap &map);

/** Writes map.csv: a row for each point, empty where a number is not known. */
void write_map_table(const std::string &path, const SweepMap &map);

/** Writes border.csv: a row for each point of the border of growth, which is known. */
void write_border_table(const std::string &path, const SweepMap &map);
} // namespace mesoslip

#endif
