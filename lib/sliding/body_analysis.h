#ifndef mesoslip_sliding_body_analysis_h
#define mesoslip_sliding_body_analysis_h

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_material.h"
#include "exchange/run_description.h"
#include "program/program.h"
#include "sliding/contact_parameters.h"
#include "sliding/run_plan.h"

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The body that parameters and RVE file describe, if there is the memory for its fields.
 * The coefficient of a bottom node follows from those of the two cells beside it by
 * FrictionParameters::node_rule: their mean weighted with the stiffness D22 (as the
 * pressure is shared when both cells are compressed alike, eq. 18), the plain mean, the
 * largest or the smallest. @p n_copies ranks of this machine keep fields of the whole body.
 * @throws UserError naming key or file, or if the machine has not the memory
 */
BodyDescription make_body(const ContactParameters &parameters,
                          const unsigned int n_copies);

/** The grid of the body with the materials of its cells. @throws UserError */
UniformMaterial make_material(const BodyDescription &body, const bool periodic);

/** What sides and top hold, of a platen u_x and u_y. */
DofMask held_by_supports(const UniformMaterial &material,
                         const SideConstraints &sides,
                         const TopSetup &top);

/**
 * To be called between the solves of the static analyses, which leave nothing behind when
 * stopped. @throws Interrupted
 */
std::function<void(unsigned int)> stop_or_report(RunContext &context,
                                                 const std::string &activity);

/** Runs @p action. @throws NumericalFailure instead of NotConverged, with @p advice. */
void with_advice(const std::string &advice, const std::function<void()> &action);

/** What to do when no equilibrium with the coefficients @p friction is found on a flat that @p slides or
 * rests. */
std::string equilibrium_advice(const std::vector<double> &friction, const bool slides);

/** Puts the largest strain of a static contact into the summary, and warns of large ones. @throws
 * NumericalFailure if a cell is inside out */
void judge_static_strain(const Deformation &found,
                         const ContactParameters &parameters,
                         const BodyScales &scales,
                         const PlaceText &place,
                         RunContext &context);

/** What the analyses of a body on the flat have in common. */
class BodyAnalysis : public Analysis
{
public:
  /**
   * Builds the body; rank 0 reads the RVE file. @throws UserError for input that no
   * analysis can work with, or without the memory for its fields
   */
  explicit BodyAnalysis(const ContactParameters &parameters);

  /** Grid, materials, degrees of freedom, memory and what looks like a slip of units. */
  void describe(std::ostream &out) const override;

protected:
  /** The same, with histories besides the fields in the memory. */
  void describe_body(std::ostream &out, const double bytes_of_histories) const;

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
