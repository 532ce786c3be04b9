#include "sliding/analyses/modal.h"

#include "base/exchange.h"
#include "sliding/analyses/modal_cases.h"

#include <optional>
#include <utility>

namespace mesoslip
{
template <int dim>
ModalAnalysis<dim>::ModalAnalysis(std::unique_ptr<GivenBody<dim>> given)
  : BodyAnalysis<dim>(std::move(given))
{
  const TopSetup top = top_at_start(parameters);
  for (const std::string &bottom : modal_bottoms(parameters))
    require_modes(body->n_free(top, bottom == "held") + body->n_platen_moves(top),
                  parameters);
}

template <int dim>
void ModalAnalysis<dim>::run(RunContext &context)
{
  body->log(context);
  context.remove_results({"modal.h5", "modal.xdmf", "modal-phases.xdmf", "modes.csv"});
  body->make_elastic(context.communicator());
  const auto cases = compute_modes<dim>(
    body->elastic(), body->platens(top_at_start(parameters)),
    [this](const bool bottom_held) {
      return body->held(top_at_start(parameters), bottom_held);
    },
    parameters, context);
  const auto scope       = context.timer().scope("Output");
  const std::string path = context.file("modal.h5");
  std::optional<Hdf5File> file;
  on_root(context.communicator(), [&]() {
    body->summarize("modal", context);
    write_modes(cases, context);
    file.emplace(body->create_file(path, "mesoslip-modal"));
    write_frequencies(*file, cases);
  });
  for (const ModalCase<dim> &c : cases)
    {
      std::vector<const NodalField<double> *> shapes;
      for (const VibrationMode<dim> &mode : c.modes.modes)
        shapes.push_back(&mode.shape);
      body->write_fields(file, path, shapes_name(c), shapes);
    }
  if (!context.root())
    return;
  file->close();
  const ShownShapes shown = shown_shapes(cases);
  body->show(path, shown.fields, shown.numbers);
}

template class ModalAnalysis<2>;
template class ModalAnalysis<3>;
} // namespace mesoslip
