#ifndef mesoslip_sliding_body_analysis_h
#define mesoslip_sliding_body_analysis_h

#include "program/program.h"
#include "sliding/make_body.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** What the analyses of a body on the flat have in common. */
class BodyAnalysis : public Analysis
{
public:
  /**
   * Builds the body; rank 0 reads the RVE file. @throws UserError for input that no
   * analysis can work with, or without the memory for its fields
   */
  explicit BodyAnalysis(const ContactParameters &parameters);

  /** Grid, materials, degrees of freedom and what looks like a slip of units. */
  void describe(std::ostream &out) const override;

protected:
  /** Writes grid and materials to the log, with warnings. */
  void log_body(RunContext &context) const;

  /** Puts analysis, material and size of the body into summary.json. */
  void summarize_body(const std::string &analysis, RunContext &context) const;

  const ContactParameters parameters; ///< all of them, checked
  const BodyDescription body;         ///< the same on all ranks
  const UniformMaterial material;     ///< stiffness and density of its cells

private:
  std::vector<std::string> body_lines() const;
  std::vector<std::string> body_warnings() const;
};
} // namespace mesoslip

#endif
