#ifndef mesoslip_sliding_sweep_sweep_points_h
#define mesoslip_sliding_sweep_sweep_points_h

#include "sliding/sweep/sweep_parameters.h"

#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
/** A point of a map. */
struct SweepPoint
{
  std::vector<double> values; ///< along each axis
  std::string
    folder; ///< of its results in the output folder, named by all that decides them
};

/** How a point ended. */
enum class SweepStatus
{
  not_computed, ///< the map was stopped before
  skipped,      ///< its complex modes decay, so that it was not run
  done,
  failed
};

/** What is known of a point. */
struct SweepResult
{
  SweepStatus status                       = SweepStatus::not_computed; ///< how it ended
  std::string message                      = {};                        ///< why it failed
  std::map<std::string, double> numbers    = {}; ///< of its summary, by name
  std::map<std::string, std::string> texts = {}; ///< of its summary, by name
};

/** The points of the map that @p keys describe, of which the input files are read once. @throws UserError */
std::vector<SweepPoint> points_of(const SweepParameters &parameters, const Keys &keys);

/** "pressure = 2e6, friction = 0.3". */
std::string text_of(const SweepParameters &parameters, const SweepPoint &point);

/** Each key of a point as --set takes it. */
std::vector<std::string> assignments_of(const SweepParameters &parameters,
                                        const SweepPoint &point);

/** Where the complex modes of a point are, in its folder. */
constexpr char complex_modes_folder[] = "/complex_modes";

/** Whether mark_point() has marked a folder, and not for the run to be tried again. */
bool has_ended(const std::string &folder);

/** Whether the complex modes in the folder of a point were computed, and none up to their highest frequency grows; not
 * where it is not certain that all that grow were found. */
bool is_stable(const std::string &folder);

/** The result that the folder of a point (its path) holds, with complex modes also that of the folder in it; of
 * one that was not computed the default. */
SweepResult read_point(const std::string &folder, const SweepParameters &parameters);

/** Notes in the folder of a run how it ended: with an empty @p message as wanted; and whether a map that is started again
 * tries it @p again. */
void mark_point(const std::string &folder, const std::string &message, const bool again);
} // namespace mesoslip

#endif
