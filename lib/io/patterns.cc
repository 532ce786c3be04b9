#include "io/patterns.h"

#include <regex>

namespace mesoslip
{
const char *const input_file_description = "the name of a file to read, or nothing";

TextPattern::TextPattern(const std::string &allowed_text,
                         const std::function<bool(const std::string &)> &accept)
  : allowed(allowed_text)
  , accepts(accept)
{
}

bool TextPattern::match(const std::string &text) const
{
  return accepts(text);
}

std::string TextPattern::description(const OutputStyle) const
{
  return allowed;
}

std::unique_ptr<dealii::Patterns::PatternBase> TextPattern::clone() const
{
  return std::make_unique<TextPattern>(*this);
}

namespace
{
std::string bounds_in_words(const std::string &kind,
                            const std::string &lower,
                            const std::string &upper)
{
  const bool below = lower.find("MAX") == std::string::npos && lower != "-2147483648";
  const bool above = upper.find("MAX") == std::string::npos && upper != "2147483647";
  if (below && above)
    return kind + " in [" + lower + ", " + upper + "]";
  if (below)
    return kind + " >= " + lower;
  if (above)
    return kind + " <= " + upper;
  return kind;
}
} // namespace

std::string pattern_in_words(const std::string &description)
{
  static const std::regex number(
    R"(\[(Double|Integer range|Integer) (.*?)\.\.\.(.*?) \(inclusive\)\])");
  static const std::regex selection(R"(\[Selection (.*?) *\])");
  static const std::regex list(R"(\[List of <(.*)> of length .*\])");
  std::smatch match;
  if (std::regex_match(description, match, number))
    return bounds_in_words(match[1] == "Double" ? "a number" : "a whole number", match[2],
                           match[3]);
  if (std::regex_match(description, match, selection))
    return "one of " + std::regex_replace(match[1].str(), std::regex(R"(\|)"), ", ");
  if (std::regex_match(description, match, list))
    return "a comma separated list, each item " + pattern_in_words(match[1]);
  if (description == "[Double]")
    return "a number";
  if (description == "[Integer]")
    return "a whole number";
  if (description == "[Bool]")
    return "true or false";
  if (description == "[Anything]")
    return "any text";
  if (description.rfind("[FileName", 0) == 0)
    return "a file name";
  return description;
}
} // namespace mesoslip
