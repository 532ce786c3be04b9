#include "base/timer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <utility>

namespace mesoslip
{
Timer::Scope::Scope(Timer &owner)
  : timer(&owner)
{
}

Timer::Scope::Scope(Scope &&other) noexcept
  : timer(std::exchange(other.timer, nullptr))
{
}

Timer::Scope::~Scope()
{
  if (timer == nullptr)
    return;
  Section &section = *timer->current;
  section.elapsed += Clock::now() - section.entered;
  section.open   = false;
  timer->current = section.parent;
}

Timer::Timer()
{
  all.name = "total";
  all.rest = "other";
}

Timer::Scope Timer::scope(const char *name, const char *rest)
{
  auto found = std::find_if(current->inside.begin(), current->inside.end(),
                            [name](const Section &s) { return s.name == name; });
  if (found == current->inside.end())
    {
      found         = current->inside.emplace(found);
      found->name   = name;
      found->path   = (current == &all ? "" : current->path + "/") + name;
      found->rest   = rest;
      found->parent = current;
      found->depth  = current->depth + 1;
    }
  current = &*found;
  ++current->calls;
  current->open    = true;
  current->entered = Clock::now();
  return Scope(*this);
}

std::optional<Timer::Scope>
optional_scope(Timer *timer, const char *name, const char *rest)
{
  if (timer == nullptr)
    return std::nullopt;
  return timer->scope(name, rest);
}

double Timer::seconds(const Section &section, const Clock::time_point now)
{
  const auto running = section.open ? now - section.entered : Clock::duration::zero();
  return std::chrono::duration<double>(section.elapsed + running).count();
}

double Timer::rest_of(const Section &section, const Clock::time_point now)
{
  double rest = seconds(section, now);
  for (const Section &inner : section.inside)
    rest -= seconds(inner, now);
  return std::max(0., rest);
}

double Timer::total() const
{
  return seconds(all, Clock::now());
}

void Timer::print(std::ostream &out) const
{
  const auto now     = Clock::now();
  const double total = seconds(all, now);
  std::ostringstream table;
  table << std::left << std::setw(44) << "section" << std::right << std::setw(12)
        << "calls" << std::setw(13) << "seconds" << std::setw(10) << "share" << '\n'
        << std::fixed;
  const auto row = [&](const std::string &name, const unsigned int depth,
                       const std::string &calls, const double time) {
    table << std::left << std::setw(44) << std::string(std::size_t{2} * depth, ' ') + name
          << std::right << std::setw(12) << calls << std::setprecision(3) << std::setw(13)
          << time << std::setprecision(1) << std::setw(8)
          << (total > 0. ? 100. * time / total : 0.) << " %\n";
  };
  // The rest follows the inner sections.
  const auto print = [&](const Section &section, const auto &self) -> void {
    row(section.name, section.depth,
        section.calls > 0 ? std::to_string(section.calls) : "", seconds(section, now));
    for (const Section &inner : section.inside)
      self(inner, self);
    if (!section.inside.empty())
      row(section.rest, section.depth + 1, "", rest_of(section, now));
  };
  print(all, print);
  out << table.str();
}

nlohmann::json Timer::json() const
{
  const auto now     = Clock::now();
  nlohmann::json out = {{"total", seconds(all, now)}};
  const auto collect = [&](const Section &section, const auto &self) -> void {
    for (const Section &inner : section.inside)
      {
        out[inner.path] = seconds(inner, now);
        if (inner.rest != "other")
          out[inner.path + "/" + inner.rest] = rest_of(inner, now);
        self(inner, self);
      }
  };
  collect(all, collect);
  return out;
}
} // namespace mesoslip
