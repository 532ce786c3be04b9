#include "parameters/parameters.h"
#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"

#include <charconv>
#include <filesystem>
#include <fstream>

namespace mesoslip
{
Range Range::any()
{
  return Range();
}

Range Range::positive()
{
  Range range;
  range.lower           = 0.;
  range.lower_exclusive = true;
  return range;
}

Range Range::non_negative()
{
  return at_least(0.);
}

Range Range::closed(const double lower, const double upper)
{
  return {lower, upper, false, false};
}

Range Range::open(const double lower, const double upper)
{
  return {lower, upper, true, true};
}

Range Range::left_open(const double lower, const double upper)
{
  return {lower, upper, true, false};
}

Range Range::at_least(const double lower)
{
  Range range;
  range.lower = lower;
  return range;
}

Range Range::length()
{
  return closed(1e-15, 1e9);
}

Range Range::stiffness()
{
  return closed(-1e20, 1e20);
}

Range Range::density()
{
  return closed(1e-9, 1e12);
}

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
  if (above)
    return (upper_exclusive ? "< " : "<= ") + to_text(upper);
  return "";
}

std::string resolve_input_path(const std::string &path, const std::string &folder)
{
  namespace fs = std::filesystem;
  if (path.empty() || fs::path(path).is_absolute())
    return path;
  return fs::absolute(fs::path(folder) / path).lexically_normal().string();
}

void require_readable_file(const std::string &what,
                           const std::string &path,
                           const std::string &hint)
{
  namespace fs            = std::filesystem;
  const std::string after = hint.empty() ? "" : "; " + hint;
  if (path.empty())
    throw UserError(what + "no file is named" + after);
  std::error_code code;
  const auto status = fs::status(path, code);
  if (!fs::exists(status))
    throw UserError(what + "there is no file " + path + after);
  if (fs::is_directory(status))
    throw UserError(what + path + " is a folder, but a file is needed" + after);
  errno = 0;
  if (!std::ifstream(path, std::ios::binary))
    throw UserError(what + path + " cannot be read (" + system_message() + ")" + after);
}
} // namespace mesoslip
