#ifndef mesoslip_material_plausibility_h
#define mesoslip_material_plausibility_h

#include "material/stiffness.h"
#include "material/voigt.h"

#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace mesoslip
{
/** What the value of a key may reasonably be; outside it looks like a slip of units. */
struct PlausibleRange
{
  std::string key;   ///< such as "Friction/Regularization time"
  double value = 0.; ///< that was given, or follows from what was given
  std::string unit;  ///< such as "s"; empty for a pure number

  double lowest      = -std::numeric_limits<double>::infinity(); ///< itself plausible
  std::string if_low = {}; ///< how the sentence goes on below the lowest

  double highest      = std::numeric_limits<double>::infinity(); ///< itself plausible
  std::string if_high = {}; ///< how the sentence goes on above the highest
};

/** "KEY is VALUE UNIT, ..." for each value outside its range; NaN is below all. */
std::vector<std::string> implausible(const std::vector<PlausibleRange> &ranges);

/** "1500 s": four digits and the unit. */
std::string quantity_text(const double value, const std::string &unit);

/** @p parts one after the other, numbers with up to @p digits significant digits. */
template <typename... Parts>
std::string brief_text(const int digits, const Parts &...parts)
{
  std::ostringstream text;
  text.precision(digits);
  (text << ... << parts);
  return text.str();
}

/** Of a density: 25 (foam) to 25,000 kg/m^3; 0, one that is not given, is plausible. */
PlausibleRange plausible_density(const std::string &key, const double density);

/** Of a friction coefficient: up to 2. */
PlausibleRange plausible_friction(const std::string &key, const double coefficient);

/** Of a side of a body or volume: 0.1 micrometres to 10 m. */
PlausibleRange plausible_length(const std::string &key, const double length);

/** Of a pressure on a body of that stiffness (Pa): strains of 1e-9 to 0.01; 0 is plausible. */
PlausibleRange
plausible_pressure(const std::string &key, const double pressure, const double stiffness);

/** Densities and friction coefficients below Phases/NAME/. */
template <int dim>
std::vector<PlausibleRange> plausible_phases(const std::vector<Phase<dim>> &phases);

/**
 * What looks like a modulus typed in another unit than Pa: a phase softer than soft
 * rubber (1 MPa), or one more than a million times as stiff as another; one sentence,
 * empty if there is nothing to say. Stiffness is that against changes of shape, 2 G.
 */
template <int dim>
std::string unit_warning(const std::vector<Phase<dim>> &phases);

/** What the cells of a body are, as far as it matters for locking. */
struct CellKinds
{
  MeanDilatation choice = MeanDilatation::automatic; ///< of quadrilaterals and hexahedra
  bool simplices =
    false; ///< whether there are linear triangles or tetrahedra, which lock
};

/** A line for the log on the phases with mean dilatation; none where there are none or simplices. */
template <int dim>
std::vector<std::string> lines_on_cells(const std::vector<Phase<dim>> &phases,
                                        const CellKinds &cells);

/** That cells lock in the least compressible phase, from a Poisson's ratio of 0.49 on, with
 * an estimate of the error: one sentence or none. */
template <int dim>
std::vector<std::string> locking_warnings(const std::vector<Phase<dim>> &phases,
                                          const CellKinds &cells);

/** That local pressures are less certain than strains in the least compressible phase, from the same Poisson's
 * ratio on: one sentence or none. */
template <int dim>
std::vector<std::string> pressure_warnings(const std::vector<Phase<dim>> &phases);

/** unit_warning() and locking_warnings(). */
template <int dim>
std::vector<std::string> stiffness_warnings(const std::vector<Phase<dim>> &phases,
                                            const CellKinds &cells);

/** What makes a static solve hard: phases that differ much, or one that resists some strains much
 * more than others, and cells @p aspect times as long as wide; empty if there is nothing. */
template <int dim>
std::string hard_to_solve(const std::vector<Phase<dim>> &phases, const double aspect);
} // namespace mesoslip

#endif
