#ifndef mesoslip_parameters_load_history_h
#define mesoslip_parameters_load_history_h

#include <memory>
#include <string>

namespace mesoslip
{
/** Growth of a load from zero to its amplitude. */
enum class Ramp
{
  step,
  linear,
  smooth
};

/**
 * A load (pressure, velocity of the flat) as a function of time: an amplitude times a
 * ramp, or an expression in `t` (seconds) as deal.II's FunctionParser reads it.
 */
class LoadHistory
{
public:
  /** amplitude * s(t / ramp_time), s = 1 (step), t/T (linear), (1 - cos(pi t/T))/2
   * (smooth). */
  LoadHistory(const double amplitude = 0.,
              const Ramp ramp        = Ramp::step,
              const double ramp_time = 0.);

  /**
   * The value of an expression such as `2*cos(2*pi*1000*t)`; amplitude() returns
   * @p amplitude, the scale for dimensionless energies.
   * @throws std::invalid_argument if the expression cannot be parsed, contains a decimal
   * comma, sets a variable or has random numbers.
   */
  LoadHistory(const double amplitude, const std::string &expression);

  /** The load with a ramp from @p value, instead of zero, to the amplitude; an expression
   * is unchanged. */
  LoadHistory from(const double value) const
  {
    LoadHistory result = *this;
    result.start       = value;
    return result;
  }

  /** Value at @p time (s), in the unit of the amplitude. */
  double operator()(const double time) const;

  /** Whether the value is constant from @p time (s) on; false for an expression. */
  bool is_constant_from(const double time) const
  {
    return !expression && (ramp == Ramp::step || time >= ramp_time);
  }

  /** "step", "linear", "smooth", or the expression. */
  std::string shape() const;

  /** Duration (s) of the ramp; 0 for a step and an expression. */
  double duration() const
  {
    return ramp == Ramp::step ? 0. : ramp_time;
  }

  /** Factor before the expression. */
  double amplitude() const
  {
    return scale;
  }

  /** Whether it is an expression, for which amplitude() is only a scale. */
  bool is_expression() const
  {
    return expression != nullptr;
  }

private:
  struct Expression;

  double scale     = 0.;
  double start     = 0.; ///< value at the start of the ramp
  Ramp ramp        = Ramp::step;
  double ramp_time = 0.;
  std::shared_ptr<const Expression> expression;
};
} // namespace mesoslip

#endif
