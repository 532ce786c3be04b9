#include "sliding/complex/complex_analysis.h"

#include "base/errors.h"
#include "body/elastic_body.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/analyses/static_load.h"
#include "sliding/complex/complex_output.h"

#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
template <int dim>
ComplexModesAnalysis<dim>::ComplexModesAnalysis(std::unique_ptr<GivenBody<dim>> given)
  : BodyAnalysis<dim>(std::move(given))
{
  check_complex_modes(parameters);
  try
    {
      if (is_pressed())
        check_static_load(parameters, facts);
      else if (dim == 3)
        throw UserError("the top is held, and nothing presses the body on the flat; in "
                        "3D the drag across the motion of the flat depends on the "
                        "pressure, set Supports/Top/Kind = platen or pressure");
    }
  catch (const UserError &e)
    {
      throw UserError("The static state of sliding, which complex modes need: " +
                      std::string(e.what()));
    }
}

template <int dim>
bool ComplexModesAnalysis<dim>::is_pressed() const
{
  return !top_at_start(parameters).is_held();
}

template <int dim>
SlidingState ComplexModesAnalysis<dim>::at_rest(const ContactParameters &of_case,
                                                const double friction_factor,
                                                RunContext &context) const
{
  std::vector<double> friction = facts.size.friction;
  if (!of_case.friction.coefficient_by_phase)
    friction.assign(friction.size(), of_case.friction.coefficient);
  for (double &mu : friction)
    mu *= friction_factor;
  StaticContactOptions options = of_case.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  StaticContact solve;
  if (is_pressed())
    solve = [&](const std::vector<double> &coefficients) {
      StaticContactSolution found;
      with_advice(equilibrium_advice(coefficients, true), [&]() {
        found = StaticLoad<dim>(*body, of_case, coefficients).follow(options);
      });
      return found;
    };
  const TopSetup top                = top_at_start(of_case);
  SlidingState state                = sliding_state<dim>(body->vibrating(), of_case,
                                          body->held(top, false), friction, solve);
  const std::vector<Platen> platens = body->platens(top);
  state.platens.insert(state.platens.end(), platens.begin(), platens.end());
  return state;
}

/** K and M with phases_of_damping(), without the smallest beta, which SlidingLaw has. */
template <int dim>
DampingByPhase ComplexModesAnalysis<dim>::damping(const MPI_Comm communicator) const
{
  StepParameters besides = parameters.step;
  if (!besides.damps_by_phase())
    return {};
  for (double &beta : besides.beta_of_phases)
    beta -= parameters.step.least_beta();
  return body->make_damping(besides, communicator);
}

template <int dim>
void ComplexModesAnalysis<dim>::run(RunContext &context)
{
  body->log(context);
  context.remove_results(complex_modes_files());
  body->make_elastic(context.communicator(), true);
  const ElasticBody<dim> &elastic = body->vibrating();
  const auto scope                = context.timer().scope("Complex modes");
  const auto cases                = compute_complex_modes<dim>(
    elastic, parameters,
    highest_frequency_of(parameters, facts.scales.wave_speed, elastic.extent(dim - 1)),
    [&](const ContactParameters &of_case, const double friction_factor) {
      return at_rest(of_case, friction_factor, context);
    },
    body->contact_parts(), facts.scales.shear_impedance, damping(context.communicator()),
    context);
  if (!context.root())
    return;
  log_complex_modes(cases, parameters, context);
  body->summarize("complex modes", context);
  write_complex_tables(cases, parameters, context);
  const std::string path       = context.file("complex_modes.h5");
  std::optional<Hdf5File> file = body->create_file(path, "mesoslip-complex-modes");
  write_shapes(file, path, write_complex_modes(*file, cases, elastic, parameters),
               context);
}

/** Also writes the shapes of a counter body. */
template <int dim>
void ComplexModesAnalysis<dim>::write_shapes(std::optional<Hdf5File> &file,
                                             const std::string &path,
                                             const ComplexShapes &shapes,
                                             RunContext &context) const
{
  std::vector<ShownFields> shown;
  for (std::size_t part = 0; part < 2 && !shapes.numbers.empty(); ++part)
    {
      ShownFields &fields = shown.emplace_back();
      fields.name         = part == 0 ? "shape_real" : "shape_imaginary";
      fields.dataset      = "/complex_modes/" + fields.name;
      for (const NodalField<double> &shape : shapes.parts[part])
        fields.fields.push_back(&shape);
    }
  body->write_and_show(file, path, shown, shapes.numbers);
  body->write_below(context.file("counter_body.h5"), "mesoslip-complex-modes", shown,
                    shapes.numbers, {});
}

template class ComplexModesAnalysis<2>;
template class ComplexModesAnalysis<3>;
} // namespace mesoslip
