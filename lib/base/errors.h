#ifndef mesoslip_base_errors_h
#define mesoslip_base_errors_h

#include <stdexcept>
#include <string>

namespace mesoslip
{
/** What a program returns to the shell. */
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
  /** @p sentence names the key or file, what was found, what to do. */
  explicit UserError(const std::string &sentence);
};

/**
 * A computation that cannot go on: unstable, not converged, not finite. The message
 * says where. Programs return 3.
 */
class NumericalFailure : public std::runtime_error
{
public:
  /** @p sentence says what went wrong, and where. */
  explicit NumericalFailure(const std::string &sentence);

  /**
   * "<what> in step <step> at t = <time> s, <place>": @p place is free text, such as
   * "node (12, 40)" or "the contact line", and may be empty.
   */
  NumericalFailure(const std::string &what,
                   const long long step,
                   const double time,
                   const std::string &place);
};

/** A run stopped on request after it saved its state. Programs return 130. */
class Interrupted : public std::runtime_error
{
public:
  /** @p sentence says what was saved and how to go on. */
  explicit Interrupted(const std::string &sentence);
};
} // namespace mesoslip

#endif
