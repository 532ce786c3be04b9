#ifndef mesoslip_dynamics_traction_h
#define mesoslip_dynamics_traction_h

#include "parameters/expression.h"

#include <array>
#include <memory>
#include <string>

namespace mesoslip
{
/**
 * A traction on a side (Pa); its components along x, y and z are expressions in position
 * and time.
 */
class Traction
{
public:
  /**
   * Sets component @p c to the expression @p text in x, y, z (m) and t (s). @throws
   * std::invalid_argument
   */
  void set(const unsigned int c, const std::string &text);

  /** Whether any component is set. */
  bool is_there() const
  {
    return components[0] || components[1] || components[2];
  }

  /** Whether component @p c is set. */
  bool acts(const unsigned int c) const
  {
    return components[c] != nullptr;
  }

  /** Whether component @p c depends on time. */
  bool varies_in_time(const unsigned int c) const
  {
    return acts(c) && components[c]->has(3);
  }

  /** Whether component @p c depends on position. */
  bool varies_in_place(const unsigned int c) const
  {
    return acts(c) &&
           (components[c]->has(0) || components[c]->has(1) || components[c]->has(2));
  }

  /** Component @p c (Pa) at position @p place (m) and @p time (s). */
  double operator()(const unsigned int c,
                    const std::array<double, 3> &place,
                    const double time) const
  {
    return acts(c) ? (*components[c])({place[0], place[1], place[2], time}) : 0.;
  }

  /** Expression of component @p c; empty if not set. */
  std::string text(const unsigned int c) const
  {
    return acts(c) ? components[c]->text() : "";
  }

private:
  std::array<std::shared_ptr<const Expression>, 3> components;
};
} // namespace mesoslip

#endif
