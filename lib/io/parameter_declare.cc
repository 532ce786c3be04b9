#include "io/parameters.h"
#include "io/patterns.h"
#include "io/text.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
namespace
{
void declare(dealii::ParameterHandler &prm,
             const std::string &key,
             const std::string &value,
             const std::string &meaning,
             const std::string &allowed,
             const std::function<bool(const std::string &)> &accepts)
{
  if (!accepts(value))
    throw std::logic_error("the default '" + value + "' of the parameter '" + key +
                           "' is not " + allowed);
  prm.declare_entry(key, value, TextPattern(allowed, accepts), meaning);
}

std::string number_in_words(const char *kind, const std::string &range)
{
  return kind + (range.empty() ? "" : " " + range);
}

std::string integer_range_text(const long lower, const long upper)
{
  const bool below = lower != std::numeric_limits<long>::min();
  const bool above = upper != std::numeric_limits<long>::max();
  if (below && above)
    return "in [" + std::to_string(lower) + ", " + std::to_string(upper) + "]";
  if (below)
    return ">= " + std::to_string(lower);
  return above ? "<= " + std::to_string(upper) : "";
}

std::string
list_in_words(const std::string &item, const unsigned int min, const unsigned int max)
{
  const bool bounded = max != std::numeric_limits<unsigned int>::max();
  std::string count;
  if (min == max)
    count = std::to_string(min) + " ";
  else if (bounded)
    count = std::to_string(min) + " to " + std::to_string(max) + " ";
  else if (min > 0)
    count = "at least " + std::to_string(min) + " ";
  return count + "comma separated " + item;
}

/** A list in which every item passes @p accepts and whose length is right. */
std::function<bool(const std::string &)>
list_of(const unsigned int min,
        const unsigned int max,
        const std::function<bool(const std::string &)> &accepts)
{
  return [=](const std::string &text) {
    const std::vector<std::string> items = split_list(text);
    return items.size() >= min && items.size() <= max &&
           std::all_of(items.begin(), items.end(), accepts);
  };
}

std::function<bool(const std::string &)> double_in(const Range &range)
{
  return [range](const std::string &text) {
    double value;
    return parse_number(trimmed(text), value) && range.contains(value);
  };
}

std::function<bool(const std::string &)> integer_in(const long lower, const long upper)
{
  return [lower, upper](const std::string &text) {
    long value;
    return parse_number(trimmed(text), value) && value >= lower && value <= upper;
  };
}
} // namespace

void declare_double(dealii::ParameterHandler &prm,
                    const std::string &key,
                    const double value,
                    const Range &range,
                    const std::string &meaning)
{
  declare(prm, key, to_text(value), meaning, number_in_words("a number", range.text()),
          double_in(range));
}

void declare_double_or_auto(dealii::ParameterHandler &prm,
                            const std::string &key,
                            const std::string &value,
                            const Range &range,
                            const std::string &meaning)
{
  declare(prm, key, value, meaning, number_in_words("auto or a number", range.text()),
          [accepts = double_in(range)](const std::string &text) {
            return text == "auto" || accepts(text);
          });
}

void declare_integer(dealii::ParameterHandler &prm,
                     const std::string &key,
                     const long value,
                     const long lower,
                     const long upper,
                     const std::string &meaning)
{
  declare(prm, key, std::to_string(value), meaning,
          number_in_words("a whole number", integer_range_text(lower, upper)),
          integer_in(lower, upper));
}

void declare_bool(dealii::ParameterHandler &prm,
                  const std::string &key,
                  const bool value,
                  const std::string &meaning)
{
  declare(prm, key, value ? "true" : "false", meaning, "true or false",
          [](const std::string &text) {
            return text == "true" || text == "false" || text == "yes" || text == "no" ||
                   text == "on" || text == "off";
          });
}

void declare_selection(dealii::ParameterHandler &prm,
                       const std::string &key,
                       const std::string &value,
                       const std::vector<std::string> &choices,
                       const std::string &meaning)
{
  declare(prm, key, value, meaning, "one of " + to_text(choices),
          [choices](const std::string &text) {
            return std::find(choices.begin(), choices.end(), text) != choices.end();
          });
}

void declare_word_list(dealii::ParameterHandler &prm,
                       const std::string &key,
                       const std::vector<std::string> &value,
                       const std::vector<std::string> &choices,
                       const std::string &meaning)
{
  const auto accepts = [choices](const std::string &word) {
    return !word.empty() && (choices.empty() || std::find(choices.begin(), choices.end(),
                                                          word) != choices.end());
  };
  declare(prm, key, to_text(value), meaning,
          list_in_words(choices.empty() ? "words" : "words out of " + to_text(choices), 0,
                        std::numeric_limits<unsigned int>::max()),
          list_of(0, std::numeric_limits<unsigned int>::max(), accepts));
}

void declare_double_list(dealii::ParameterHandler &prm,
                         const std::string &key,
                         const std::vector<double> &value,
                         const Range &range,
                         const std::string &meaning,
                         const unsigned int min_items,
                         const unsigned int max_items)
{
  declare(prm, key, to_text(value), meaning,
          list_in_words(number_in_words("numbers", range.text()), min_items, max_items),
          list_of(min_items, max_items, double_in(range)));
}

void declare_integer_list(dealii::ParameterHandler &prm,
                          const std::string &key,
                          const std::vector<long> &value,
                          const long lower,
                          const long upper,
                          const std::string &meaning,
                          const unsigned int min_items,
                          const unsigned int max_items)
{
  std::vector<std::string> items;
  for (const long item : value)
    items.push_back(std::to_string(item));
  declare(
    prm, key, to_text(items), meaning,
    list_in_words(number_in_words("whole numbers", integer_range_text(lower, upper)),
                  min_items, max_items),
    list_of(min_items, max_items, integer_in(lower, upper)));
}

void declare_string(dealii::ParameterHandler &prm,
                    const std::string &key,
                    const std::string &value,
                    const std::string &meaning)
{
  declare(prm, key, value, meaning, "any text", [](const std::string &) { return true; });
}

void declare_input_file(dealii::ParameterHandler &prm,
                        const std::string &key,
                        const std::string &value,
                        const std::string &meaning)
{
  declare(prm, key, value, meaning, input_file_description,
          [](const std::string &) { return true; });
}
} // namespace mesoslip
