#include "io/key_use.h"

#include "io/declarations.h"
#include "io/errors.h"
#include "io/parameters.h"
#include "io/raw_parameters.h"
#include "io/text.h"

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** "1e-4, 2" and "0.0001,2.0" are one value, "yes" and "true" as well. */
bool same_value(const std::string &a, const std::string &b)
{
  static const auto plain = [](const std::string &text) -> std::string {
    if (text == "yes" || text == "on")
      return "true";
    if (text == "no" || text == "off")
      return "false";
    double number;
    return parse_number(text, number) ? to_text(number) : text;
  };
  const std::vector<std::string> left = split_list(a), right = split_list(b);
  return std::equal(
    left.begin(), left.end(), right.begin(), right.end(),
    [](const std::string &x, const std::string &y) { return plain(x) == plain(y); });
}

} // namespace

KeyUse::KeyUse(const dealii::ParameterHandler &prm, const RawParameters &raw_parameters)
  : raw(raw_parameters)
{
  std::map<std::string, const RawParameters::Entry *> typed;
  for (const RawParameters::Entry &entry : raw.entries())
    typed[entry.path] = &entry;
  for (const Declared &key : declared_keys(prm))
    {
      const std::string path = key.path();
      values[path]           = key.value;
      if (const auto entry = typed.find(path);
          entry != typed.end() && !same_value(key.value, key.default_value))
        set[path] = entry->second;
    }
}

const std::string &KeyUse::value(const std::string &path) const
{
  const auto found = values.find(path);
  if (found == values.end())
    throw std::logic_error("the program asks for the parameter '" + path +
                           "' without declaring it");
  return found->second;
}

bool KeyUse::is_typed(const std::string &path) const
{
  return raw.has(path);
}

void KeyUse::only_with(const std::string &decider,
                       const std::vector<std::string> &values,
                       const std::vector<std::string> &keys) const
{
  const std::string &now = value(decider);
  std::string choices;
  for (const std::string &choice : values)
    choices += (choices.empty() ? "" : " or ") + choice;
  only_if(std::find(values.begin(), values.end(), now) != values.end(), keys,
          decider + " is '" + now + "'", "set " + decider + " = " + choices);
}

std::vector<const RawParameters::Entry *>
KeyUse::set_entries(const std::vector<std::string> &keys) const
{
  std::vector<const RawParameters::Entry *> found;
  for (const std::string &key : keys)
    for (auto entry = set.lower_bound(key);
         entry != set.end() &&
         (key.back() == '/' ? entry->first.rfind(key, 0) == 0 : entry->first == key);
         ++entry)
      found.push_back(entry->second);
  std::sort(found.begin(), found.end()); // of one array: the order of the file
  return found;
}

void KeyUse::only_if(const bool used,
                     const std::vector<std::string> &keys,
                     const std::string &reason,
                     const std::string &remedy) const
{
  if (used)
    return;
  const auto entries = set_entries(keys);
  if (entries.empty())
    return;
  std::string others;
  for (std::size_t i = 1; i < entries.size(); ++i)
    others += (i == 1 ? "" : ", ") + entries[i]->path;
  throw UserError(
    raw.origin(*entries[0]) + ": " + entries[0]->path + " has no effect, as " + reason +
    (others.empty() ? "; remove it, or " : ", nor has " + others + "; remove them, or ") +
    remedy);
}
} // namespace mesoslip
