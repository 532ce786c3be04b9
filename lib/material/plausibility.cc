#include "material/plausibility.h"

#include "material/stiffness.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
constexpr double softest = 1e6, largest_contrast = 1e6; // Pa, -
// Strains: below the smallest a pressure looks like a slip, above the largest a solid
// yields.
constexpr double smallest_strain = 1e-9, largest_strain = 1e-2;
// Limit of lambda / mu: 0.49 of Poisson's ratio.
constexpr double locks_from = 48.999;
// Above these limits a solve takes long, in single precision in particular.
constexpr double hard_contrast = 1e4, hard_anisotropy = 1e3, hard_aspect = 30.;

/** Largest stiffness against a strain along one axis compensated along another; 2 G for
 * isotropic phases, nearly independent of Poisson's ratio. */
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

/** The softest and the stiffest phase; @p phases must not be empty. */
template <int dim>
auto extremes(const std::vector<Phase<dim>> &phases)
{
  return std::minmax_element(phases.begin(), phases.end(),
                             [](const Phase<dim> &a, const Phase<dim> &b) {
                               return stiffness<dim>(a) < stiffness<dim>(b);
                             });
}

/** lambda / mu of an isotropic phase with the apparent Poisson's ratio. */
template <int dim>
double incompressibility(const Phase<dim> &phase)
{
  const double ratio = apparent_poisson_ratio<dim>(phase.stiffness);
  return 2. * ratio / (1. - 2. * ratio);
}

/** The apparent Poisson's ratio as text. */
template <int dim>
std::string ratio_text(const Phase<dim> &phase)
{
  return brief_text(7, apparent_poisson_ratio<dim>(phase.stiffness));
}

/** The nearly incompressible phase with the largest Poisson's ratio among the phases that
 * @p counts() accepts; null: none. */
template <int dim, typename Counts>
const Phase<dim> *least_compressible(const std::vector<Phase<dim>> &phases,
                                     const Counts &counts)
{
  const Phase<dim> *worst = nullptr;
  for (const Phase<dim> &phase : phases)
    if (counts(phase) && incompressibility<dim>(phase) >= locks_from &&
        (worst == nullptr ||
         incompressibility<dim>(phase) > incompressibility<dim>(*worst)))
      worst = &phase;
  return worst;
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

PlausibleRange
plausible_pressure(const std::string &key, const double pressure, const double stiffness)
{
  const double strain = pressure / stiffness;
  return {key,
          pressure,
          "Pa",
          pressure > 0. ? smallest_strain * stiffness : 0.,
          "which strains the body by " + quantity_text(strain, "") +
            " only; is it in MPa? Pressures are in Pa",
          largest_strain * stiffness,
          "which strains the body by " + quantity_text(100. * strain, "%") +
            ", beyond small strains; pressures are in Pa"};
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
std::string unit_warning(const std::vector<Phase<dim>> &phases)
{
  if (phases.empty())
    return "";
  const auto [soft, stiff] = extremes<dim>(phases);
  const double contrast    = stiffness<dim>(*stiff) / stiffness<dim>(*soft);
  if (contrast > largest_contrast * (1. + 1e-9))
    return brief_text(3, "phase '", stiff->name, "' is ", contrast,
                      " times as stiff as phase '", soft->name,
                      "'; is one of them in GPa or MPa? Moduli are in Pa");
  if (stiffness<dim>(*soft) < softest)
    return brief_text(
      3, "phase '", soft->name, "' has a stiffness of ", stiffness<dim>(*soft),
      " Pa, less than soft rubber; is it in GPa or MPa? Moduli are in Pa");
  return "";
}

template <int dim>
std::vector<std::string> lines_on_cells(const std::vector<Phase<dim>> &phases,
                                        const CellKinds &cells)
{
  std::string names;
  for (const Phase<dim> &phase : phases)
    if (!cells.simplices && has_mean_dilatation<dim>(phase.stiffness, cells.choice))
      names += (names.empty() ? "" : ", ") + phase.name + " (Poisson's ratio " +
               ratio_text<dim>(phase) + ")";
  if (names.empty())
    return {};
  return {"Mean dilatation of the cells of " + names};
}

template <int dim>
std::vector<std::string> locking_warnings(const std::vector<Phase<dim>> &phases,
                                          const CellKinds &cells)
{
  const Phase<dim> *worst = least_compressible<dim>(phases, [&](const Phase<dim> &phase) {
    return cells.simplices || !has_mean_dilatation<dim>(phase.stiffness, cells.choice);
  });
  if (worst == nullptr)
    return {};
  const char *which = dim == 2 ? "triangles" : "tetrahedra",
             *other = dim == 2 ? "; quadrilaterals do not, nor those of Mesh/Degree = 2"
                               : "; hexahedra do not, nor those of Mesh/Degree = 2";
  if (!cells.simplices)
    {
      which = "fully integrated cells";
      other = "; Mean dilatation = auto prevents it";
    }
  // Measured around stiff inclusions, n cells from one to the next: doc/limits.md.
  const double factor = 2. * incompressibility<dim>(*worst);
  return {brief_text(
    2, "phase '", worst->name, "' is nearly incompressible (Poisson's ratio ",
    ratio_text<dim>(*worst), "): ", which,
    " lock in it, so that what varies over n cells comes out "
    "up to about 1 + ",
    factor, " / n^2 times too stiff, ", 1. + factor / 400., " times for n = 20", other,
    ", see 'Nearly incompressible phases' in doc/limits.md")};
}

template <int dim>
std::vector<std::string> pressure_warnings(const std::vector<Phase<dim>> &phases)
{
  const Phase<dim> *worst =
    least_compressible<dim>(phases, [](const Phase<dim> &) { return true; });
  if (worst == nullptr)
    return {};
  return {
    brief_text(2, "phase '", worst->name, "' is nearly incompressible (Poisson's ratio ",
               ratio_text<dim>(*worst),
               "): errors of the localized strains make errors of the pressure ",
               incompressibility<dim>(*worst),
               " times those of the shear stresses in it; compare with a direct run")};
}

template <int dim>
std::vector<std::string> stiffness_warnings(const std::vector<Phase<dim>> &phases,
                                            const CellKinds &cells)
{
  std::vector<std::string> sentences = locking_warnings<dim>(phases, cells);
  if (const std::string one = unit_warning<dim>(phases); !one.empty())
    sentences.push_back(one);
  return sentences;
}

template <int dim>
std::string hard_to_solve(const std::vector<Phase<dim>> &phases, const double aspect)
{
  std::string causes;
  const auto add = [&](const auto &...parts) {
    causes += (causes.empty() ? "what makes it hard: " : ", ") + brief_text(2, parts...);
  };
  if (aspect > hard_aspect)
    add("cells are ", aspect, " times as long as wide");
  const auto anisotropy = [](const Phase<dim> &phase) {
    const VoigtVector<dim> values = stiffness_eigenvalues<dim>(phase.stiffness);
    return values.maxCoeff() / values.minCoeff();
  };
  const auto worst = std::max_element(phases.begin(), phases.end(),
                                      [&](const Phase<dim> &a, const Phase<dim> &b) {
                                        return anisotropy(a) < anisotropy(b);
                                      });
  if (const double ratio = anisotropy(*worst); ratio > hard_anisotropy)
    add("phase '", worst->name, "' resists some strains ", ratio,
        " times as much as others (Poisson's ratio ", ratio_text<dim>(*worst), ")");
  const auto [soft, stiff] = extremes<dim>(phases);
  if (const double contrast = stiffness<dim>(*stiff) / stiffness<dim>(*soft);
      contrast > hard_contrast)
    add("phase '", stiff->name, "' is ", contrast, " times as stiff as phase '",
        soft->name, "'");
  return causes;
}

#define MESOSLIP_INSTANTIATE(dim)                                                        \
  template std::vector<PlausibleRange> plausible_phases<dim>(                            \
    const std::vector<Phase<dim>> &);                                                    \
  template std::string unit_warning<dim>(const std::vector<Phase<dim>> &);               \
  template std::vector<std::string> lines_on_cells<dim>(const std::vector<Phase<dim>> &, \
                                                        const CellKinds &);              \
  template std::vector<std::string> locking_warnings<dim>(                               \
    const std::vector<Phase<dim>> &, const CellKinds &);                                 \
  template std::vector<std::string> pressure_warnings<dim>(                              \
    const std::vector<Phase<dim>> &);                                                    \
  template std::vector<std::string> stiffness_warnings<dim>(                             \
    const std::vector<Phase<dim>> &, const CellKinds &);                                 \
  template std::string hard_to_solve<dim>(const std::vector<Phase<dim>> &, const double);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
