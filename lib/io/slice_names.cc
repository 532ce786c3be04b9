#include "io/slice_names.h"

#include "base/errors.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace mesoslip
{
namespace
{
bool is_digit(const std::string &text, const std::size_t at)
{
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

char lower(const char c)
{
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/** Whether there is a minus at @p at before a number, but not after one. */
bool is_minus(const std::string &text, const std::size_t at)
{
  return text[at] == '-' && is_digit(text, at + 1) &&
         (at == 0 || !is_digit(text, at - 1));
}

/** Digits of @p text from @p at on without leading zeros; moves @p at behind them. */
std::string number_from(const std::string &text, std::size_t &at)
{
  const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
  std::string digits    = text.substr(at, end - at);
  at                    = end;
  return digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size()));
}

/** Index of the first difference of @p a and @p b, ignoring case. */
std::size_t first_difference(const std::string &a, const std::string &b)
{
  std::size_t at = 0;
  while (at < a.size() && at < b.size() && lower(a[at]) == lower(b[at]))
    ++at;
  return at;
}

/** Whether two consecutive @p names differ by a minus in place of a digit. */
bool have_signs(const std::vector<std::string> &names)
{
  for (std::size_t k = 0; k + 1 < names.size(); ++k)
    if (const std::size_t at = first_difference(names[k], names[k + 1]);
        at < names[k].size() && at < names[k + 1].size() &&
        ((is_minus(names[k], at) && is_digit(names[k + 1], at)) ||
         (is_minus(names[k + 1], at) && is_digit(names[k], at))))
      return true;
  return false;
}

/** Compares names with their numbers by value: 9 before 10, and, with signs, -1
 * before 0. */
struct NumberOrder
{
  bool signs = false;

  bool operator()(const std::string &a, const std::string &b) const
  {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size())
      if (is_digit(a, i) && is_digit(b, j))
        {
          const bool negative = signs && i > 0 && is_minus(a, i - 1);
          const std::string x = number_from(a, i), y = number_from(b, j);
          if (x != y)
            return (x.size() != y.size() ? x.size() < y.size() : x < y) != negative;
        }
      else if (lower(a[i++]) != lower(b[j++]))
        return lower(a[i - 1]) < lower(b[j - 1]);
    const bool a_ended = i == a.size(), b_ended = j == b.size();
    return a_ended && !b_ended;
  }
};

/** Advice on naming two files so that they sort by their numbers. */
std::string remedy(const std::string &a, const std::string &b, const bool signs)
{
  const std::size_t at =
    std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin();
  if (at < a.size() && at < b.size() && lower(a[at]) == lower(b[at]))
    return "write all names with small letters";
  return signs ? "number them from 0 on, with leading zeros"
               : "write numbers with leading zeros";
}

/** The numbers of a name and the text between them. */
struct NameParts
{
  explicit NameParts(const std::string &name)
  {
    for (std::size_t at = 0; at < name.size();)
      if (is_digit(name, at))
        {
          begins.push_back(at);
          number_from(name, at);
          ends.push_back(at);
          numbers.push_back(
            std::strtod(name.substr(begins.back(), at - begins.back()).c_str(), nullptr));
          text += '0';
        }
      else
        text += lower(name[at++]);
  }

  std::string text; ///< lower case, with a 0 for each number
  std::vector<std::size_t> begins, ends;
  std::vector<double> numbers;
};

/** Index of the single number that distinguishes the names; -1: there is none. */
long counting_number(const std::vector<NameParts> &names)
{
  long counts = -1;
  for (const NameParts &name : names)
    {
      if (name.text != names.front().text)
        return -1;
      for (std::size_t k = 0; k < name.numbers.size(); ++k)
        if (const long number = static_cast<long>(k);
            name.numbers[k] != names.front().numbers[k] && number != counts)
          {
            if (counts != -1)
              return -1;
            counts = number;
          }
    }
  return counts;
}

/** @p name with @p value, padded to as many digits, in place of number @p k. */
std::string with_number(const std::string &name, const std::size_t k, const double value)
{
  const NameParts parts(name);
  std::string digits = std::to_string(std::llround(value));
  digits.insert(
    0, std::max(parts.ends[k] - parts.begins[k], digits.size()) - digits.size(), '0');
  return name.substr(0, parts.begins[k]) + digits + name.substr(parts.ends[k]);
}

/** Throws if a number is missing or repeated. */
void require_all_numbers(const std::string &folder, const std::vector<std::string> &names)
{
  std::vector<NameParts> parts;
  for (const std::string &name : names)
    parts.emplace_back(name);
  const long counting = counting_number(parts);
  if (counting < 0)
    return;
  const auto k      = static_cast<std::size_t>(counting);
  const auto number = [&](const std::size_t n) { return parts[n].numbers[k]; };
  double step       = std::fabs(number(1) - number(0));
  for (std::size_t n = 1; n < names.size(); ++n)
    step = std::min(step, std::fabs(number(n) - number(n - 1)));
  for (std::size_t n = 1; n < names.size(); ++n)
    if (step == 0. && number(n) == number(n - 1))
      throw UserError(folder + ": " + names[n - 1] + " and " + names[n] +
                      " have the same number; remove or rename one of them");
    else if (const double next = number(n - 1) + step;
             step > 0. && next < 1e15 && number(n) >= next + step)
      throw UserError(
        folder + ": " + with_number(names[n - 1], k, next) + " is missing between " +
        names[n - 1] + " and " + names[n] +
        ", but the pictures of a stack are equally far from each other; add "
        "it, or number the pictures without a gap");
}
} // namespace

void require_slices_in_order(const std::string &folder,
                             const std::vector<std::string> &names)
{
  const bool signs = have_signs(names);
  const auto wrong = std::is_sorted_until(names.begin(), names.end(), NumberOrder{signs});
  if (wrong != names.end())
    throw UserError(folder + ": by name, " + *(wrong - 1) + " comes before " + *wrong +
                    ", against their numbers; " + remedy(*(wrong - 1), *wrong, signs));
  require_all_numbers(folder, names);
}
} // namespace mesoslip
