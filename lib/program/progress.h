#ifndef mesoslip_program_progress_h
#define mesoslip_program_progress_h

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>

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
} // namespace mesoslip

#endif
