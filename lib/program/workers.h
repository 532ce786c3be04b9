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
/** The file of the program @p name, if it is this process; else empty, also where the system does not tell. */
std::string file_of_program(const std::string &name);

/** How many cores this process may use. */
unsigned int available_cores();

/** Runs of this program that other processes carry out side by side. */
struct WorkerTasks
{
  std::size_t n = 0; ///< tasks, given out in their order, but for those that wait

  /** The task that has to end before task @p k begins, if there is one. */
  std::function<std::optional<std::size_t>(std::size_t k)> after;

  /** The command line of task @p k, without the name of the program. */
  std::function<std::vector<std::string>(std::size_t k)> words;

  /** Task @p k has ended, also where its process died. Tasks that were stopped are not told. */
  std::function<void(std::size_t k, const Outcome &outcome)> done;

  /** Asked several times a second: whether to stop. */
  std::function<bool()> stop;
};

/**
 * Has @p n_processes processes of the program @p file (--serve) carry out @p tasks; what they write to stderr goes to
 * the end of the file @p errors. A process that dies fails its task, and another one takes its place.
 * @return false if the tasks were stopped. Processes that were stopped have ended as after Ctrl-C.
 * @throws UserError if no process starts
 */
bool carry_out_side_by_side(const std::string &file,
                            const unsigned int n_processes,
                            const std::string &errors,
                            const WorkerTasks &tasks);
} // namespace mesoslip

#endif
