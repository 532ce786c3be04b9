#include "sliding/mesh/contact_area.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
std::string standing_faces_warning(const MeshBoundary &contact,
                                   const MeshBodyParameters &mesh)
{
  double mean = 0.;
  for (const double area : contact.area)
    mean += std::fabs(area) / static_cast<double>(contact.area.size());
  const auto n = std::count_if(contact.area.begin(), contact.area.end(),
                               [&](const double a) { return !(-a > 1e-9 * mean); });
  if (n == 0)
    return "";
  return "Mesh/Contact boundary: " + std::to_string(n) + " of " +
         std::to_string(contact.area.size()) + " nodes of '" + mesh.contact_boundary +
         "' have no area seen along the normal of the flat, as faces of the group stand "
         "on it or look up; they have no pressure, but count in the shares of sticking, "
         "slipping and separated nodes like all others: leave these faces out of the "
         "group";
}

void require_contact_area(const MeshBodyDescription &body)
{
  const std::vector<double> &area = body.contact.area;
  const auto found =
    std::find_if(area.begin(), area.end(), [](const double a) { return !(a < 0.); });
  if (found == area.end())
    return;
  const std::size_t node = found - area.begin();
  throw UserError("Mesh/Contact boundary: node " + std::to_string(node) +
                  " of the contact has no area seen along the normal of the flat, so no "
                  "pressure for Contact map and Observation/Contact means; leave faces "
                  "that look away from the flat out of the contact, or both keys");
}
} // namespace mesoslip
