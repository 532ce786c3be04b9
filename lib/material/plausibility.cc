#include "material/plausibility.h"

#include <algorithm>
#include <sstream>

namespace mesoslip
{
namespace
{
constexpr double softest = 1e6, largest_contrast = 1e6; // Pa, -

double stiffness(const Phase<2> &phase)
{
  return std::max(phase.stiffness(0, 0), phase.stiffness(1, 1));
}
} // namespace

std::string stiffness_warning(const std::vector<Phase<2>> &phases)
{
  const auto [soft, stiff] = std::minmax_element(
    phases.begin(), phases.end(),
    [](const Phase<2> &a, const Phase<2> &b) { return stiffness(a) < stiffness(b); });
  std::ostringstream text;
  text.precision(3);
  if (phases.empty())
    return "";
  const double contrast = stiffness(*stiff) / stiffness(*soft);
  if (contrast > largest_contrast * (1. + 1e-9))
    text << "phase '" << stiff->name << "' is " << contrast
         << " times as stiff as phase '" << soft->name
         << "'; is one of them in GPa or MPa? Moduli are in Pa";
  else if (stiffness(*soft) < softest)
    text << "phase '" << soft->name << "' has a stiffness of " << stiffness(*soft)
         << " Pa, less than soft rubber; is it in GPa or MPa? Moduli are in Pa";
  return text.str();
}
} // namespace mesoslip
