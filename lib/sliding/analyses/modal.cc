#include "sliding/analyses/modal.h"

#include "base/exchange.h"
#include "sliding/analyses/frequency_derivatives.h"
#include "sliding/analyses/modal_cases.h"

#include <numeric>
#include <optional>
#include <utility>
#include <vector>

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
  context.remove_results({"modal.h5", "modal.xdmf", "modal-phases.xdmf", "modes.csv",
                          "counter_body.h5", "counter_body.xdmf",
                          "counter_body-phases.xdmf", "frequency_derivatives.csv",
                          "frequency_uncertainty.csv"});
  body->make_elastic(context.communicator());
  const TopSetup top = top_at_start(parameters);
  const auto cases   = compute_modes<dim>(
    [&](const bool bottom_held, const VibrationModesOptions &options) {
      return body->modes(top, bottom_held, options);
    },
    body->platens(top), parameters, context);
  write_frequency_derivatives(*body, cases, context);
  const auto scope       = context.timer().scope("Output");
  const std::string path = context.file("modal.h5");
  std::optional<Hdf5File> file;
  on_root(context.communicator(), [&]() {
    body->summarize("modal", context);
    write_modes(cases, context);
    file.emplace(body->create_file(path, "mesoslip-modal"));
    write_frequencies(*file, cases);
  });
  std::vector<ShownFields> shown;
  for (const ModalCase<dim> &c : cases)
    {
      ShownFields &shapes = shown.emplace_back();
      shapes.name         = "bottom_" + c.bottom;
      shapes.dataset      = "/modes/" + c.bottom + "/shape";
      for (const VibrationMode<dim> &mode : c.modes.modes)
        shapes.fields.push_back(&mode.shape);
    }
  std::vector<double> numbers(parameters.modal.n_modes);
  std::iota(numbers.begin(), numbers.end(), 1.);
  body->write_and_show(file, path, shown, numbers);
  if (context.root())
    body->write_below(context.file("counter_body.h5"), "mesoslip-modal", shown, numbers,
                      {});
}

template class ModalAnalysis<2>;
template class ModalAnalysis<3>;
} // namespace mesoslip
