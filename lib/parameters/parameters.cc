#include "parameters/parameters.h"

namespace mesoslip
{
bool Range::contains(const double x) const
{
  return (lower_exclusive ? x > lower : x >= lower) &&
         (upper_exclusive ? x < upper : x <= upper);
}

std::string Range::text() const
{
  const bool below = lower != -std::numeric_limits<double>::max();
  const bool above = upper != std::numeric_limits<double>::max();
  if (below && above)
    return std::string("in ") + (lower_exclusive ? "(" : "[") + to_text(lower) + ", " +
           to_text(upper) + (upper_exclusive ? ")" : "]");
  if (below)
    return (lower_exclusive ? "> " : ">= ") + to_text(lower);
  return above ? (upper_exclusive ? "< " : "<= ") + to_text(upper) : "";
}
} // namespace mesoslip
