#include "sliding/analyses/modal_cases.h"

#include "base/errors.h"
#include "base/text.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "sliding/body_analysis.h"

#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** Name of the axis along the normal of the flat. */
template <int dim>
std::string along_normal()
{
  return std::string(1, "xyz"[dim - 1]);
}

template <int dim>
std::string top_text(const TopSetup &top)
{
  std::string lateral;
  for (unsigned int c = 0; c + 1 < dim; ++c)
    if (top.holds(c))
      lateral += std::string("u_") + "xy"[c] + " = ";
  if (top.is_platen)
    {
      std::string common;
      for (unsigned int c = 0; c < dim; ++c)
        if (top.moves(dim)[c])
          common += std::string(common.empty() ? "" : ", ") + "u_" + "xyz"[c];
      return "rigid platen of " + to_text(top.platen_mass) +
             (dim == 2 ? " kg/m: " : " kg: ") +
             (lateral.empty() ? "" : lateral + "0 and ") + "one common " + common +
             (top.suspension.has_springs() ? ", on springs" : "");
    }
  if (top.is_held())
    return "held: u = 0";
  if (top.suspension.is_there())
    return std::string(top.suspension.has_springs() ? "on springs" : "free") +
           (top.suspension.mass > 0. ? " with its mass" : "");
  return lateral.empty() ? "free" : lateral + "0, free in " + along_normal<dim>();
}

template <int dim>
void log_modes(const ModalCase<dim> &c, const bool of_pair, RunContext &context)
{
  const bool is_free = c.bottom == "free";
  const std::string bottom =
                      "Bottom " + (is_free ? "free (BC1)"
                                           : "held in " + along_normal<dim>() + " (BC2)"),
                    bodies       = is_free ? "Bodies apart (free, BC1)"
                                           : "Bodies touch and slide (held, BC2)";
  const VibrationModes<dim> &all = c.modes;
  context.log((of_pair ? bodies : bottom) + ": " + std::to_string(all.n_solves) +
              " static solves, " + std::to_string(all.solver_iterations) + " iterations" +
              (all.n_rigid_motions > 0 ? "; " + std::to_string(all.n_rigid_motions) +
                                           " rigid motions at 0 Hz not listed"
                                       : ""));
  for (std::size_t k = 0; k < all.modes.size(); ++k)
    context.log(brief_text(3, "  mode ", k + 1, " ", std::fixed, std::setw(9),
                           1e-3 * all.modes[k].frequency, " kHz"));
}

template <int dim>
const char *mass_unit()
{
  return dim == 2 ? "kg/m" : "kg";
}
} // namespace

std::vector<std::string> modal_bottoms(const ContactParameters &parameters)
{
  if (parameters.modal_bottom == "both")
    return {"free", "held"};
  return {parameters.modal_bottom == "free" ? "free" : "held"};
}

TopSetup top_at_start(const ContactParameters &parameters)
{
  TopSetup top = parameters.top;
  if (!(top.hold_from > 0.))
    top.hold();
  return top;
}

void require_modes(const std::size_t n_free, const ContactParameters &parameters)
{
  try
    {
      check_number_of_modes(n_free, parameters.modal);
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(std::string("Modal/Number of modes: ") + e.what());
    }
}

template <int dim>
std::vector<ModalCase<dim>> compute_modes(const ModesOfBottom<dim> &find,
                                          const std::vector<Platen> &platens,
                                          const ContactParameters &parameters,
                                          RunContext &context)
{
  VibrationModesOptions options = parameters.modal;
  options.platens               = platens;
  options.before_solve          = stop_or_report(context, "the static solve");
  std::vector<ModalCase<dim>> cases;
  for (const std::string &bottom : modal_bottoms(parameters))
    {
      const auto scope = context.timer().scope(("Bottom " + bottom).c_str());
      with_advice("loosen Modal/Tolerance or ask for fewer modes", [&]() {
        cases.push_back({bottom, find(bottom == "held", options)});
      });
    }
  context.log("Top: " + top_text<dim>(top_at_start(parameters)) +
              ", as in a transient run" +
              (std::isfinite(parameters.top.hold_from) && parameters.top.hold_from > 0.
                 ? " before Supports/Top/Hold from"
                 : ""));
  for (const ModalCase<dim> &c : cases)
    log_modes(c, parameters.counter != nullptr, context);
  return cases;
}

template <int dim>
void write_modes(const std::vector<ModalCase<dim>> &cases, RunContext &context)
{
  std::vector<std::string> columns = {"bottom", "mode [-]", "frequency [Hz]",
                                      std::string("modal_mass [") + mass_unit<dim>() +
                                        "]"};
  for (unsigned int d = 0; d < dim; ++d)
    columns.push_back(std::string("effective_mass_") + "xyz"[d] + " [-]");
  columns.emplace_back("residual [-]");
  TableWriter table(context.file("modes.csv"), columns);
  nlohmann::json &json = context.summary();
  for (const auto &[bottom, found] : cases)
    {
      for (std::size_t k = 0; k < found.modes.size(); ++k)
        {
          const VibrationMode<dim> &mode = found.modes[k];
          std::vector<std::string> row   = {bottom, std::to_string(k + 1),
                                            to_text(mode.frequency),
                                            to_text(mode.modal_mass)};
          for (const double mass : mode.effective_mass)
            row.push_back(to_text(mass));
          row.push_back(to_text(mode.residual));
          table.add_row(row);
          json["frequencies"][bottom].push_back(mode.frequency);
        }
      json["rigid_motions"][bottom] = found.n_rigid_motions;
      json["iterations"][bottom]    = found.solver_iterations;
    }
  table.flush();
}

template <int dim>
void write_frequencies(Hdf5File &file, const std::vector<ModalCase<dim>> &cases)
{
  for (const ModalCase<dim> &c : cases)
    {
      std::vector<double> frequency, mass;
      for (const VibrationMode<dim> &mode : c.modes.modes)
        {
          frequency.push_back(mode.frequency);
          mass.push_back(mode.modal_mass);
        }
      write_series(
        file, "/modes/" + c.bottom,
        {{"frequency", "Hz", &frequency}, {"modal_mass", mass_unit<dim>(), &mass}});
    }
}

#define MESOSLIP_INSTANTIATE(dim)                                                       \
  template std::vector<ModalCase<dim>> compute_modes(                                   \
    const ModesOfBottom<dim> &, const std::vector<Platen> &, const ContactParameters &, \
    RunContext &);                                                                      \
  template void write_modes(const std::vector<ModalCase<dim>> &, RunContext &);         \
  template void write_frequencies(Hdf5File &, const std::vector<ModalCase<dim>> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
