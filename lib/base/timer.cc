#include "base/timer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace mesoslip
{
Timer::Scope::Scope(Timer &owner)
  : timer(&owner)
{
}

Timer::Scope::Scope(Scope &&other) noexcept
  : timer(other.timer)
{
  other.timer = nullptr;
}

Timer::Scope::~Scope()
{
  if (timer != nullptr)
    timer->leave();
}

Timer::Timer()
{
  nodes.emplace_back();
  current          = &nodes.front();
  current->entered = Clock::now();
}

Timer::Scope Timer::scope(const char *name, const char *rest)
{
  Node *node = nullptr;
  for (Node *child : current->children)
    if (child->name == name)
      node = child;
  if (node == nullptr)
    {
      nodes.emplace_back();
      node         = &nodes.back();
      node->name   = name;
      node->rest   = rest;
      node->parent = current;
      current->children.push_back(node);
    }
  current = node;
  ++node->calls;
  node->entered = Clock::now();
  return Scope(*this);
}

std::optional<Timer::Scope>
optional_scope(Timer *timer, const char *name, const char *rest)
{
  if (timer == nullptr)
    return std::nullopt;
  return timer->scope(name, rest);
}

void Timer::leave()
{
  current->elapsed += Clock::now() - current->entered;
  current = current->parent;
}

double Timer::seconds(const Node &node, const Clock::time_point now) const
{
  Clock::duration elapsed = node.elapsed;
  for (const Node *open = current; open != nullptr; open = open->parent)
    if (open == &node)
      elapsed += now - node.entered;
  return std::chrono::duration<double>(elapsed).count();
}

double Timer::rest_of(const Node &node, const Clock::time_point now) const
{
  double rest = seconds(node, now);
  for (const Node *child : node.children)
    rest -= seconds(*child, now);
  return std::max(0., rest);
}

double Timer::total() const
{
  return seconds(nodes.front(), Clock::now());
}

double Timer::seconds(const std::string &path) const
{
  const Node *node = &nodes.front();
  std::istringstream names(path);
  std::string name;
  while (std::getline(names, name, '/'))
    {
      const auto child = std::find_if(node->children.begin(), node->children.end(),
                                      [&](const Node *c) { return c->name == name; });
      if (child == node->children.end())
        return 0.;
      node = *child;
    }
  return seconds(*node, Clock::now());
}

namespace
{
void print_row(std::ostream &out,
               const std::string &name,
               const unsigned int depth,
               const unsigned long calls,
               const double seconds,
               const double total)
{
  std::ostringstream row;
  row << std::left << std::setw(44) << std::string(std::size_t{2} * depth, ' ') + name
      << std::right;
  if (calls > 0)
    row << std::setw(12) << calls;
  else
    row << std::setw(12) << "";
  row << std::fixed << std::setprecision(3) << std::setw(13) << seconds
      << std::setprecision(1) << std::setw(8)
      << (total > 0. ? 100. * seconds / total : 0.) << " %\n";
  out << row.str();
}
} // namespace

void Timer::print(std::ostream &out,
                  const Node &node,
                  const unsigned int depth,
                  const Clock::time_point now) const
{
  const double all = seconds(nodes.front(), now);
  print_row(out, depth == 0 ? "total" : node.name, depth, node.calls, seconds(node, now),
            all);
  for (const Node *child : node.children)
    print(out, *child, depth + 1, now);
  if (!node.children.empty())
    print_row(out, node.rest, depth + 1, 0, rest_of(node, now), all);
}

void Timer::print(std::ostream &out) const
{
  std::ostringstream heading;
  heading << std::left << std::setw(44) << "section" << std::right << std::setw(12)
          << "calls" << std::setw(13) << "seconds" << std::setw(10) << "share";
  out << heading.str() << '\n';
  print(out, nodes.front(), 0, Clock::now());
}

void Timer::collect(nlohmann::json &out,
                    const Node &node,
                    const std::string &prefix,
                    const Clock::time_point now) const
{
  for (const Node *child : node.children)
    {
      const std::string path = prefix + child->name;
      out[path]              = seconds(*child, now);
      if (child->rest != "other")
        out[path + "/" + child->rest] = rest_of(*child, now);
      collect(out, *child, path + "/", now);
    }
}

nlohmann::json Timer::json() const
{
  const auto now     = Clock::now();
  nlohmann::json out = {{"total", seconds(nodes.front(), now)}};
  collect(out, nodes.front(), "", now);
  return out;
}
} // namespace mesoslip
