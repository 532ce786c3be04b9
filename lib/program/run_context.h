#ifndef mesoslip_program_run_context_h
#define mesoslip_program_run_context_h

#include "base/timer.h"
#include "program/command_line.h"
#include "program/output_folder.h"

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <cstdint>
#include <fstream>
#include <iosfwd>
#include <limits>
#include <memory>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * How far a run is: percentage, simulated time, cell updates a second, remaining time.
 * One refreshed line on a terminal, otherwise a plain line now and then.
 */
class Progress
{
public:
  /** How progress is shown. */
  enum class Mode
  {
    off,
    /** A line every ten seconds or tenth of the run, never more than one a second. */
    plain,
    /** One line, refreshed five times a second. */
    terminal
  };

  /** Refreshed if standard output is a terminal, plain otherwise and under mpirun, off
   * when @p quiet. */
  static Mode choose_mode(const bool quiet);

  /** Writes to @p stream, which must outlive it. */
  Progress(std::ostream &stream, const Mode chosen_mode);

  /**
   * Begins the activity @p name of @p total_steps steps that each update @p n_cells cells
   * (0: no speed is shown). @p first_step is where a resumed run begins.
   */
  void start(const std::string &name,
             const std::uint64_t total_steps,
             const std::uint64_t n_cells    = 0,
             const std::uint64_t first_step = 0);

  /**
   * After step @p step (counted from 1); cheap when nothing is due to be shown. Activities
   * without time, such as load cases, give no @p simulated_time (s).
   */
  void update(const std::uint64_t step,
              const double simulated_time = std::numeric_limits<double>::quiet_NaN());

  /** Removes the line of a terminal; other output may follow. */
  void clear();

  /** Ends the activity. */
  void finish();

private:
  using Clock = std::chrono::steady_clock;

  void show(const std::uint64_t step,
            const double simulated_time,
            const Clock::time_point now);
  std::string
  line(const std::uint64_t step, const double simulated_time, const double elapsed) const;

  std::ostream &out;
  Mode mode;
  bool colour     = false;
  bool active     = false;
  bool line_shown = false;
  std::string activity;
  std::uint64_t total      = 0;
  std::uint64_t cells      = 0;
  std::uint64_t first      = 0;
  std::uint64_t next_tenth = 0;
  Clock::time_point begin;
  Clock::time_point next;
};

/** "2 h 05 min", "3 min 07 s", "4.2 s". */
std::string duration_text(const double seconds);

/**
 * What a run has around it: its output folder, log, progress, timings and summary.
 * Members are called by all ranks unless said otherwise; only rank 0 writes.
 *
 * Include <nlohmann/json.hpp> to fill the summary.
 */
class RunContext
{
public:
  /**
   * Creates and locks the output folder, opens its log, removes `terminate` and, unless
   * the run is to be resumed, calls begin(). From then on SIGINT and SIGTERM ask for a
   * stop; another one, two seconds or more later, ends the process with status 130.
   * In @p line the output is that of the run. @p original is the text of the .prm,
   * @p effective what print_parameters() gave, @p timer has the times since the process began. @throws UserError.
   */
  RunContext(const std::string &program,
             const CommandLine &line,
             const MPI_Comm communicator,
             const std::string &original,
             const std::string &effective,
             Timer &timer);
  ~RunContext();
  RunContext(const RunContext &)            = delete;
  RunContext &operator=(const RunContext &) = delete;

  /** The communicator of all ranks of the run. */
  MPI_Comm communicator() const
  {
    return comm;
  }

  /** The number of this process, from 0. */
  int rank() const
  {
    return my_rank;
  }

  /** Number of processes. */
  int n_ranks() const
  {
    return size;
  }
  /** Whether this is rank 0, the one that writes files with HDF5. */
  bool root() const
  {
    return my_rank == 0;
  }

  /** The command line. */
  const CommandLine &options() const
  {
    return run_options;
  }
  /** Whether to continue from the checkpoint in the output folder. */
  bool resume() const
  {
    return run_options.resume;
  }

  /**
   * From here on the folder is that of this run: removes an old summary.json, writes
   * original.prm and parameters.prm. A run that is resumed calls it once it is clear that
   * it can go on; one that never does leaves the folder as it was.
   */
  void begin();

  /**
   * Removes the files @p names, which this run is going to write anew, from the output
   * folder, and what an interruption has left of them (`NAME.part`). Rank 0 does.
   */
  void remove_results(const std::vector<std::string> &names);

  /** Removes what a run that failed has left of them. Rank 0 does. */
  void remove_begun_results() const;

  /** Whether begin() was called. */
  bool has_begun() const
  {
    return begun;
  }

  /** Path of the output folder, as asked for. */
  const std::string &output_folder() const
  {
    return run_options.output;
  }
  /** Path of a file in the output folder. */
  std::string file(const std::string &name) const;

  /** One line to the console (unless --quiet) and log.txt. */
  void log(const std::string &line);

  /** One line to log.txt only. */
  void log_to_file(const std::string &line);

  /**
   * Writes one sentence to stderr (also with --quiet) and to log.txt, marked as a
   * warning, and appends it to the list `warnings` of summary.json unless it is there
   * already. Only rank 0 writes.
   */
  void warn(const std::string &line);

  /** The progress display; start() it with the total. */
  Progress &progress()
  {
    return *progress_display;
  }

  /** Nested timings: `auto scope = context.timer().scope("Operator");`. */
  Timer &timer()
  {
    return run_timer;
  }

  /**
   * Becomes summary.json. Prefilled: program, version, dim, cells, dofs (null until
   * set), ranks, warnings; seconds and peak_memory_bytes are filled in when it is
   * written.
   */
  nlohmann::json &summary()
  {
    return *run_summary;
  }

  /**
   * Whether to save the state and stop: SIGINT, SIGTERM or a file `terminate` in the
   * output folder (looked for four times a second, by rank 0). Of this rank only: the
   * ranks have to agree on it, as stop_requested() does.
   */
  bool stop_requested_here();

  /**
   * The same on all ranks, once one is asked to stop. Collective; cheap on one rank, an
   * all-reduce on several: call it every few steps.
   */
  bool stop_requested();

  /** Writes summary.json; run_program() calls it after a successful run. */
  void write_summary();

private:
  const std::string program;
  const CommandLine run_options;
  MPI_Comm comm;
  int my_rank = 0;
  int size    = 1;
  std::unique_ptr<FolderLock> lock;
  std::ofstream log_file;
  std::unique_ptr<Progress> progress_display;
  Timer &run_timer;
  std::unique_ptr<nlohmann::json> run_summary;
  const std::string original_parameters, effective_parameters;
  bool begun = false;
  std::vector<std::string> results; ///< names in remove_results()
  std::chrono::steady_clock::time_point next_look;
};
} // namespace mesoslip

#endif
