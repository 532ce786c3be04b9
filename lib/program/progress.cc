#include "program/run_context.h"

#include "base/exchange.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ostream>
#include <unistd.h>

namespace mesoslip
{
namespace
{
constexpr std::chrono::milliseconds refresh_interval(200);
constexpr std::chrono::seconds line_interval(10);
/** Ten lines per run are fine, unless the run is very short. */
constexpr std::chrono::seconds shortest_interval(1);

std::string format(const char *pattern, const double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}
} // namespace

std::string duration_text(const double seconds)
{
  if (!(seconds >= 0.) || seconds > 3.e8)
    return "?";
  char text[64];
  const long s = std::lround(seconds);
  if (seconds < 10.)
    std::snprintf(text, sizeof(text), "%.1f s", seconds);
  else if (s < 60)
    std::snprintf(text, sizeof(text), "%ld s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof(text), "%ld min %02ld s", s / 60, s % 60);
  else
    std::snprintf(text, sizeof(text), "%ld h %02ld min", s / 3600, s % 3600 / 60);
  return text;
}

Progress::Mode Progress::choose_mode(const bool quiet)
{
  if (quiet)
    return Mode::off;
  // Under mpirun an apparent terminal is its pipe, which may end in a file.
  return isatty(STDOUT_FILENO) && !started_by_mpirun() ? Mode::terminal : Mode::plain;
}

Progress::Progress(std::ostream &stream, const Mode chosen_mode)
  : out(stream)
  , mode(chosen_mode)
  , colour(chosen_mode == Mode::terminal && std::getenv("NO_COLOR") == nullptr)
{
}

void Progress::start(const std::string &name,
                     const std::uint64_t total_steps,
                     const std::uint64_t n_cells,
                     const std::uint64_t first_step)
{
  finish();
  active     = true;
  activity   = name;
  total      = std::max<std::uint64_t>(total_steps, 1);
  cells      = n_cells;
  first      = first_step;
  next_tenth = (10 * first / total + 1) * total / 10;
  begin      = Clock::now();
  next       = begin + (mode == Mode::terminal ? Clock::duration(refresh_interval)
                                               : Clock::duration(line_interval));
}

void Progress::update(const std::uint64_t step, const double simulated_time)
{
  if (mode == Mode::off || !active)
    return;
  const Clock::time_point now = Clock::now();
  if (now >= next || (mode == Mode::plain && step >= next_tenth &&
                      now >= next - line_interval + shortest_interval))
    show(step, simulated_time, now);
}

void Progress::show(const std::uint64_t step,
                    const double simulated_time,
                    const Clock::time_point now)
{
  const double elapsed   = std::chrono::duration<double>(now - begin).count();
  const std::string text = line(step, simulated_time, elapsed);
  if (mode == Mode::terminal)
    {
      out << '\r' << (colour ? "\033[36m" : "") << text << (colour ? "\033[0m" : "")
          << "\033[K" << std::flush;
      line_shown = true;
      next       = now + refresh_interval;
    }
  else
    {
      out << text << std::endl;
      next = now + line_interval;
      while (next_tenth <= step)
        next_tenth += std::max<std::uint64_t>(total / 10, 1);
    }
}

std::string Progress::line(const std::uint64_t step,
                           const double simulated_time,
                           const double elapsed) const
{
  const double done = static_cast<double>(step - std::min(step, first));
  std::string text =
    activity + " " + format("%5.1f %%", 100. * static_cast<double>(step) / total);
  if (std::isfinite(simulated_time))
    text += "  t = " + format("%.4g", simulated_time) + " s";
  if (cells > 0 && elapsed > 0.)
    text += "  " + format("%.3g", 1.e-6 * done * cells / elapsed) + " M cell updates/s";
  if (done > 0. && step < total)
    text += "  remaining " + duration_text(elapsed * (total - step) / done);
  return text;
}

void Progress::clear()
{
  if (!line_shown)
    return;
  out << "\r\033[K" << std::flush;
  line_shown = false;
}

void Progress::finish()
{
  clear();
  active = false;
}
} // namespace mesoslip
