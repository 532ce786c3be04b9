#include "parameters/keys.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/base/exceptions.h>

#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace mesoslip
{
namespace
{
constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

std::string in_words(const std::string &kind, const std::string &range)
{
  return kind + (range.empty() ? "" : " " + range);
}

std::string range_text(const long lower, const long upper)
{
  const bool below = lower != std::numeric_limits<long>::min();
  const bool above = upper != std::numeric_limits<long>::max();
  if (below && above)
    return "in [" + std::to_string(lower) + ", " + std::to_string(upper) + "]";
  return below ? ">= " + std::to_string(lower)
               : (above ? "<= " + std::to_string(upper) : "");
}

std::string
list_in_words(const std::string &items, const std::size_t min, const std::size_t max)
{
  const std::string count = min == max ? std::to_string(min) + " "
                            : max != any_number
                              ? std::to_string(min) + " to " + std::to_string(max) + " "
                            : min > 0 ? "at least " + std::to_string(min) + " "
                                      : "";
  return count + "comma separated " + items;
}

auto number_in(const Range &range)
{
  return [range](const std::string &text, double &value) {
    return parse_number(trimmed(text), value) && range.contains(value);
  };
}

auto integer_in(const long lower, const long upper)
{
  return [lower, upper](const std::string &text, long &value) {
    return parse_number(trimmed(text), value) && value >= lower && value <= upper;
  };
}

bool contains(const std::vector<std::string> &words, const std::string &word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/** Reader of a list with @p min to @p max items that @p read accepts. */
template <typename T, typename ItemReader>
auto list_of(const std::size_t min, const std::size_t max, const ItemReader &read)
{
  return [=](const std::string &text, std::vector<T> &values) {
    const std::vector<std::string> items = split_list(text);
    values.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      if (!read(items[i], values[i]))
        return false;
    return items.size() >= min && items.size() <= max;
  };
}

bool take_text(const std::string &text, std::string &value)
{
  value = text;
  return true;
}

bool read_bool(const std::string &text, bool &value)
{
  value = contains({"true", "yes", "on"}, text);
  return value || contains({"false", "no", "off"}, text);
}
} // namespace

Keys::Keys(const RawParameters &raw_parameters)
  : raw(raw_parameters)
{
}

std::string Keys::path(const std::string &key) const
{
  return current_section.empty() ? key : current_section + "/" + key;
}

template <typename T>
void Keys::bind_value(const std::string &key,
                      T &value,
                      const std::string &default_value,
                      const std::string &allowed,
                      const Reader<T> &read,
                      const std::string &meaning)
{
  if (reading)
    {
      const bool valid = read(this->value(path(key)), value);
      Assert(valid, dealii::ExcInternalError());
      (void)valid;
      return;
    }
  const auto accepts = [read](const std::string &text) {
    T ignored;
    return read(text, ignored);
  };
  Assert(accepts(default_value),
         dealii::ExcMessage("the default '" + default_value + "' of the parameter '" +
                            key + "' is not " + allowed));
  const bool is_new = index.emplace(path(key), keys.size()).second;
  Assert(is_new, dealii::ExcMessage("the parameter '" + key + "' is declared twice"));
  (void)is_new;
  keys.push_back({current_section, key, default_value, default_value, meaning, allowed,
                  false, false, accepts});
}

void Keys::bind(const std::string &key,
                double &value,
                const Range &range,
                const std::string &meaning)
{
  bind_value<double>(key, value, to_text(value), in_words("a number", range.text()),
                     number_in(range), meaning);
}

void Keys::bind_or_auto(const std::string &key,
                        double &value,
                        const Range &range,
                        const std::string &meaning)
{
  bind_value<double>(
    key, value, std::isnan(value) ? "auto" : to_text(value),
    in_words("auto or a number", range.text()),
    [read = number_in(range)](const std::string &text, double &number) {
      number = std::numeric_limits<double>::quiet_NaN();
      return text == "auto" || read(text, number);
    },
    meaning);
}

void Keys::bind_or_auto(const std::string &key,
                        unsigned int &value,
                        const long upper,
                        const std::string &meaning)
{
  bind_value<unsigned int>(
    key, value, value == 0 ? "auto" : std::to_string(value),
    in_words("auto or a whole number", range_text(1, upper)),
    [read = integer_in(1, upper)](const std::string &text, unsigned int &number) {
      long typed       = 0;
      const bool valid = text == "auto" || read(text, typed);
      number           = static_cast<unsigned int>(typed);
      return valid;
    },
    meaning);
}

void Keys::bind_long(const std::string &key,
                     long &value,
                     const long lower,
                     const long upper,
                     const std::string &meaning)
{
  bind_value<long>(key, value, std::to_string(value),
                   in_words("a whole number", range_text(lower, upper)),
                   integer_in(lower, upper), meaning);
}

void Keys::bind(const std::string &key, bool &value, const std::string &meaning)
{
  bind_value<bool>(key, value, value ? "true" : "false", "true or false", read_bool,
                   meaning);
}

void Keys::bind(const std::string &key, std::string &value, const std::string &meaning)
{
  bind_value<std::string>(key, value, value, "any text", take_text, meaning);
}

void Keys::bind_choice(const std::string &key,
                       std::string &value,
                       const std::vector<std::string> &choices,
                       const std::string &meaning)
{
  bind_value<std::string>(
    key, value, value, "one of " + to_text(choices),
    [choices](const std::string &text, std::string &choice) {
      return take_text(text, choice) && contains(choices, text);
    },
    meaning);
}

void Keys::bind_list(const std::string &key,
                     std::vector<double> &values,
                     const Range &range,
                     const std::string &meaning,
                     const std::size_t min_items,
                     const std::size_t max_items)
{
  bind_value<std::vector<double>>(
    key, values, to_text(values),
    list_in_words(in_words("numbers", range.text()), min_items, max_items),
    list_of<double>(min_items, max_items, number_in(range)), meaning);
}

void Keys::bind_list(const std::string &key,
                     std::vector<long> &values,
                     const long lower,
                     const long upper,
                     const std::string &meaning,
                     const std::size_t min_items,
                     const std::size_t max_items)
{
  std::vector<std::string> items;
  for (const long value : values)
    items.push_back(std::to_string(value));
  bind_value<std::vector<long>>(
    key, values, to_text(items),
    list_in_words(in_words("whole numbers", range_text(lower, upper)), min_items,
                  max_items),
    list_of<long>(min_items, max_items, integer_in(lower, upper)), meaning);
}

void Keys::bind_list(const std::string &key,
                     std::vector<std::string> &words,
                     const std::vector<std::string> &choices,
                     const std::string &meaning)
{
  const auto read = [choices](const std::string &text, std::string &word) {
    return take_text(text, word) && !text.empty() &&
           (choices.empty() || contains(choices, text));
  };
  bind_value<std::vector<std::string>>(
    key, words, to_text(words),
    list_in_words(choices.empty() ? "words" : "words out of " + to_text(choices), 0,
                  any_number),
    list_of<std::string>(0, any_number, read), meaning);
}

void Keys::bind_names(const std::string &key,
                      std::vector<std::string> &names,
                      const std::string &kind,
                      const std::string &meaning,
                      const std::size_t most)
{
  const auto defaults = names;
  bind_list(key, names, {}, meaning);
  const RawParameters::Entry *const entry = raw.find(path(key));
  if (!reading)
    names = entry != nullptr ? split_list(entry->value) : defaults;
  // Checked before each name gets its section.
  if (names.size() > most)
    throw UserError(path(key) + ": there are " + std::to_string(names.size()) + " " +
                    kind + "s; name 1 to " + std::to_string(most));
  std::set<std::string> before;
  for (const std::string &name : names)
    {
      const std::string plain =
        boost::algorithm::trim_fill_copy(name, " ", std::locale::classic());
      // Names become groups of HDF5, where "." is the group itself.
      if (plain.empty() || plain == "." || plain == ".." || plain != name ||
          name.find_first_of("/,\\=#\"'") != std::string::npos)
        throw UserError(path(key) + ": '" + name + "' cannot be the name of a " + kind +
                        "; use letters, digits and single blanks");
      if (!before.insert(name).second)
        throw UserError(path(key) + ": there are two " + kind + "s named '" + name +
                        "'; rename one");
    }
}

bool Keys::is_typed(const std::string &path) const
{
  return raw.find(path) != nullptr;
}

std::vector<std::string> Keys::typed_sections() const
{
  const std::string start = current_section + "/";
  std::vector<std::string> names;
  const auto add = [&](const std::string &path, const bool is_key) {
    if (path.rfind(start, 0) != 0)
      return;
    const std::string rest = path.substr(start.size());
    const auto end         = rest.find('/');
    const std::string name = rest.substr(0, end);
    if ((is_key && end == std::string::npos) ||
        std::find(names.begin(), names.end(), name) != names.end())
      return;
    names.push_back(name);
  };
  for (const RawParameters::Entry &section : raw.subsections())
    add(section.path, false);
  for (const RawParameters::Entry &entry : raw.entries())
    add(entry.path, true);
  return names;
}

void Keys::bind_input(const std::string &key,
                      std::string &path,
                      const std::string &meaning)
{
  bind_value<std::string>(key, path, path, "the name of a file to read, or nothing",
                          take_text, meaning);
  if (!reading)
    keys.back().is_input = true;
}

void Keys::bind_inputs(const std::string &key,
                       std::vector<std::string> &paths,
                       const std::string &meaning)
{
  std::string list;
  for (const std::string &path : paths)
    list += (list.empty() ? "" : ", ") + path;
  bind_value<std::string>(key, list, list,
                          "names of files to read, separated by commas, or nothing",
                          take_text, meaning);
  Key of_paths;
  of_paths.value    = list;
  of_paths.is_input = of_paths.is_list = true;
  paths                                = of_paths.inputs();
  if (!reading)
    keys.back().is_input = keys.back().is_list = true;
}

const std::string &Keys::value(const std::string &path) const
{
  const auto found = index.find(path);
  if (found == index.end())
    throw std::logic_error("the program asks for the parameter '" + path +
                           "' without declaring it");
  return keys[found->second].value;
}
} // namespace mesoslip
