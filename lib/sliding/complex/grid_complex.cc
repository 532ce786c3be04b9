#include "sliding/complex/grid_complex.h"

#include "base/errors.h"
#include "body/grid_body.h"
#include "exchange/dynamics_file.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/complex/complex_output.h"
#include "sliding/run_plan.h"

#include <vector>

namespace mesoslip
{
namespace
{
/** A node has half of the cell on either side, those at the ends of a body one cell. */
ContactParts contact_parts(const BodyDescription &body, const bool periodic)
{
  const std::size_t n = body.grid.cells[0];
  ContactParts parts;
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    {
      parts.names.push_back(body.phases[p].name);
      std::vector<double> &shares = parts.shares.emplace_back();
      const auto has              = [&](const std::size_t cell) {
        return body.phase_of(cell) == p ? 0.5 : 0.;
      };
      for (std::size_t i = 0; i <= n; ++i)
        shares.push_back(has(i > 0 ? i - 1 : (periodic ? n - 1 : 0)) +
                         has(i < n ? i : (periodic ? 0 : n - 1)));
    }
  return parts;
}
} // namespace

ComplexModesAnalysis::ComplexModesAnalysis(const ContactParameters &given)
  : BodyAnalysis(given)
{
  check_complex_modes(parameters);
  if (top_at_start(parameters).kind == TopSetup::Kind::held)
    return; // nothing presses it, see sliding_state()
  try
    {
      check_static_contact(parameters, body);
    }
  catch (const UserError &e)
    {
      throw UserError("The static state of sliding, which complex modes need: " +
                      std::string(e.what()));
    }
}

void ComplexModesAnalysis::run(RunContext &context)
{
  log_body(context);
  context.remove_results(complex_modes_files());
  const TopSetup top = top_at_start(parameters);
  const GridBody<2> elastic(material, StaticSolverKind::multigrid);
  const BodyScales scales(material);
  StaticContactOptions options = parameters.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  const auto at_rest           = [&](const ContactParameters &of_case,
                           const double friction_factor) {
    BodyDescription described = body;
    if (!of_case.friction.coefficient_by_phase)
      described.node_friction.assign(described.node_friction.size(),
                                               of_case.friction.coefficient);
    for (double &mu : described.node_friction)
      mu *= friction_factor;
    StaticContact solve;
    if (top.kind != TopSetup::Kind::held)
      solve = [&](const std::vector<double> &friction) {
        described.node_friction = friction;
        StaticContactResult found;
        with_advice(equilibrium_advice(friction, true), [&]() {
          found = compute_static_contact(of_case, described, material, options,
                                                   context.communicator());
        });
        return found.solution;
      };
    return sliding_state<2>(elastic, of_case,
                            held_by_supports(material, of_case.sides, top),
                            std::vector<double>(described.node_friction), solve);
  };
  const auto scope = context.timer().scope("Complex modes");
  const auto cases = compute_complex_modes<2>(
    elastic, parameters,
    highest_frequency_of(parameters, scales.wave_speed, elastic.extent(1)), at_rest,
    contact_parts(body, parameters.periodic), scales.shear_impedance, context);
  if (!context.root())
    return;
  log_complex_modes(cases, parameters, context);
  summarize_body("complex modes", context);
  write_complex_tables(cases, parameters, context);
  DynamicsFile file = DynamicsFile::create(context.file("complex_modes.h5"), body,
                                           "mesoslip-complex-modes");
  const ShownComplexShapes shown =
    write_complex_shapes(file, cases, elastic, parameters,
                         {body.grid.cells[1] + 1u, body.grid.cells[0] + 1u, 2});
  if (!shown.fields.empty())
    file.show(shown.fields, shown.numbers);
  file.close();
}
} // namespace mesoslip
