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
/** Plausible range of a key's value; a value outside it looks like a wrong unit. */
struct PlausibleRange
{
  std::string key;   ///< such as "Friction/Regularization time"
  double value = 0.; ///< the given value, or a value derived from it
  std::string unit;  ///< such as "s"; empty for a pure number

  double lowest      = -std::numeric_limits<double>::infinity(); ///< inclusive
  std::string if_low = {}; ///< end of the sentence for a value below the range

  double highest      = std::numeric_limits<double>::infinity(); ///< inclusive
  std::string if_high = {}; ///< end of the sentence for a value above the range
};

/** "KEY is VALUE UNIT, ..." for each value outside its range; NaN is below all. */
std::vector<std::string> implausible(const std::vector<PlausibleRange> &ranges);

/** "1500 s": a number with four digits and its unit. */
std::string quantity_text(const double value, const std::string &unit);

/** Concatenates @p parts; numbers have up to @p digits significant digits. */
template <typename... Parts>
std::string brief_text(const int digits, const Parts &...parts)
{
  std::ostringstream text;
  text.precision(digits);
  (text << ... << parts);
  return text.str();
}

/** Range of a density: 25 (foam) to 25,000 kg/m^3; 0 (not given) is plausible. */
PlausibleRange plausible_density(const std::string &key, const double density);

/** Range of a friction coefficient: up to 2. */
PlausibleRange plausible_friction(const std::string &key, const double coefficient);

/** Range of a side of a body or volume: 0.1 micrometres to 10 m. */
PlausibleRange plausible_length(const std::string &key, const double length);

/** Range of a pressure on a body of this @p stiffness (Pa): strains of 1e-9 to 0.01; 0 is
 * plausible. */
PlausibleRange
plausible_pressure(const std::string &key, const double pressure, const double stiffness);

/** Ranges of densities and friction coefficients below Phases/NAME/. */
template <int dim>
std::vector<PlausibleRange> plausible_phases(const std::vector<Phase<dim>> &phases);

/**
 * Warning on a modulus that looks like a unit other than Pa: a phase softer than soft
 * rubber (1 MPa), or more than a million times as stiff as another phase; one sentence,
 * or empty. Stiffness is measured in shape change, 2 G.
 */
template <int dim>
std::string unit_warning(const std::vector<Phase<dim>> &phases);

/** Properties of the cells of a body that matter for locking. */
struct CellKinds
{
  MeanDilatation choice = MeanDilatation::automatic; ///< for quadrilaterals and hexahedra
  bool simplices =
    false; ///< whether there are linear triangles or tetrahedra, which lock
};

/** A line for the log on the phases with mean dilatation; empty if there are none, or
 * with simplices. */
template <int dim>
std::vector<std::string> lines_on_cells(const std::vector<Phase<dim>> &phases,
                                        const CellKinds &cells);

/** Warning that cells lock in the least compressible phase, from a Poisson's ratio of
 * 0.49 on, with an estimate of the error: one sentence or none. */
template <int dim>
std::vector<std::string> locking_warnings(const std::vector<Phase<dim>> &phases,
                                          const CellKinds &cells);

/** Warning that local pressures are less certain than strains in the least compressible
 * phase, from a Poisson's ratio of 0.49 on: one sentence or none. */
template <int dim>
std::vector<std::string> pressure_warnings(const std::vector<Phase<dim>> &phases);

/** Warnings of unit_warning() and locking_warnings(). */
template <int dim>
std::vector<std::string> stiffness_warnings(const std::vector<Phase<dim>> &phases,
                                            const CellKinds &cells);

/** Reasons why a static solve is hard: phases that differ much, a phase that resists some
 * strains much more than others, or cells @p aspect times as long as wide; empty if
 * there are none. */
template <int dim>
std::string hard_to_solve(const std::vector<Phase<dim>> &phases, const double aspect);
} // namespace mesoslip

#endif
