#ifndef mesoslip_sliding_sweep_sweep_points_h
#define mesoslip_sliding_sweep_sweep_points_h

#include "base/digest.h"
#include "sliding/sweep/border_search.h"

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

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &values &folder;
  }
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

/** Names the folders of points by digests of all input that decides their results. */
class PointFolders
{
public:
  /** For the map @p given that @p keys describe; reads the input files.
   * @throws UserError */
  PointFolders(const SweepParameters &given, const Keys &keys);

  /** The points of the map. */
  std::vector<SweepPoint> points() const;

  /** A point that does not start from a neighbour. */
  SweepPoint point(const std::vector<double> &values) const;

private:
  Digest of_point(const SweepPoint &point) const;

  const SweepParameters parameters;
  Digest common; ///< digest of the other keys and of input files
};

/** "pressure = 2e6, friction = 0.3". */
std::string text_of(const SweepParameters &parameters, const SweepPoint &point);

/** Assignments of a point in the form of --set. */
std::vector<std::string> assignments_of(const SweepParameters &parameters,
                                        const SweepPoint &point);

/** Subfolder of a point with its complex modes. */
constexpr char complex_modes_folder[] = "/complex_modes";

/** Whether mark_point() has marked the folder as ended, and not for another try. */
bool has_ended(const std::string &folder);

/** The growth of the fastest complex mode in the folder of a point; empty also if its
 * modes were not computed. */
FastestGrowth fastest_growth(const std::string &folder);

/** Whether the complex modes in the folder of a point were computed and none up to their
 * highest frequency grows; false if the search may have missed growing modes. */
inline bool is_stable(const std::string &folder)
{
  return fastest_growth(folder).value_or(0.) < 0.;
}

/** The result in the folder (a path) of a point, including complex modes in its
 * subfolder; a default result if it was not computed. */
SweepResult read_point(const std::string &folder, const SweepParameters &parameters);

/** Marks the folder of a run as ended: with an empty @p message as done, else as failed;
 * @p again: whether a restarted map tries it again. */
void mark_point(const std::string &folder, const std::string &message, const bool again);
} // namespace mesoslip

#endif
