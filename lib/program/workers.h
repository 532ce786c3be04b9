#ifndef mesoslip_program_workers_h
#define mesoslip_program_workers_h

#include "program/outcome.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Path of the program @p name, if this process runs it; else empty, also if the system
 * does not know. */
std::string file_of_program(const std::string &name);

/** Number of cores that this process may use. */
unsigned int available_cores();

/** Runs of this program to be carried out side by side by other processes. */
struct WorkerTasks
{
  std::size_t n = 0; ///< number of tasks; they start in order, except tasks that wait

  /** The task that has to end before task @p k begins, if any. */
  std::function<std::optional<std::size_t>(std::size_t k)> after;

  /** Command line of task @p k, without the program's name. */
  std::function<std::vector<std::string>(std::size_t k)> words;

  /** Called when task @p k has ended, also if its process died; not called for stopped
   * tasks. */
  std::function<void(std::size_t k, const Outcome &outcome)> done;

  /** Called several times a second: whether to stop. */
  std::function<bool()> stop;
};

/**
 * Lets @p n_processes processes of the program @p file (--serve) carry out @p tasks;
 * their stderr is appended to the file @p errors. If a process dies, its task fails, and
 * a new process takes its place.
 * @return false if the tasks were stopped. Stopped processes have ended as after Ctrl-C.
 * @throws UserError if no process starts
 */
bool carry_out_side_by_side(const std::string &file,
                            const unsigned int n_processes,
                            const std::string &errors,
                            const WorkerTasks &tasks);
} // namespace mesoslip

#endif
