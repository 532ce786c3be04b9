#ifndef mesoslip_sliding_complex_complex_parameters_h
#define mesoslip_sliding_complex_complex_parameters_h

#include <limits>
#include <vector>

namespace mesoslip
{
class Keys;
struct ContactParameters;
struct SlidingLaw;

/** Parameter that a sweep changes. */
enum class ModeSweep
{
  none,
  coefficient,
  regularization_time,
  velocity,
  pressure,
  normal_stiffness
};

/** Section Complex modes. */
struct ComplexModesParameters
{
  double lowest_frequency = 0.; ///< Hz

  /** Hz; NaN: the frequency of a longitudinal wave as long as the body is high. */
  double highest_frequency = std::numeric_limits<double>::quiet_NaN();

  double least_growth   = 0.;              ///< 1/s, not positive
  double tolerance      = 1e-10;           ///< relative, of the eigenvalues
  bool count            = true;            ///< whether the search is checked
  unsigned int n_shapes = 20;              ///< largest number of shapes written
  ModeSweep sweep       = ModeSweep::none; ///< swept parameter
  std::vector<double> values;              ///< values of the swept parameter, in its unit

  /** Binds the keys.
   * @throws UserError for a sweep that the remaining keys leave without effect */
  void bind(Keys &keys);
};

/** A copy of the parameters with the swept parameter set to @p value. */
ContactParameters with_swept(ContactParameters parameters, const double value);

/** Linearized friction: delta of steady sliding and beta. */
SlidingLaw sliding_law(const ContactParameters &parameters);

/** @throws UserError for a flat at rest and for friction laws that complex modes do not
 * support */
void check_complex_modes(const ContactParameters &parameters);
} // namespace mesoslip

#endif
