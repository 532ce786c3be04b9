#ifndef mesoslip_base_timer_h
#define mesoslip_base_timer_h

#include <chrono>
#include <deque>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Wall-clock times of nested sections of one process. A section entered again adds to
 * its time. Entering costs some 50 ns: fit for each step, not for each cell.
 */
class Timer
{
public:
  /** Times a section until it goes out of scope. */
  class Scope
  {
  public:
    /** Moves the duty to stop the clock. */
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
   * Enters the section @p name inside the current one. Its time that is in no section
   * inside is shown as @p rest.
   */
  [[nodiscard]] Scope scope(const char *name, const char *rest = "other");

  /** Seconds since construction. */
  double total() const;

  /** Seconds spent so far in "Outer/Inner"; 0 if never entered. */
  double seconds(const std::string &path) const;

  /** Table of sections, calls, seconds, share. What is inside a section, with the rest,
   *  sums to it. */
  void print(std::ostream &out) const;

  /** {"total": s, "Outer": s, "Outer/Inner": s, ...}; rests unless they are "other". */
  nlohmann::json json() const;

private:
  using Clock = std::chrono::steady_clock;

  struct Node
  {
    std::string name, rest = "other";
    Node *parent = nullptr;
    std::vector<Node *> children;
    Clock::duration elapsed = Clock::duration::zero();
    Clock::time_point entered;
    unsigned long calls = 0;
  };

  void leave();
  // A table is of one moment: sections may still be open.
  double seconds(const Node &node, const Clock::time_point now) const;
  double rest_of(const Node &node, const Clock::time_point now) const;
  void print(std::ostream &out,
             const Node &node,
             const unsigned int depth,
             const Clock::time_point now) const;
  void collect(nlohmann::json &out,
               const Node &node,
               const std::string &prefix,
               const Clock::time_point now) const;

  std::deque<Node> nodes;
  Node *current;
};

/** timer->scope(name, rest); nothing where there is no timer. */
[[nodiscard]] std::optional<Timer::Scope>
optional_scope(Timer *timer, const char *name, const char *rest = "other");
} // namespace mesoslip

#endif
