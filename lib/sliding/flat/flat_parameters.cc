#include "parameters/keys.h"
#include "sliding/contact_parameters.h"
#include "sliding/supports/load_keys.h"

#include <cmath>
#include <vector>

namespace mesoslip
{
namespace
{
/** Sets the direction of the flat in @p p.
 * @return its speed along it (m/s) */
double bind_flat_direction(Keys &keys, ContactParameters &p)
{
  std::vector<double> velocity = {2.};
  keys.bind_list("Velocity", velocity, Range::any(),
                 "Velocity of the rigid flat along x and, in 3D, y (0 where it is left "
                 "out). With two components a ramp or an expression is along their "
                 "direction [m/s]",
                 1, 2);
  keys.require(velocity.size() < 2 || p.mesh.mesh.dim == 3, "Velocity",
               "it has two components, but Dimension is 2; give the one along x");
  if (velocity.size() < 2 || velocity[1] == 0.)
    return velocity[0];
  const double speed = std::hypot(velocity[0], velocity[1]);
  keys.require(std::isfinite(speed), "Velocity", "its size is infinite; give it in m/s");
  p.contact.flat_direction = {{velocity[0] / speed, velocity[1] / speed}};
  p.top.direction          = p.contact.flat_direction;
  return speed;
}
} // namespace

void ContactParameters::bind_loads(Keys &keys)
{
  const auto section    = keys.section("Flat");
  const double speed    = bind_flat_direction(keys, *this);
  contact.flat_velocity = bind_history(keys, speed, "velocity", "m/s");
  keys.bind("Gap", contact.gap, Range::non_negative(),
            "Distance between the body and the plane of the flat at the start [m]");
  double stiffness = automatic, along = automatic;
  keys.bind_or_auto("Normal stiffness", stiffness, Range::positive(),
                    "Stiffness for the area of springs between body and flat, as of "
                    "the asperities of rough surfaces; auto: none, the flat is rigid "
                    "[Pa/m]");
  if (!std::isnan(stiffness))
    contact.normal_spring.stiffness = stiffness;
  keys.bind("Normal exponent", contact.normal_spring.exponent, Range::closed(1., 10.),
            "n of springs between body and flat whose pressure grows with the power n of "
            "their depth, 2 to 3.3 of rough surfaces; 1: they are linear [-]");
  keys.bind("Normal stiffness at", contact.normal_spring.at, Range::non_negative(),
            "Pressure at which they have the Normal stiffness, which grows with its "
            "power 1 - 1/n [Pa]");
  keys.only_if(contact.is_compliant(), {"Normal exponent"},
               "Flat/Normal stiffness is auto", "give it");
  keys.only_if(contact.normal_spring.exponent != 1., {"Normal stiffness at"},
               "Flat/Normal exponent is 1", "set it to 2, say");
  keys.require(
    contact.normal_spring.exponent == 1. || contact.normal_spring.at > 0.,
    "Normal stiffness at",
    "it is 0; give the pressure in Pa at which the springs have the Normal stiffness");
  keys.bind_or_auto(
    "Tangential stiffness", along, Range::positive(),
    "The same along the flat, through which it drags what does not slide; "
    "auto: none, what does not slide moves with the flat [Pa/m]");
  if (!std::isnan(along))
    contact.tangential_stiffness = along;
  profile.bind(keys, mesh.mesh.dim);
}
} // namespace mesoslip
