#ifndef mesoslip_parameters_parameters_h
#define mesoslip_parameters_parameters_h

#include "base/files.h"
#include "base/text.h"

#include <limits>
#include <string>

namespace mesoslip
{
/** Allowed values of a number, limited to usable sizes; bounds are inclusive unless said
 * otherwise. */
struct Range
{
  double lower         = -std::numeric_limits<double>::max(); ///< smallest value
  double upper         = std::numeric_limits<double>::max();  ///< largest value
  bool lower_exclusive = false; ///< whether lower itself is excluded
  bool upper_exclusive = false; ///< whether upper itself is excluded

  /** All numbers of a usable size. */
  static Range any()
  {
    return {};
  }
  /** x > 0. */
  static Range positive()
  {
    return {0., Range().upper, true, false};
  }
  /** x >= 0. */
  static Range non_negative()
  {
    return {0., Range().upper, false, false};
  }
  /** lower <= x <= upper. */
  static Range closed(const double lower, const double upper)
  {
    return {lower, upper, false, false};
  }
  /** lower < x < upper. */
  static Range open(const double lower, const double upper)
  {
    return {lower, upper, true, true};
  }
  /** lower < x <= upper. */
  static Range left_open(const double lower, const double upper)
  {
    return {lower, upper, true, false};
  }
  /** Lengths (m) of bodies and cells whose products neither vanish nor overflow. */
  static Range length()
  {
    return closed(1e-15, 1e9);
  }
  /** Entries of a stiffness (Pa) whose products neither vanish nor overflow. */
  static Range stiffness()
  {
    return closed(-1e20, 1e20);
  }
  /** Densities (kg/m^3) whose products neither vanish nor overflow. */
  static Range density()
  {
    return closed(1e-9, 1e12);
  }

  /** Whether @p x is allowed; false for NaN. */
  bool contains(const double x) const;

  /** Text for messages: "> 0", "in [0, 1)", "" if everything is allowed. */
  std::string text() const;
};
} // namespace mesoslip

#endif
