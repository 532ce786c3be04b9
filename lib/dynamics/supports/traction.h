#ifndef mesoslip_dynamics_traction_h
#define mesoslip_dynamics_traction_h

#include "parameters/expression.h"

#include <array>
#include <memory>
#include <string>

namespace mesoslip
{
/** A traction on a side (Pa), its components along x, y and z expressions in place and time. */
class Traction
{
public:
  /** Component @p c is @p text, an expression in x, y, z (m) and t (s). @throws std::invalid_argument */
  void set(const unsigned int c, const std::string &text);

  /** Whether there is any. */
  bool is_there() const
  {
    return components[0] || components[1] || components[2];
  }

  /** Whether there is a component @p c. */
  bool acts(const unsigned int c) const
  {
    return components[c] != nullptr;
  }

  /** Whether component @p c has another value at other times. */
  bool varies_in_time(const unsigned int c) const
  {
    return acts(c) && components[c]->has(3);
  }

  /** Whether component @p c has another value at other places. */
  bool varies_in_place(const unsigned int c) const
  {
    return acts(c) &&
           (components[c]->has(0) || components[c]->has(1) || components[c]->has(2));
  }

  /** Component @p c (Pa) at a @p place (m) and @p time (s). */
  double operator()(const unsigned int c,
                    const std::array<double, 3> &place,
                    const double time) const
  {
    return acts(c) ? (*components[c])({place[0], place[1], place[2], time}) : 0.;
  }

  /** Component @p c as it was given; empty: none. */
  std::string text(const unsigned int c) const
  {
    return acts(c) ? components[c]->text() : "";
  }

private:
  std::array<std::shared_ptr<const Expression>, 3> components;
};
} // namespace mesoslip

#endif
