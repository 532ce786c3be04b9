#include "io/parameters.h"

#include "io/errors.h"
#include "io/text.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace mesoslip
{
namespace
{
/** Sections entered by ParameterSection, for messages; the handler keeps its own secret.
 */
std::map<const dealii::ParameterHandler *, std::vector<std::string>> entered_sections;

std::string full_key(const dealii::ParameterHandler &prm, const std::string &key)
{
  std::string path;
  const auto entered = entered_sections.find(&prm);
  if (entered != entered_sections.end())
    for (const std::string &section : entered->second)
      path += section + "/";
  return path + key;
}

std::string raw_value(dealii::ParameterHandler &prm, const std::string &key)
{
  try
    {
      const std::string value = prm.get(key);
      // An unknown key reads as "", but cannot be set.
      if (value.empty())
        prm.set(key, value);
      return value;
    }
  catch (const dealii::ExceptionBase &)
    {
      throw std::logic_error("the program reads the parameter '" + full_key(prm, key) +
                             "' without declaring it");
    }
}

template <typename Number>
Number number(dealii::ParameterHandler &prm, const std::string &key)
{
  const std::string text = trimmed(raw_value(prm, key));
  Number value;
  if (!parse_number(text, value))
    throw UserError(full_key(prm, key) + " is '" + text + "', which is not a number");
  return value;
}
} // namespace

ParameterSection::ParameterSection(dealii::ParameterHandler &handler,
                                   const std::string &path)
  : prm(handler)
{
  std::string::size_type begin = 0;
  while (begin <= path.size())
    {
      const auto end         = std::min(path.find('/', begin), path.size());
      const std::string name = path.substr(begin, end - begin);
      prm.enter_subsection(name);
      entered_sections[&prm].push_back(name);
      ++depth;
      begin = end + 1;
    }
}

ParameterSection::~ParameterSection()
{
  std::vector<std::string> &entered = entered_sections[&prm];
  for (; depth > 0; --depth)
    {
      prm.leave_subsection();
      entered.pop_back();
    }
  if (entered.empty())
    entered_sections.erase(&prm);
}

double get_double(dealii::ParameterHandler &prm, const std::string &key)
{
  return number<double>(prm, key);
}

double get_double_or_auto(dealii::ParameterHandler &prm, const std::string &key)
{
  if (raw_value(prm, key) == "auto")
    return std::numeric_limits<double>::quiet_NaN();
  return number<double>(prm, key);
}

long get_integer(dealii::ParameterHandler &prm, const std::string &key)
{
  return number<long>(prm, key);
}

bool get_bool(dealii::ParameterHandler &prm, const std::string &key)
{
  const std::string text = raw_value(prm, key);
  return text == "true" || text == "yes" || text == "on";
}

std::string get_string(dealii::ParameterHandler &prm, const std::string &key)
{
  return raw_value(prm, key);
}

std::vector<std::string> get_word_list(dealii::ParameterHandler &prm,
                                       const std::string &key)
{
  return split_list(raw_value(prm, key));
}

std::vector<double> get_double_list(dealii::ParameterHandler &prm, const std::string &key)
{
  std::vector<double> values;
  for (const std::string &item : split_list(raw_value(prm, key)))
    if (double value; parse_number(item, value))
      values.push_back(value);
    else
      throw UserError(full_key(prm, key) + " holds '" + item +
                      "', which is not a number");
  return values;
}

std::vector<long> get_integer_list(dealii::ParameterHandler &prm, const std::string &key)
{
  std::vector<long> values;
  for (const std::string &item : split_list(raw_value(prm, key)))
    if (long value; parse_number(item, value))
      values.push_back(value);
    else
      throw UserError(full_key(prm, key) + " holds '" + item +
                      "', which is not a whole number");
  return values;
}

std::string get_input_file(dealii::ParameterHandler &prm,
                           const std::string &key,
                           const std::string &hint)
{
  const std::string path = raw_value(prm, key);
  if (path.empty())
    throw UserError(full_key(prm, key) + " is empty, but a file is needed here" +
                    (hint.empty() ? "" : "; " + hint));
  const std::string absolute =
    std::filesystem::absolute(path).lexically_normal().string();
  require_input_file(full_key(prm, key) + ": ", absolute, hint);
  return absolute;
}
} // namespace mesoslip
