#ifndef mesoslip_parameters_parameters_h
#define mesoslip_parameters_parameters_h

#include "base/text.h"

#include <limits>
#include <string>
#include <vector>

namespace mesoslip
{
/** The values a number may take; bounds are inclusive unless said otherwise. */
struct Range
{
  double lower         = -std::numeric_limits<double>::max(); ///< smallest value
  double upper         = std::numeric_limits<double>::max();  ///< largest value
  bool lower_exclusive = false; ///< lower itself is not allowed
  bool upper_exclusive = false; ///< upper itself is not allowed

  /** All finite numbers. */
  static Range any();
  /** x > 0. */
  static Range positive();
  /** x >= 0. */
  static Range non_negative();
  /** lower <= x <= upper. */
  static Range closed(const double lower, const double upper);
  /** lower < x < upper. */
  static Range open(const double lower, const double upper);
  /** lower < x <= upper. */
  static Range left_open(const double lower, const double upper);
  /** lower <= x. */
  static Range at_least(const double lower);
  /** Lengths (m) of bodies and cells whose products neither vanish nor overflow. */
  static Range length();
  /** Entries of a stiffness (Pa), likewise. */
  static Range stiffness();
  /** Densities (kg/m^3), likewise. */
  static Range density();

  /** False for NaN. */
  bool contains(const double x) const;

  /** For messages: "> 0", "in [0, 1)", "" when everything is allowed. */
  std::string text() const;
};

/** @p path if absolute or empty, otherwise @p folder / @p path, made absolute. */
std::string resolve_input_path(const std::string &path, const std::string &folder);

/** Throws a UserError beginning with @p what unless @p path is a readable file. */
void require_readable_file(const std::string &what,
                           const std::string &path,
                           const std::string &hint = "");

} // namespace mesoslip

#endif
