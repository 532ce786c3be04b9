#include "sliding/analyses/modal.h"

#include "body/grid_body.h"
#include "eigenvalues/free_dofs.h"
#include "exchange/datasets.h"
#include "exchange/dynamics_file.h"

namespace mesoslip
{
DofMask modal_constraints(const ContactParameters &parameters,
                          const UniformMaterial &material,
                          const bool bottom_held)
{
  DofMask held = held_by_supports(material, parameters.sides, top_at_start(parameters));
  if (bottom_held)
    held.constrain_row(1, 0);
  return held;
}

ModalAnalysis::ModalAnalysis(const ContactParameters &p)
  : BodyAnalysis(p)
{
  const GridBody<2> elastic(material);
  for (const std::string &bottom : modal_bottoms(parameters))
    {
      const DofMask held = modal_constraints(parameters, material, bottom == "held");
      require_modes(
        FreeDofs<2>(elastic, held, modal_options(parameters).platen_mass).size(),
        parameters);
    }
}

void ModalAnalysis::run(RunContext &context)
{
  log_body(context);
  context.remove_results({"modal.h5", "modal.xdmf", "modal-phases.xdmf", "modes.csv"});
  const auto elastic =
    make_body(material, parameters.static_solver, context.communicator());
  const auto cases = compute_modes<2>(
    *elastic,
    [this](const bool held) { return modal_constraints(parameters, material, held); },
    parameters, context);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Output");
  summarize_body("modal", context);
  write_modes(cases, context);
  DynamicsFile file =
    DynamicsFile::create(context.file("modal.h5"), body, "mesoslip-modal");
  write_frequencies(file, cases);
  for (const ModalCase<2> &c : cases)
    {
      std::vector<double> shapes;
      for (const VibrationMode<2> &mode : c.modes.modes)
        {
          const std::vector<double> shape = interleaved(mode.shape);
          shapes.insert(shapes.end(), shape.begin(), shape.end());
        }
      write_dataset(
        file, shapes_name(c),
        {c.modes.modes.size(), body.grid.cells[1] + 1u, body.grid.cells[0] + 1u, 2},
        shapes);
    }
  const ShownShapes shown = shown_shapes(cases);
  file.show(shown.fields, shown.numbers);
  file.close();
}
} // namespace mesoslip
