#ifndef mesoslip_base_errors_h
#define mesoslip_base_errors_h

#include "base/text.h"

#include <stdexcept>
#include <string>

namespace mesoslip
{
/** Exit status of a program. */
enum class ExitStatus : int
{
  done              = 0,
  unexpected        = 1,
  user_error        = 2,
  numerical_failure = 3,
  interrupted       = 130
};

/**
 * Bad input. The message is one sentence: the key or file, what was found, what to
 * do. Programs print it as `<program>: <sentence>` and return 2.
 */
class UserError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/**
 * A computation that cannot go on: unstable, not converged, not finite. The message
 * says where. Programs return 3.
 */
class NumericalFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;

  /**
   * "<what> in step <step> at t = <time> s, <place>": @p place is free text, such as
   * "node (12, 40)" or "the contact line", and may be empty.
   */
  NumericalFailure(const std::string &what,
                   const long long step,
                   const double time,
                   const std::string &place)
    : std::runtime_error(what + " in step " + std::to_string(step) + " at t = " +
                         to_text(time) + " s" + (place.empty() ? "" : ", " + place))
  {
  }
};

/** A run stopped on request after it saved its state. Programs return 130. */
class Interrupted : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace mesoslip

#endif
