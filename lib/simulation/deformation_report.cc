#include "simulation/deformation_report.h"

#include "material/plausibility.h"
#include "simulation/load_estimates.h"

#include <algorithm>
#include <vector>

namespace mesoslip
{
namespace
{
std::string cell_text(const CellExtreme &cell, const UniformGrid<2> &grid)
{
  return "cell (" + std::to_string(cell.column) + ", " + std::to_string(cell.row) +
         ") around x = " +
         quantity_text(1e3 * (cell.column + 0.5) * grid.spacing[0], "mm") +
         ", y = " + quantity_text(1e3 * (cell.row + 0.5) * grid.spacing[1], "mm");
}

/** The load that alone strains the body most. */
std::string likely_cause(const ContactParameters &parameters,
                         const UniformMaterial &material)
{
  const std::vector<LoadEstimate> loads = load_estimates(parameters, material);
  const LoadEstimate &worst             = *std::max_element(
                loads.begin(), loads.end(),
                [](const LoadEstimate &a, const LoadEstimate &b) { return a.strain < b.strain; });
  if (!(worst.strain > 0.1 * largest_small_strain))
    return "a body that is thrown or turns freely, as its loads alone strain it little; "
           "hold it, or shorten the run";
  return worst.key + " = " + quantity_text(worst.value, worst.unit) +
         ", which alone strains the body by about " +
         quantity_text(100. * worst.strain, "%") + "; reduce it, or check its unit";
}
} // namespace

std::string large_strain_warning(const Deformation &found,
                                 const ContactParameters &parameters,
                                 const UniformMaterial &material,
                                 const std::string &when)
{
  const bool strained = !(found.strain.value <= largest_small_strain);
  if (!strained && found.rotation.value <= largest_small_strain)
    return "";
  const std::string limit = quantity_text(100. * largest_small_strain, "%");
  return (strained ? "the strain is " + quantity_text(100. * found.strain.value, "%")
                   : "the rotation is " + quantity_text(found.rotation.value, "rad")) +
         when + " in " +
         cell_text(strained ? found.strain : found.rotation, material.grid()) +
         ", where the theory is that of small strains and rotations, up to " + limit +
         " or so: results from there on cannot be trusted; likely cause: " +
         likely_cause(parameters, material);
}

std::string inverted_cell_text(const Deformation &found,
                               const ContactParameters &parameters,
                               const UniformMaterial &material)
{
  if (found.jacobian.value > 0.)
    return "";
  return cell_text(found.jacobian, material.grid()) +
         " is turned inside out (strains up to " +
         quantity_text(100. * found.strain.value, "%") +
         "); likely cause: " + likely_cause(parameters, material);
}
} // namespace mesoslip
