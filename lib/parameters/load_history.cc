#include "parameters/load_history.h"

#include "parameters/expression.h"

#include <deal.II/base/function_parser.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
struct LoadHistory::Expression
{
  explicit Expression(const std::string &expression_text)
    : text(expression_text)
  {
    require_unambiguous(text, "a load is a function of the time t");
    // The parser reports to std::cerr before it throws; this is suppressed.
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
  return start +
         (scale - start) * (ramp == Ramp::linear ? s : 0.5 * (1. - std::cos(M_PI * s)));
}
} // namespace mesoslip
