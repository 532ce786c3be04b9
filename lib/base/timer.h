#ifndef mesoslip_base_timer_h
#define mesoslip_base_timer_h

#include <chrono>
#include <iosfwd>
#include <list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mesoslip
{
/**
 * Wall-clock times of nested sections of one process. Times of a repeated section add up.
 * Entering costs about 50 ns: use it once per step, not once per cell.
 */
class Timer
{
public:
  /** Times a section until it goes out of scope. */
  class Scope
  {
  public:
    /** Transfers the scope; @p other no longer stops the clock. */
    Scope(Scope &&other) noexcept;
    Scope(const Scope &) = delete;
    ~Scope();

  private:
    friend class Timer;
    explicit Scope(Timer &owner);
    Timer *timer;
  };

  Timer();

  /**
   * Enters the section @p name inside the current one. The time that no inner section
   * covers is listed as @p rest.
   */
  [[nodiscard]] Scope scope(const char *name, const char *rest = "other");

  /** Seconds since construction. */
  double total() const;

  /**
   * Table of sections with calls, seconds and share. Inner sections and the rest add up
   * to the section.
   */
  void print(std::ostream &out) const;

  /** {"total": s, "Outer": s, "Outer/Inner": s, ...}; without rests called "other". */
  nlohmann::json json() const;

private:
  using Clock = std::chrono::steady_clock;

  struct Section
  {
    std::string name, path, rest;
    Section *parent           = nullptr;
    unsigned int depth        = 0;
    unsigned long calls       = 0;
    Clock::duration elapsed   = Clock::duration::zero();
    Clock::time_point entered = Clock::now();
    bool open                 = true;
    std::list<Section> inside;
  };

  // All times of a table refer to the same instant: sections may still be open.
  static double seconds(const Section &section, const Clock::time_point now);
  static double rest_of(const Section &section, const Clock::time_point now);

  Section all;
  Section *current = &all;
};

/** timer->scope(name, rest), or empty if there is no timer. */
[[nodiscard]] std::optional<Timer::Scope>
optional_scope(Timer *timer, const char *name, const char *rest = "other");
} // namespace mesoslip

#endif
