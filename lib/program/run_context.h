#ifndef mesoslip_program_run_context_h
#define mesoslip_program_run_context_h

#include "base/timer.h"
#include "program/command_line.h"
#include "program/folder_lock.h"
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
 * Progress display of a run: percentage, simulated time, cell updates per second,
 * remaining time. A refreshed line on a terminal, otherwise a plain line now and then.
 */
class Progress
{
public:
  /** Kind of display. */
  enum class Mode
  {
    off,
    /** A line every ten seconds or tenth of the run, at most one per second. */
    plain,
    /** A line refreshed five times a second. */
    terminal
  };

  /** terminal if standard output is a terminal, plain otherwise and under mpirun, off if
   * @p quiet. */
  static Mode choose_mode(const bool quiet);

  /** Writes to @p stream, which must outlive it. */
  Progress(std::ostream &stream, const Mode chosen_mode);

  /**
   * Begins the activity @p name of @p total_steps steps that each update @p n_cells
   * cells (0: no speed is shown). @p first_step is the start of a resumed run.
   */
  void start(const std::string &name,
             const std::uint64_t total_steps,
             const std::uint64_t n_cells    = 0,
             const std::uint64_t first_step = 0);

  /**
   * Called after step @p step (counted from 1); cheap if nothing has to be shown.
   * Activities without time, such as load cases, give no @p simulated_time (s).
   */
  void update(const std::uint64_t step,
              const double simulated_time = std::numeric_limits<double>::quiet_NaN());

  /** Clears the line on a terminal, so that other output may follow. */
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
 * Environment of a run: output folder, log, progress, timings and summary. Members are
 * collective unless documented otherwise; only rank 0 writes.
 *
 * Include <nlohmann/json.hpp> to fill the summary.
 */
class RunContext
{
public:
  /**
   * Creates and locks the output folder, opens its log, removes `terminate` and, unless
   * the run is to be resumed, calls begin(). From then on SIGINT and SIGTERM request a
   * stop; another one, two seconds or more later, ends the process with status 130. The
   * output folder is @p line.output, @p original is the text of the .prm, @p effective
   * the output of print_parameters(), @p timer has the times since the process began.
   * @throws UserError.
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
  /** Whether this is rank 0, which writes HDF5 files. */
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
   * Takes possession of the folder: removes an old summary.json, writes original.prm and
   * parameters.prm. A resumed run calls it once it is certain that it can continue;
   * otherwise the folder stays as it was.
   */
  void begin();

  /**
   * Removes the files @p names, which this run will write, from the output folder,
   * including remains of an interruption (`NAME.part`). On rank 0.
   */
  void remove_results(const std::vector<std::string> &names);

  /** Removes the remains of these files after a failed run. On rank 0. */
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

  /** Writes a line to the console (unless --quiet) and log.txt. */
  void log(const std::string &line);

  /** Writes a line to log.txt only. */
  void log_to_file(const std::string &line);

  /**
   * Writes one sentence to stderr (also with --quiet) and to log.txt, marked as a
   * warning, and appends it to the list `warnings` of summary.json unless it is there
   * already. Only rank 0 writes.
   */
  void warn(const std::string &line);

  /** The progress display; call its start() first. */
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
   * Content of summary.json. Prefilled: program, version, dim, cells, dofs (null until
   * set), ranks, warnings; seconds and peak_memory_bytes are filled in when it is
   * written.
   */
  nlohmann::json &summary()
  {
    return *run_summary;
  }

  /**
   * Whether to save the state and stop: SIGINT, SIGTERM or a file `terminate` in the
   * output folder (checked four times a second, by rank 0). Valid for this rank only:
   * the ranks have to agree, as in stop_requested().
   */
  bool stop_requested_here();

  /**
   * Whether any rank is asked to stop, the same on all ranks. Collective; cheap on one
   * rank, an all-reduce on several: call it every few steps.
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
  std::vector<std::string> results; ///< names given to remove_results()
  std::chrono::steady_clock::time_point next_look;
};
} // namespace mesoslip

#endif
