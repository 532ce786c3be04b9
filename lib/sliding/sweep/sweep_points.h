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
    folder; ///< folder of its results in the output folder; the name contains a digest of
            ///< its input
};

/** Outcome of a point. */
enum class SweepStatus
{
  not_computed, ///< the map was stopped before
  skipped,      ///< not run, because its complex modes decay
  done,
  failed
};

/** Result of a point. */
struct SweepResult
{
  SweepStatus status                       = SweepStatus::not_computed; ///< outcome
  std::string message                      = {};                        ///< why it failed
  std::map<std::string, double> numbers    = {}; ///< numbers of its summary, by name
  std::map<std::string, std::string> texts = {}; ///< texts of its summary, by name
};

/** The points of the map that @p keys describe; input files are read once.
 * @throws UserError */
std::vector<SweepPoint> points_of(const SweepParameters &parameters, const Keys &keys);

/** "pressure = 2e6, friction = 0.3". */
std::string text_of(const SweepParameters &parameters, const SweepPoint &point);

/** Assignments of a point in the form of --set. */
std::vector<std::string> assignments_of(const SweepParameters &parameters,
                                        const SweepPoint &point);

/** Subfolder of a point with its complex modes. */
constexpr char complex_modes_folder[] = "/complex_modes";

/** Whether mark_point() has marked the folder as ended, and not for another try. */
bool has_ended(const std::string &folder);

/** Whether the complex modes in the folder of a point were computed and none up to their
 * highest frequency grows; false if the search may have missed growing modes. */
bool is_stable(const std::string &folder);

/** The result in the folder (a path) of a point, including complex modes in its
 * subfolder; a default result if it was not computed. */
SweepResult read_point(const std::string &folder, const SweepParameters &parameters);

/** Marks the folder of a run as ended: with an empty @p message as done, else as failed;
 * @p again: whether a restarted map tries it again. */
void mark_point(const std::string &folder, const std::string &message, const bool again);
} // namespace mesoslip

#endif
