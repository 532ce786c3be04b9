#include "sliding/sweep/sweep_parameters.h"

#include "base/text.h"
#include "parameters/keys.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <regex>

namespace mesoslip
{
namespace
{
/** The value at @p share of the way from one end to the other. */
double between(const SweepAxis &axis, const double share)
{
  return rounded(axis.logarithmic ? axis.from * std::pow(axis.to / axis.from, share)
                                  : axis.from + share * (axis.to - axis.from));
}

/** Parts of "Section/Key[2]". */
SweptKey parsed(const std::string &text)
{
  static const std::regex with_entry("(.*\\S)\\s*\\[([1-9][0-9]{0,5})\\]");
  std::smatch found;
  if (!std::regex_match(text, found, with_entry))
    return {text, text, 0, {}};
  return {text, found[1], std::stoul(found[2]), {}};
}

/** Adds what the file has in the lists, and checks that every key accepts all @p values.
 */
void check_keys(const Keys &keys, SweepAxis &axis, const std::vector<double> &values)
{
  keys.require(!axis.keys.empty(), "Key",
               "it is empty; name the key that changes, as Supports/Top/Pressure");
  for (SweptKey &swept : axis.keys)
    {
      keys.require(keys.has(swept.path) && swept.path.rfind("Sweep/", 0) != 0, "Key",
                   "there is no key " + swept.path +
                     "; write it as Section/Key, as --print-parameters has it");
      const Key &key =
        *std::find_if(keys.all().begin(), keys.all().end(),
                      [&](const Key &k) { return k.path() == swept.path; });
      swept.list = split_list(key.value);
      keys.require(swept.entry <= swept.list.size(), "Key",
                   swept.path + " has " + std::to_string(swept.list.size()) +
                     " values in the file, and [" + std::to_string(swept.entry) +
                     "] is none of them; give it all its values there");
      for (const double value : values)
        keys.require(!key.is_input && key.accepts(swept.with(value)), "Key",
                     swept.path + " cannot be " + swept.with(value) + ": it must be " +
                       key.allowed);
    }
}

void bind_values(Keys &keys, SweepAxis &axis)
{
  std::vector<std::string> texts = texts_of(axis.keys);
  keys.bind_list("Key", texts, {},
                 "Key that takes the values, as Supports/Top/Pressure, or one number of "
                 "a list, as Body/Size[2]; several, separated by commas, take the same "
                 "value");
  axis.keys.clear();
  for (const std::string &text : texts)
    axis.keys.push_back(parsed(text));
  keys.bind_list("Values", axis.values, Range::any(),
                 "Its values; empty: those from From to To [unit of the key]", 0, 100000);
  keys.bind("From", axis.from, Range::any(), "First value [unit of the key]");
  keys.bind("To", axis.to, Range::any(), "Last value [unit of the key]");
  keys.bind("Number", axis.number, 0, 100000,
            "Number of values from the first to the last [-]");
  keys.bind("Spacing", axis.logarithmic, {"linear", "logarithmic"},
            "Whether the values, or random ones, are equally spaced or equally likely as "
            "they are or in their logarithms");
}

void bind_axis(Keys &keys, SweepAxis &axis, const SweepPoints points)
{
  const auto section = keys.section(axis.name);
  bind_values(keys, axis);
  if (!keys.are_read())
    return;
  const bool is_random = points == SweepPoints::random;
  keys.only_if(!is_random, {"Values", "Number"}, "the points are random",
               "set Sweep/Points = grid");
  keys.only_if(axis.values.empty(), {"From", "To", "Number", "Spacing"},
               "the values are listed", "leave Values empty");
  if (axis.values.empty())
    {
      keys.require(axis.from != axis.to, "To",
                   "it equals From; set both, or list the values in Values");
      keys.require(!axis.logarithmic || axis.from * axis.to > 0., "Spacing",
                   "logarithms need From and To of one sign and none of them 0");
      keys.require(is_random || axis.number >= 2, "Number",
                   "at least 2 values lead from From to To; or list them in Values");
      for (unsigned int k = 0; k < (is_random ? 0 : axis.number); ++k)
        axis.values.push_back(between(axis, k / (axis.number - 1.)));
    }
  check_keys(keys, axis,
             axis.values.empty() ? std::vector<double>{axis.from, axis.to} : axis.values);
}

/** Binds axes with a subsection that are not among @p names, such as axes of a map
 * switched off by --set. */
void bind_other_axes(Keys &keys, const std::vector<std::string> &names)
{
  for (const std::string &name : keys.typed_sections())
    if (std::count(names.begin(), names.end(), name) == 0)
      {
        {
          const auto section = keys.section(name);
          SweepAxis unused;
          bind_values(keys, unused);
        }
        keys.only_if(false, {name + "/"}, name + " is not among Sweep/Axes",
                     "name it there");
      }
}
} // namespace

double rounded(const double value)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.12g", value);
  return std::strtod(text, nullptr);
}

std::string SweptKey::with(const double value) const
{
  if (entry == 0)
    return to_text(value);
  std::vector<std::string> words = list;
  words[entry - 1]               = to_text(value);
  return to_text(words);
}

std::vector<std::string> texts_of(const std::vector<SweptKey> &keys)
{
  std::vector<std::string> texts;
  for (const SweptKey &key : keys)
    texts.push_back(key.text);
  return texts;
}

void SweepParameters::bind(Keys &keys)
{
  const auto section = keys.section("Sweep");
  std::vector<std::string> names;
  for (const SweepAxis &axis : axes)
    names.push_back(axis.name);
  keys.bind_names("Axes", names, "axis",
                  "Names of what changes from point to point of a map, each with a "
                  "subsection of that name; empty: one run",
                  20);
  keys.bind(
    "Points", points, {"grid", "pairs", "random"},
    "grid: each value of an axis with each of the others; pairs: the first values "
    "of all axes, then the second ones, and so on; random: between the ends of "
    "the axes");
  keys.bind(
    "Continue", continuation, {"none", "up", "down", "both"},
    "Start points from the end of their neighbours along the first axis (Time/Continue "
    "from): up, from its first value to the last, down, or both, up and then down "
    "again, as two branches of the map");
  keys.bind("Random points", n_random, 1, 1000000, "Number of random points [-]");
  keys.bind(
    "Seed", seed, 0, 2000000000,
    "Seed of random points; with the same seed more points contain the fewer [-]");
  keys.bind_or_auto(
    "Processes", processes, 1024,
    "Points computed side by side, each by a process of its own; auto: as "
    "many as there are cores. Under mpirun all ranks compute one point "
    "after the other [-]");
  keys.bind("Complex modes", complex_modes,
            "Also compute the complex modes of steady sliding at each point");
  keys.bind("Border tolerance", border_tolerance, Range::closed(0., 0.5),
            "Largest error, relative to the value of a key, of the border at which the "
            "fastest complex mode neither grows nor decays; found by more complex modes "
            "between neighbouring points of a grid of which one has a growing mode and "
            "the other has none; 0: no border [-]");
  keys.bind(
    "Skip stable", skip_stable,
    "Compute the complex modes first, and do not run points at which all vibrations "
    "of steady sliding up to Complex modes/Highest frequency decay; one that is "
    "pushed hard may vibrate all the same");
  keys.bind("Keep results", keep_results,
            "Keep histories, fields and tables of each point, not only its summary");
  axes.resize(names.size());
  for (std::size_t a = 0; a < names.size(); ++a)
    {
      axes[a].name = names[a];
      bind_axis(keys, axes[a], points);
    }
  bind_other_axes(keys, names);
  if (!keys.are_read())
    return;
  keys.only_if(
    !axes.empty(),
    {"Points", "Continue", "Processes", "Complex modes", "Skip stable", "Keep results"},
    "there are no axes", "set Sweep/Axes");
  keys.only_if(points == SweepPoints::random, {"Random points", "Seed"},
               "the points are not random", "set Sweep/Points = random");
  keys.only_if(points == SweepPoints::grid, {"Border tolerance"},
               "the points are no grid", "set Sweep/Points = grid");
  keys.only_if(complex_modes, {"Skip stable", "Border tolerance"},
               "no complex modes are computed", "set Sweep/Complex modes = true");
  keys.require(
    !skip_stable || continuation == Continuation::none, "Skip stable",
    "with Continue points start from the end of their neighbours, which have to "
    "be run; leave one of both");
  keys.only_if(points == SweepPoints::grid, {"Continue"}, "the points are no grid",
               "set Sweep/Points = grid");
  if (points == SweepPoints::pairs)
    for (const SweepAxis &axis : axes)
      keys.require(axis.values.size() == axes[0].values.size(), "Points",
                   "pairs need as many values on all axes, but " + axes[0].name +
                     " has " + std::to_string(axes[0].values.size()) + " and " +
                     axis.name + " " + std::to_string(axis.values.size()));
  for (std::size_t a = 0; a < axes.size(); ++a)
    for (const SweptKey &key : axes[a].keys)
      for (std::size_t b = 0; b < a; ++b)
        for (const SweptKey &other : axes[b].keys)
          keys.require(!key.overlaps(other), "Axes",
                       axes[b].name + " and " + axes[a].name + " both set " + key.text);
  if (continuation == Continuation::both)
    {
      keys.require(
        std::count(names.begin(), names.end(), "branch") == 0, "Axes",
        "'branch' is the axis of both directions of Sweep/Continue = both; name "
        "it otherwise");
      SweepAxis branch;
      branch.name   = "branch";
      branch.values = {1., -1.};
      axes.insert(axes.begin(), branch);
    }
  std::size_t n = 1;
  for (const std::size_t of_axis : shape())
    n *= of_axis;
  keys.require(n <= 1000000, "Axes",
               "the map has " + std::to_string(n) + " points; a million is the most");
}

std::vector<std::size_t> SweepParameters::shape() const
{
  if (points == SweepPoints::random)
    return {n_random};
  std::vector<std::size_t> result;
  for (const SweepAxis &axis : axes)
    if (points == SweepPoints::grid || result.empty())
      result.push_back(axis.values.size());
  return result;
}

std::vector<std::vector<double>> SweepParameters::all_points() const
{
  std::size_t n = 1;
  for (const std::size_t of_axis : shape())
    n *= of_axis;
  std::vector<std::vector<double>> result(n, std::vector<double>(axes.size()));
  std::mt19937_64 generator(seed);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t a = axes.size(), rest = k; a-- > 0;)
      {
        const std::vector<double> &values = axes[a].values;
        if (points == SweepPoints::random)
          // Uses the upper 53 bits, as standard distributions differ between libraries.
          result[k][a] =
            between(axes[a], static_cast<double>(generator() >> 11U) * 0x1p-53);
        else if (points == SweepPoints::pairs)
          result[k][a] = values[k];
        else
          {
            result[k][a] = values[rest % values.size()];
            rest /= values.size();
          }
      }
  return result;
}

std::optional<std::size_t> SweepParameters::point_before(const std::size_t k) const
{
  if (continuation == Continuation::none)
    return std::nullopt;
  const bool has_branches                = continuation == Continuation::both;
  const std::vector<std::size_t> extents = shape();
  std::size_t stride = 1; // index distance to the neighbour along the first axis
  for (std::size_t a = has_branches ? 2 : 1; a < extents.size(); ++a)
    stride *= extents[a];
  const std::size_t n = extents[has_branches ? 1 : 0], of_branch = n * stride;
  const std::size_t place = k % of_branch / stride;
  const bool is_down      = continuation == Continuation::down || k >= of_branch;
  if (!is_down)
    return place > 0 ? std::optional(k - stride) : std::nullopt;
  if (place + 1 < n)
    return k + stride;
  return has_branches ? std::optional(k - of_branch) : std::nullopt;
}
} // namespace mesoslip
