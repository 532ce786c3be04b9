#ifndef mesoslip_io_patterns_h
#define mesoslip_io_patterns_h

#include "io/parameters.h"

#include <deal.II/base/patterns.h>

#include <functional>
#include <memory>
#include <string>

namespace mesoslip
{
/**
 * What a key accepts, with the sentence that says so: "a number > 0". Unlike deal.II's
 * patterns it knows exclusive bounds, and refuses trailing characters and NaN.
 */
class TextPattern : public dealii::Patterns::PatternBase
{
public:
  /** @p allowed_text completes "is not ..."; @p accept decides. */
  TextPattern(const std::string &allowed_text,
              const std::function<bool(const std::string &)> &accept);

  /** Whether @p text is accepted. */
  bool match(const std::string &text) const override;

  /** The same in all styles: what messages and --print-parameters show. */
  std::string description(const OutputStyle style = Machine) const override;

  /** A copy, as ParameterHandler keeps. */
  std::unique_ptr<PatternBase> clone() const override;

private:
  std::string allowed;
  std::function<bool(const std::string &)> accepts;
};

/** Description of the pattern of declare_input_file(): apply() makes its paths absolute.
 */
extern const char *const input_file_description;

/**
 * A description of a pattern in words: deal.II's machine-readable ones, such as
 * "[Double 0...1 (inclusive)]", are translated, ours returned.
 */
std::string pattern_in_words(const std::string &description);

} // namespace mesoslip

#endif
