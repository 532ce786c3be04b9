#include "base/errors.h"

#include "base/text.h"

namespace mesoslip
{
UserError::UserError(const std::string &sentence)
  : std::runtime_error(sentence)
{
}

NumericalFailure::NumericalFailure(const std::string &sentence)
  : std::runtime_error(sentence)
{
}

NumericalFailure::NumericalFailure(const std::string &what,
                                   const long long step,
                                   const double time,
                                   const std::string &place)
  : std::runtime_error(what + " in step " + std::to_string(step) + " at t = " +
                       to_text(time) + " s" + (place.empty() ? "" : ", " + place))
{
}

Interrupted::Interrupted(const std::string &sentence)
  : std::runtime_error(sentence)
{
}
} // namespace mesoslip
