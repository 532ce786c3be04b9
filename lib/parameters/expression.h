#ifndef mesoslip_parameters_expression_h
#define mesoslip_parameters_expression_h

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Refuses texts that muParser reads differently than intended. "t=3" sets the time to 3;
 * random numbers differ each time a run is started or continued; "2,5" is its last item,
 * 5, and min(0,5, t) has three arguments. Functions with a fixed number of arguments
 * refuse one more. @p meaning completes "has rand(), but ": "a load is a function of the
 * time t".
 * @throws std::invalid_argument
 */
void require_unambiguous(const std::string &text, const std::string &meaning);

/** A formula in several variables, with the functions of deal.II's FunctionParser. */
class Expression
{
public:
  /** @p variables are the names of the variables; @p meaning as in require_unambiguous().
   * @throws std::invalid_argument if the text cannot be parsed or is ambiguous */
  Expression(const std::string &text,
             const std::vector<std::string> &variables,
             const std::string &meaning);

  ~Expression();

  Expression(const Expression &)            = delete; ///< the parser points into itself
  Expression &operator=(const Expression &) = delete; ///< see above

  /** The value for @p values of the variables, in their order. */
  double operator()(const std::vector<double> &values) const
  {
    return at(values.data(), values.size());
  }

  /** The value for an initializer list of @p values, without memory allocation. */
  double operator()(const std::initializer_list<double> values) const
  {
    return at(values.begin(), values.size());
  }

  /** Whether variable number @p i occurs in the formula. */
  bool has(const std::size_t i) const
  {
    return uses[i];
  }

  /** The formula as given. */
  const std::string &text() const
  {
    return own_text;
  }

private:
  double at(const double *values, const std::size_t n) const;

  struct Parser;

  const std::string own_text;
  std::vector<bool> uses; ///< per variable
  const std::unique_ptr<Parser> own;
};
} // namespace mesoslip

#endif
