#include "sliding/analyses/frequency_derivatives.h"

#include "base/exchange.h"
#include "base/text.h"
#include "body/elastic_body.h"
#include "exchange/rve_file.h"
#include "io/table.h"
#include "morphology/phases/phase_parameters.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>

namespace mesoslip
{
namespace
{
/** Variations of the constants in the RVE file of a body. */
template <int dim>
std::vector<BodyVariation<dim>> variations_of_file(const BodyParameters &body)
{
  const RveFile<dim> rve(body.rve_file);
  std::vector<BodyVariation<dim>> variations;
  for (const VariedConstant<dim> &constant : rve.variations(body.stiffness_name))
    {
      std::vector<Phase<dim>> changed = rve.phases;
      for (Phase<dim> &phase : changed)
        phase.stiffness.setZero();
      changed[constant.phase].stiffness = constant.of_phase;
      BodyVariation<dim> &variation     = variations.emplace_back();
      variation.name      = rve.phases[constant.phase].name + "_" + constant.name;
      variation.deviation = constant.deviation;
      if (body.heterogeneous)
        for (const Phase<dim> &phase : oriented_phases(changed, rve.materials.oriented))
          variation.changes.push_back(phase.stiffness);
      else
        variation.changes = {constant.of_volume.at(body.stiffness_name)};
    }
  return variations;
}

/** Variations of the constants of the groups of a mesh. */
template <int dim>
std::vector<BodyVariation<dim>>
variations_of_groups(const std::vector<PhaseParameters> &phases)
{
  std::vector<BodyVariation<dim>> variations;
  for (std::size_t p = 0; p < phases.size(); ++p)
    for (const PhaseConstant<dim> &constant : phases[p].template constants<dim>())
      {
        BodyVariation<dim> &variation = variations.emplace_back();
        variation.name                = phases[p].name + "_" + constant.name;
        variation.deviation           = constant.deviation;
        variation.changes.assign(phases.size(), VoigtMatrix<dim>::Zero());
        variation.changes[p] = constant.derivative;
      }
  return variations;
}

/** Derivatives of the frequencies: by case, mode and phase. */
template <int dim>
using Derivatives = std::vector<std::vector<std::vector<VoigtMatrix<dim>>>>;

template <int dim>
void write_derivatives(const std::vector<ModalCase<dim>> &cases,
                       const Derivatives<dim> &derivatives,
                       const std::vector<Phase<dim>> &phases,
                       const std::string &path)
{
  std::vector<std::string> headings = {"bottom", "mode [-]", "phase"};
  for (const StiffnessEntry &entry : stiffness_entries<dim>())
    headings.push_back("d" + entry.name + " [Hz/Pa]");
  TableWriter table(path, headings);
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (std::size_t k = 0; k < derivatives[c].size(); ++k)
      for (std::size_t p = 0; p < derivatives[c][k].size(); ++p)
        {
          const VoigtMatrix<dim> &G    = derivatives[c][k][p];
          std::vector<std::string> row = {cases[c].bottom, std::to_string(k + 1),
                                          derivatives[c][k].size() == phases.size()
                                            ? phases[p].name
                                            : "material " + std::to_string(p + 1)};
          for (const auto &[i, j, name] : stiffness_entries<dim>())
            row.push_back(to_text(i == j ? G(i, j) : 2. * G(i, j)));
          table.add_row(row);
        }
  table.flush();
}

/** Change of a frequency by one standard deviation of each constant (Hz). */
template <int dim>
std::vector<double> parts_of(const std::vector<VoigtMatrix<dim>> &derivatives,
                             const std::vector<BodyVariation<dim>> &variations)
{
  std::vector<double> parts;
  for (const BodyVariation<dim> &variation : variations)
    {
      double change = 0.;
      for (std::size_t p = 0; p < derivatives.size(); ++p)
        change += derivatives[p].cwiseProduct(variation.changes[p]).sum();
      parts.push_back(change * variation.deviation);
    }
  return parts;
}

template <int dim>
void write_uncertainty(const std::vector<ModalCase<dim>> &cases,
                       const Derivatives<dim> &derivatives,
                       const std::vector<BodyVariation<dim>> &variations,
                       RunContext &context)
{
  std::vector<std::string> headings = {"bottom", "mode [-]", "frequency [Hz]",
                                       "standard_deviation [Hz]",
                                       "relative_deviation [-]"};
  for (const BodyVariation<dim> &variation : variations)
    headings.push_back("variance_from_" + variation.name + " [-]");
  TableWriter table(context.file("frequency_uncertainty.csv"), headings);
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (std::size_t k = 0; k < derivatives[c].size(); ++k)
      {
        const double frequency          = cases[c].modes.modes[k].frequency;
        const std::vector<double> parts = parts_of(derivatives[c][k], variations);
        const Eigen::ArrayXd squares =
          Eigen::Map<const Eigen::ArrayXd>(parts.data(),
                                           static_cast<Eigen::Index>(parts.size()))
            .square();
        const double deviation       = std::sqrt(squares.sum());
        std::vector<std::string> row = {cases[c].bottom, std::to_string(k + 1),
                                        to_text(frequency), to_text(deviation),
                                        to_text(deviation / frequency)};
        for (const double part : parts)
          row.push_back(to_text(deviation > 0. ? std::pow(part / deviation, 2) : 0.));
        table.add_row(row);
        context.summary()["frequency_deviations"][cases[c].bottom].push_back(deviation);
        Eigen::Index largest = 0;
        squares.maxCoeff(&largest);
        context.log(brief_text(3, "  bottom ", cases[c].bottom, ", mode ", k + 1,
                               ": standard deviation ", 1e-3 * deviation, " kHz (",
                               100. * deviation / frequency, " %, most of it from ",
                               variations[static_cast<std::size_t>(largest)].name, ")"));
      }
  table.flush();
}
} // namespace

template <int dim>
std::vector<BodyVariation<dim>> body_variations(const GivenBody<dim> &body)
{
  const ContactParameters &parameters = body.parameters;
  std::vector<BodyVariation<dim>> variations;
  if (parameters.counter != nullptr)
    return variations;
  if (!parameters.body.rve_file.empty())
    variations = variations_of_file<dim>(parameters.body);
  else if (parameters.mesh.is_given())
    variations = variations_of_groups<dim>(parameters.mesh.phases);
  variations.erase(std::remove_if(variations.begin(), variations.end(),
                                  [](const BodyVariation<dim> &variation) {
                                    return variation.deviation == 0.;
                                  }),
                   variations.end());
  return variations;
}

template <int dim>
std::vector<VoigtMatrix<dim>> frequency_derivatives(const ElasticBody<dim> &body,
                                                    const VibrationMode<dim> &mode)
{
  std::vector<VoigtMatrix<dim>> derivatives = body.strain_products(mode.shape);
  for (VoigtMatrix<dim> &of_phase : derivatives)
    of_phase /= 8. * M_PI * M_PI * mode.frequency * mode.modal_mass;
  return derivatives;
}

template <int dim>
void write_frequency_derivatives(const GivenBody<dim> &body,
                                 const std::vector<ModalCase<dim>> &cases,
                                 RunContext &context)
{
  std::vector<BodyVariation<dim>> variations;
  on_root(context.communicator(), [&]() { variations = body_variations(body); });
  const bool wanted = body.parameters.modal_derivatives || !variations.empty();
  if (!mpi::broadcast(wanted, 0, context.communicator()))
    return;
  Derivatives<dim> derivatives(cases.size());
  for (std::size_t c = 0; c < cases.size(); ++c)
    for (const VibrationMode<dim> &mode : cases[c].modes.modes)
      derivatives[c].push_back(frequency_derivatives(body.vibrating(), mode));
  if (!context.root())
    return;
  if (body.parameters.modal_derivatives)
    write_derivatives(cases, derivatives, body.facts().phases,
                      context.file("frequency_derivatives.csv"));
  if (!variations.empty())
    write_uncertainty(cases, derivatives, variations, context);
}

#define MESOSLIP_INSTANTIATE(dim)                                                   \
  template std::vector<BodyVariation<dim>> body_variations(const GivenBody<dim> &); \
  template std::vector<VoigtMatrix<dim>> frequency_derivatives(                     \
    const ElasticBody<dim> &, const VibrationMode<dim> &);                          \
  template void write_frequency_derivatives(                                        \
    const GivenBody<dim> &, const std::vector<ModalCase<dim>> &, RunContext &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
