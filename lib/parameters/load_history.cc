#include "parameters/load_history.h"

#include <deal.II/base/function_parser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mesoslip
{
namespace
{
bool is_digit(const char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** The name in front of the bracket that opens at @p open; empty: a plain bracket. */
std::string function_before(const std::string &text, const std::size_t open)
{
  std::size_t end = open;
  while (end > 0 && text[end - 1] == ' ')
    --end;
  std::size_t begin = end;
  while (begin > 0 && (std::isalnum(static_cast<unsigned char>(text[begin - 1])) != 0 ||
                       text[begin - 1] == '_'))
    --begin;
  return text.substr(begin, end - begin);
}

/** "2,5" around the comma at @p comma. */
std::string around(const std::string &text, const std::size_t comma)
{
  std::size_t begin = comma, end = comma + 1;
  while (begin > 0 && is_digit(text[begin - 1]))
    --begin;
  while (end < text.size() && is_digit(text[end]))
    ++end;
  return text.substr(begin, end - begin);
}

/**
 * Refuses what the parser takes for something else than is meant. "t=3" sets the time to 3;
 * random numbers are others each time a run is started or continued; "2,5" is its last item,
 * 5, and min(0,5, t) has three arguments. Functions with a fixed number of arguments refuse
 * one more.
 */
void require_function_of_time(const std::string &text)
{
  static const std::array<std::string, 4> any_number = {{"min", "max", "sum", "avg"}};
  const auto require = [&](const bool holds, const std::string &what) {
    if (!holds)
      throw std::invalid_argument("'" + text + "' " + what);
  };
  std::vector<std::string> functions; // of the brackets that are open
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '(')
      {
        const std::string name = function_before(text, i);
        require(name != "rand" && name != "rand_seed",
                "has " + name +
                  "(), but a load is a function of the time t that is the same in every "
                  "run");
        functions.push_back(name);
      }
    else if (text[i] == ')' && !functions.empty())
      functions.pop_back();
    else if (text[i] == '=' && text.compare(i, 2, "==") == 0)
      ++i;
    else if (text[i] == '=')
      require(i > 0 && std::string("<>!").find(text[i - 1]) != std::string::npos,
              "sets a variable with '='; a comparison has '=='");
    else if (text[i] == ',')
      {
        require(!functions.empty() && !functions.back().empty(),
                "has a comma in '" + around(text, i) +
                  "', outside the arguments of a function; decimals have a point");
        const bool tight =
          i > 0 && i + 1 < text.size() && is_digit(text[i - 1]) && is_digit(text[i + 1]);
        require(!tight || std::find(any_number.begin(), any_number.end(),
                                    functions.back()) == any_number.end(),
                "may mean one number or two by '" + around(text, i) + "' in " +
                  functions.back() +
                  "(); decimals have a point, and a blank goes behind the comma between "
                  "two arguments");
      }
}
} // namespace

struct LoadHistory::Expression
{
  explicit Expression(const std::string &expression_text)
    : text(expression_text)
  {
    require_function_of_time(text);
    // The parser reports to std::cerr before it throws; one sentence is enough.
    std::ostringstream unused;
    std::streambuf *const cerr = std::cerr.rdbuf(unused.rdbuf());
    bool good                  = true;
    try
      {
        parser.initialize("t", text, {{"pi", M_PI}});
        parser.value(dealii::Point<1>(0.), 0);
      }
    catch (const std::exception &)
      {
        good = false;
      }
    std::cerr.rdbuf(cerr);
    if (!good)
      throw std::invalid_argument("'" + text + "' is not an expression in the time t");
  }

  const std::string text;
  dealii::FunctionParser<1> parser;
};

LoadHistory::LoadHistory(const double amplitude, const Ramp ramp, const double ramp_time)
  : scale(amplitude)
  , ramp(ramp_time > 0. ? ramp : Ramp::step)
  , ramp_time(ramp_time)
{
}

LoadHistory::LoadHistory(const double amplitude, const std::string &expression)
  : scale(amplitude)
  , expression(std::make_shared<Expression>(expression))
{
}

std::string LoadHistory::shape() const
{
  if (expression)
    return expression->text;
  return ramp == Ramp::step ? "step" : ramp == Ramp::linear ? "linear" : "smooth";
}

double LoadHistory::operator()(const double time) const
{
  if (expression)
    return expression->parser.value(dealii::Point<1>(time), 0);
  if (ramp == Ramp::step || time >= ramp_time)
    return scale;
  const double s = time / ramp_time;
  return scale * (ramp == Ramp::linear ? s : 0.5 * (1. - std::cos(M_PI * s)));
}
} // namespace mesoslip
