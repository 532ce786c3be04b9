#ifndef mesoslip_sliding_sweep_sweep_analysis_h
#define mesoslip_sliding_sweep_sweep_analysis_h

#include "program/program.h"
#include "sliding/sweep/sweep_output.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A map: many runs of contact_dynamics that differ in some keys, each in a folder of its
 * own, as if started alone. Points are computed by processes side by side, or one after
 * the other by all ranks. A folder name contains a digest of all input that decides the
 * results, so a stopped, changed or extended map computes only the missing points.
 */
class SweepAnalysis : public Analysis
{
public:
  /** All ranks have the same @p keys, of the whole map; @p program computes single
   * points.
   * @throws UserError naming the point, if the first point or a point at an end of an
   * axis is invalid */
  SweepAnalysis(const SweepParameters &wanted,
                const Keys &keys,
                const Application &program);

  ResourceNeed need() const override;
  void describe(std::ostream &out) const override;
  void run(RunContext &context) override;

private:
  /** A run for a point. */
  struct Task
  {
    std::size_t point  = 0;
    bool is_of_modes   = false; ///< complex modes; else the analysis of the .prm
    std::string folder = {};    ///< name in the folder of the map

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &point &is_of_modes &folder;
    }
  };

  /** Kinds of runs of a point, each by Task::is_of_modes. */
  using Kinds = std::vector<bool>;

  /** Name of the .prm file of a point, in the folder of the map. */
  static constexpr char base_file[] = "point.prm";

  void check(const SweepPoint &point,
             const std::vector<std::string> &assignments,
             const bool builds);
  bool is_there(const std::string &folder, const bool is_of_modes) const;
  std::vector<std::optional<std::size_t>>
  tasks_before(const std::vector<Task> &tasks) const;
  std::vector<Task> missing_tasks(const std::string &folder,
                                  const std::size_t first,
                                  const Kinds &kinds) const;
  void wait_for_others(const std::vector<Task> &tasks, const RunContext &context) const;
  std::vector<std::string> words(const Task &task, const std::string &folder) const;
  void remove_results(const std::string &folder) const;
  std::string
  cause(const Task &task, const Outcome &outcome, const RunContext &context) const;
  void finish(const Task &task, const Outcome &outcome, RunContext &context);
  bool compute(const std::vector<Task> &tasks, RunContext &context);
  bool compute_missing(const std::string &title,
                       const std::size_t first,
                       const Kinds &kinds,
                       RunContext &context);
  std::vector<FastestGrowth> growth_of(const std::size_t first,
                                       const RunContext &context) const;
  bool find_border(RunContext &context);
  void write_results(RunContext &context) const;
  std::string size_text() const;

  const SweepParameters parameters;
  const Application single;
  const unsigned int dim;                ///< dimension of the body
  std::string base;                      ///< a .prm with all keys of a point
  std::vector<std::string> units;        ///< per axis, such as Pa; "-" for pure numbers
  std::unique_ptr<PointFolders> folders; ///< on rank 0
  std::vector<SweepPoint> points; ///< points of the map, then trials of find_border()
  /** On rank 0, once it is known. */
  std::optional<std::vector<BorderPoint>> border;
  std::unique_ptr<Analysis> first; ///< checks and describes the first point
  bool is_trial       = false;     ///< --try
  std::size_t n_tasks = 0;         ///< runs of compute_missing()
  std::size_t n_ended = 0;         ///< runs completed or failed so far
};
} // namespace mesoslip

#endif
