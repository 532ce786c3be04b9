#include "sliding/supports/plausible_supports.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
PlausibleRange plausible_springs(const std::string &key,
                                 const double stiffness,
                                 const ContactParameters &parameters,
                                 const double height)
{
  const double pressure = std::fabs(parameters.top.pressure.amplitude());
  PlausibleRange range;
  range.key    = key;
  range.value  = stiffness;
  range.unit   = "Pa/m";
  range.lowest = 100. * pressure / height;
  range.if_low =
    "so that a traction as large as Supports/Top/Pressure moves the springs by " +
    quantity_text(pressure / stiffness, "m") + " under a body of " +
    quantity_text(height, "m") + "; 100 MPa per micrometre are 1e14 Pa/m";
  return range;
}

std::vector<PlausibleRange> plausible_suspension(const ContactParameters &parameters,
                                                 const SideSupport &side,
                                                 const BodyScales &scales)
{
  const Suspension &suspension = side.suspension;
  const double pressure        = std::fabs(parameters.top.pressure.amplitude()),
               body            = scales.stiffness / scales.height,
               impedance       = scales.stiffness / scales.wave_speed;
  double softest = std::numeric_limits<double>::infinity(), stiffest = 0., thickest = 0.;
  for (unsigned int c = 0; c < scales.dim; ++c)
    {
      if (suspension.stiffness[c] > 0.)
        softest = std::min(softest, suspension.stiffness[c]);
      stiffest = std::max(stiffest, suspension.stiffness[c]);
      thickest = std::max(thickest, suspension.dashpot[c]);
    }
  const std::string of_area = "; it is for the area, that of N/m over m^2";
  PlausibleRange soft{side.key("Spring stiffness"), softest, "Pa/m"}, stiff = soft,
                                                                      thick = soft;
  soft.lowest = parameters.analysis == ContactAnalysis::modal || std::isinf(softest)
                  ? 0.
                  : 1e-3 * pressure / scales.height;
  soft.if_low =
    "so that a traction as large as Supports/Top/Pressure stretches the springs by " +
    quantity_text(pressure / softest, "m") + of_area;
  stiff.value   = stiffest;
  stiff.highest = 1e6 * body;
  stiff.if_high =
    "a million times as stiff as the body, " + quantity_text(body, "Pa/m") +
    (parameters.analysis == ContactAnalysis::transient ? ", and the time step shrinks"
                                                       : "") +
    of_area;
  thick.key     = side.key("Dashpot");
  thick.value   = thickest;
  thick.unit    = "Pa s/m";
  thick.highest = 1e3 * impedance;
  thick.if_high =
    "a thousand times the impedance of the body, " + quantity_text(impedance, "Pa s/m") +
    ", so that the side follows its far end; it is for the area, that of N s/m "
    "over m^2";
  PlausibleRange heavy{side.key("Platen mass"), side.platen_mass, scales.mass_unit()};
  heavy.highest = 1e4 * scales.mass;
  heavy.if_high = "more than 10000 times the body's " +
                  quantity_text(scales.mass, scales.mass_unit()) + "; it is in kg" +
                  (scales.dim == 2 ? " per m of thickness" : "");
  return {soft, stiff, thick, heavy};
}
} // namespace mesoslip
