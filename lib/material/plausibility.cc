#include "material/plausibility.h"

#include <algorithm>
#include <sstream>

namespace mesoslip
{
namespace
{
constexpr double softest = 1e6, largest_contrast = 1e6; // Pa, -

/** The largest against a strain along one axis that another makes up for; of isotropic phases 2 G,
 * which Poisson's ratio hardly changes. */
template <int dim>
double stiffness(const Phase<dim> &phase)
{
  double largest = 0.;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < i; ++j)
      largest = std::max(largest, 0.5 * (phase.stiffness(i, i) + phase.stiffness(j, j)) -
                                    phase.stiffness(i, j));
  return largest;
}
} // namespace

std::string quantity_text(const double value, const std::string &unit)
{
  std::ostringstream text;
  text.precision(4);
  text << value << (unit.empty() ? "" : " ") << unit;
  return text.str();
}

std::vector<std::string> implausible(const std::vector<PlausibleRange> &ranges)
{
  std::vector<std::string> sentences;
  for (const PlausibleRange &range : ranges)
    {
      const bool low = !(range.value >= range.lowest);
      if (low || range.value > range.highest)
        sentences.push_back(range.key + " is " + quantity_text(range.value, range.unit) +
                            ", " + (low ? range.if_low : range.if_high));
    }
  return sentences;
}

PlausibleRange plausible_density(const std::string &key, const double density)
{
  const std::string question = "; is it in g/cm^3? Densities are in kg/m^3";
  return {key,
          density,
          "kg/m^3",
          density == 0. ? 0. : 25.,
          "less than most foams" + question,
          25000.,
          "more than any solid" + question};
}

PlausibleRange plausible_friction(const std::string &key, const double coefficient)
{
  return {key,
          coefficient,
          "",
          0.,
          "less than none",
          2.,
          "more than dry friction has; is it in per cent?"};
}

PlausibleRange plausible_length(const std::string &key, const double length)
{
  return {key,
          length,
          "m",
          1e-7,
          "no length of a solid with a microstructure; lengths are in m",
          1.,
          "is it in mm? Lengths are in m"};
}

template <int dim>
std::vector<PlausibleRange> plausible_phases(const std::vector<Phase<dim>> &phases)
{
  std::vector<PlausibleRange> ranges;
  for (const Phase<dim> &phase : phases)
    {
      const std::string section = "Phases/" + phase.name + "/";
      ranges.push_back(plausible_density(section + "Density", phase.density));
      ranges.push_back(
        plausible_friction(section + "Friction coefficient", phase.friction_coefficient));
    }
  return ranges;
}

template <int dim>
std::string stiffness_warning(const std::vector<Phase<dim>> &phases)
{
  const auto [soft, stiff] = std::minmax_element(
    phases.begin(), phases.end(), [](const Phase<dim> &a, const Phase<dim> &b) {
      return stiffness<dim>(a) < stiffness<dim>(b);
    });
  std::ostringstream text;
  text.precision(3);
  if (phases.empty())
    return "";
  const double contrast = stiffness<dim>(*stiff) / stiffness<dim>(*soft);
  if (contrast > largest_contrast * (1. + 1e-9))
    text << "phase '" << stiff->name << "' is " << contrast
         << " times as stiff as phase '" << soft->name
         << "'; is one of them in GPa or MPa? Moduli are in Pa";
  else if (stiffness<dim>(*soft) < softest)
    text << "phase '" << soft->name << "' has a stiffness of " << stiffness<dim>(*soft)
         << " Pa, less than soft rubber; is it in GPa or MPa? Moduli are in Pa";
  return text.str();
}

template std::vector<PlausibleRange> plausible_phases<2>(const std::vector<Phase<2>> &);
template std::vector<PlausibleRange> plausible_phases<3>(const std::vector<Phase<3>> &);
template std::string stiffness_warning<2>(const std::vector<Phase<2>> &);
template std::string stiffness_warning<3>(const std::vector<Phase<3>> &);
} // namespace mesoslip
