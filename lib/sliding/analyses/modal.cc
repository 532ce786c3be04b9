#include "sliding/analyses/modal.h"

#include "base/errors.h"
#include "body/grid_body.h"
#include "exchange/datasets.h"
#include "exchange/dynamics_file.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** One of the paper's boundary conditions and the modes under it. */
struct ModalCase
{
  std::string bottom;   ///< "free" (BC1) or "held" (BC2: u_y = 0)
  VibrationModes modes; ///< lowest first
};

std::vector<std::string> bottoms(const ContactParameters &parameters)
{
  if (parameters.modal_bottom == "both")
    return {"free", "held"};
  return {parameters.modal_bottom == "free" ? "free" : "held"};
}

/** The top of the transient run as long as it is loaded. */
TopSetup top_at_start(const ContactParameters &parameters)
{
  TopSetup top = parameters.top;
  if (!(top.hold_from > 0.))
    top.kind = TopSetup::Kind::held;
  return top;
}

std::string top_text(const TopSetup &top)
{
  switch (top.kind)
    {
    case TopSetup::Kind::platen:
      return "rigid platen of " + to_text(top.platen_mass) +
             " kg/m: u_x = 0 and one common u_y";
    case TopSetup::Kind::held:
      return "held: u = 0";
    default:
      return top.lateral_held ? "u_x = 0, free in y" : "free";
    }
}

void log_modes(const ModalCase &c, RunContext &context)
{
  const VibrationModes &all = c.modes;
  context.log(
    std::string("Bottom ") + (c.bottom == "free" ? "free (BC1)" : "held in y (BC2)") +
    ": " + std::to_string(all.n_solves) + " static solves, " +
    std::to_string(all.solver_iterations) + " iterations" +
    (all.n_rigid_motions > 0
       ? "; " + std::to_string(all.n_rigid_motions) + " rigid motions at 0 Hz not listed"
       : ""));
  for (std::size_t k = 0; k < all.modes.size(); ++k)
    context.log(brief_text(3, "  mode ", k + 1, std::fixed, std::setw(10),
                           1e-3 * all.modes[k].frequency, " kHz"));
}

void write_table(const std::vector<ModalCase> &cases, const RunContext &context)
{
  TableWriter table(context.file("modes.csv"),
                    {"bottom", "mode [-]", "frequency [Hz]", "modal_mass [kg/m]",
                     "effective_mass_x [-]", "effective_mass_y [-]", "residual [-]"});
  for (const ModalCase &c : cases)
    for (std::size_t k = 0; k < c.modes.modes.size(); ++k)
      {
        const VibrationMode &mode = c.modes.modes[k];
        table.add_row(std::vector<std::string>{
          c.bottom, std::to_string(k + 1), to_text(mode.frequency),
          to_text(mode.modal_mass), to_text(mode.effective_mass[0]),
          to_text(mode.effective_mass[1]), to_text(mode.residual)});
      }
  table.flush();
}

void write_file(const std::vector<ModalCase> &cases,
                const BodyDescription &body,
                const RunContext &context)
{
  DynamicsFile file =
    DynamicsFile::create(context.file("modal.h5"), body, "mesoslip-modal");
  std::vector<std::pair<std::string, std::string>> shown;
  // The time of a frame is the number of its mode.
  std::vector<double> numbers;
  for (const ModalCase &c : cases)
    {
      std::vector<double> frequency, mass, shapes;
      numbers.clear();
      for (const VibrationMode &mode : c.modes.modes)
        {
          numbers.push_back(static_cast<double>(numbers.size()) + 1.);
          frequency.push_back(mode.frequency);
          mass.push_back(mode.modal_mass);
          const std::vector<double> shape = interleaved(mode.shape);
          shapes.insert(shapes.end(), shape.begin(), shape.end());
        }
      const std::string group = "/modes/" + c.bottom;
      write_series(file, group,
                   {{"frequency", "Hz", &frequency}, {"modal_mass", "kg/m", &mass}});
      write_dataset(file, group + "/shape",
                    {numbers.size(), body.grid.cells[1] + 1u, body.grid.cells[0] + 1u, 2},
                    shapes);
      shown.emplace_back("bottom_" + c.bottom, group + "/shape");
    }
  file.show(shown, numbers);
  file.close();
}
} // namespace

DofMask modal_constraints(const ContactParameters &parameters,
                          const UniformMaterial &material,
                          const bool bottom_held)
{
  DofMask held = held_by_supports(material, parameters.sides, top_at_start(parameters));
  if (bottom_held)
    held.constrain_row(1, 0);
  return held;
}

VibrationModesOptions modal_options(const ContactParameters &parameters)
{
  VibrationModesOptions options = parameters.modal;
  if (top_at_start(parameters).kind == TopSetup::Kind::platen)
    options.platen_mass = parameters.top.platen_mass;
  return options;
}

ModalAnalysis::ModalAnalysis(const ContactParameters &p)
  : BodyAnalysis(p)
{
  const GridBody<2> elastic(material);
  for (const std::string &bottom : bottoms(parameters))
    try
      {
        check_number_of_modes(elastic,
                              modal_constraints(parameters, material, bottom == "held"),
                              modal_options(parameters));
      }
    catch (const std::invalid_argument &e)
      {
        throw UserError(std::string("Modal/Number of modes: ") + e.what());
      }
}

void ModalAnalysis::run(RunContext &context)
{
  log_body(context);
  context.remove_results({"modal.h5", "modal.xdmf", "modal-phases.xdmf", "modes.csv"});
  const auto elastic =
    make_body(material, parameters.static_solver, context.communicator());
  VibrationModesOptions options = modal_options(parameters);
  options.before_solve          = stop_or_report(context, "the static solve");
  std::vector<ModalCase> cases;
  for (const std::string &bottom : bottoms(parameters))
    {
      const auto scope = context.timer().scope(("Bottom " + bottom).c_str());
      const auto held  = modal_constraints(parameters, material, bottom == "held");
      with_advice("loosen Modal/Tolerance or ask for fewer modes", [&]() {
        cases.push_back({bottom, vibration_modes(*elastic, held, options)});
      });
    }
  context.log("Top: " + top_text(top_at_start(parameters)) + ", as in a transient run" +
              (std::isfinite(parameters.top.hold_from) && parameters.top.hold_from > 0.
                 ? " before Top/Hold from"
                 : ""));
  for (const ModalCase &c : cases)
    log_modes(c, context);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Output");
  write_table(cases, context);
  write_file(cases, body, context);
  summarize_body("modal", context);
  nlohmann::json &json = context.summary();
  for (const auto &[bottom, found] : cases)
    {
      for (const VibrationMode &mode : found.modes)
        json["frequencies"][bottom].push_back(mode.frequency);
      json["rigid_motions"][bottom] = found.n_rigid_motions;
      json["iterations"][bottom]    = found.solver_iterations;
    }
}
} // namespace mesoslip
