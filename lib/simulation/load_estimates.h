#ifndef mesoslip_simulation_load_estimates_h
#define mesoslip_simulation_load_estimates_h

#include "contact/load_history.h"
#include "elasticity/uniform_material.h"
#include "simulation/contact_parameters.h"

#include <string>

namespace mesoslip
{
/** Extremes of a load over a run, from a thousand samples of it. */
struct LoadRange
{
  double smallest = 0.;   ///< in the unit of the load
  double largest  = 0.;   ///< in the unit of the load
  bool finite     = true; ///< whether all samples are

  /** The larger of both without sign. */
  double largest_size() const;
};

/** Of @p load from 0 to @p end (s). */
LoadRange load_range(const LoadHistory &load, const double end);

/** What loads are compared with. */
struct BodyScales
{
  /** Of the stiffest and the fastest class of @p material. */
  explicit BodyScales(const UniformMaterial &material);

  double stiffness  = 0.; ///< D22 (Pa)
  double wave_speed = 0.; ///< of pressure waves along y (m/s)
  double density    = 0.; ///< mean (kg/m^3)
};

/** A load, and the strain that it alone causes in a body of that stiffness. */
struct LoadEstimate
{
  std::string key;    ///< that gives it
  double value = 0.;  ///< its largest size, in its unit
  std::string unit;   ///< Pa, m/s or m/s^2
  double strain = 0.; ///< P / D22, v / c, or rho a H / D22 [-]
};

/** Pressure, initial velocity and acceleration; 0 for a pressure on a held top. */
std::vector<LoadEstimate> load_estimates(const ContactParameters &parameters,
                                         const UniformMaterial &material);
} // namespace mesoslip

#endif
