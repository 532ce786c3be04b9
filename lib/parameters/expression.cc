#include "parameters/expression.h"

#include <deal.II/base/mu_parser_internal.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <muParser.h>
#include <stdexcept>

namespace mesoslip
{
namespace
{
bool is_digit(const char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** The name before the bracket that opens at @p open; empty: a plain bracket. */
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

/** Text around the comma at @p comma, such as "2,5". */
std::string around(const std::string &text, const std::size_t comma)
{
  std::size_t begin = comma, end = comma + 1;
  while (begin > 0 && is_digit(text[begin - 1]))
    --begin;
  while (end < text.size() && is_digit(text[end]))
    ++end;
  return text.substr(begin, end - begin);
}

/** Adds the functions that dealii::FunctionParser adds to muParser's own, except random
 * numbers. */
void add_functions(mu::Parser &parser)
{
  namespace functions = dealii::internal::FunctionParser;
  parser.DefineConst("pi", M_PI);
  parser.DefineFun("if", functions::mu_if, true);
  parser.DefineOprt("|", functions::mu_or, 1);
  parser.DefineOprt("&", functions::mu_and, 2);
  parser.DefineFun("int", functions::mu_int, true);
  parser.DefineFun("ceil", functions::mu_ceil, true);
  parser.DefineFun("cot", functions::mu_cot, true);
  parser.DefineFun("csc", functions::mu_csc, true);
  parser.DefineFun("floor", functions::mu_floor, true);
  parser.DefineFun("sec", functions::mu_sec, true);
  parser.DefineFun("log", functions::mu_log, true);
  parser.DefineFun("pow", functions::mu_pow, true);
  parser.DefineFun("erf", functions::mu_erf, true);
  parser.DefineFun("erfc", functions::mu_erfc, true);
}
} // namespace

void require_unambiguous(const std::string &text, const std::string &meaning)
{
  static const std::array<std::string, 4> any_number = {{"min", "max", "sum", "avg"}};
  const auto require = [&](const bool holds, const std::string &what) {
    if (!holds)
      throw std::invalid_argument("'" + text + "' " + what);
  };
  std::vector<std::string> functions; // function of each open bracket
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '(')
      {
        const std::string name = function_before(text, i);
        require(name != "rand" && name != "rand_seed",
                "has " + name + "(), but " + meaning + " that is the same in every run");
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

struct Expression::Parser
{
  mu::Parser parser;
  std::vector<double> values; ///< values of the variables
};

Expression::Expression(const std::string &text,
                       const std::vector<std::string> &variables,
                       const std::string &meaning)
  : own_text(text)
  , own(std::make_unique<Parser>())
{
  require_unambiguous(text, meaning);
  own->values.resize(variables.size());
  try
    {
      add_functions(own->parser);
      for (std::size_t i = 0; i < variables.size(); ++i)
        own->parser.DefineVar(variables[i], &own->values[i]);
      own->parser.SetExpr(text);
      own->parser.Eval();
      const auto &used = own->parser.GetUsedVar();
      for (const std::string &variable : variables)
        uses.push_back(used.count(variable) > 0);
    }
  catch (const mu::Parser::exception_type &)
    {
      std::string names;
      for (const std::string &variable : variables)
        names += (names.empty() ? "" : ", ") + variable;
      throw std::invalid_argument("'" + text + "' is not an expression in " + names);
    }
}

Expression::~Expression() = default;

double Expression::at(const double *values, const std::size_t n) const
{
  std::copy_n(values, std::min(n, own->values.size()), own->values.begin());
  return own->parser.Eval();
}
} // namespace mesoslip
