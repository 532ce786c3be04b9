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

  /** Hz; NaN: that of a longitudinal wave as long as the body is high. */
  double highest_frequency = std::numeric_limits<double>::quiet_NaN();

  double least_growth   = 0.;              ///< 1/s, not positive
  double tolerance      = 1e-10;           ///< relative, of the eigenvalues
  bool count            = true;            ///< whether the search is checked
  unsigned int n_shapes = 20;              ///< that are written at most
  ModeSweep sweep       = ModeSweep::none; ///< what changes
  std::vector<double> values;              ///< of it, in its unit

  /** Binds the keys. @throws UserError for a sweep that the others leave without effect */
  void bind(Keys &keys);
};

/** The parameters with @p value for what their sweep changes. */
ContactParameters with_swept(ContactParameters parameters, const double value);

/** delta of steady sliding and beta. */
SlidingLaw sliding_law(const ContactParameters &parameters);

/** @throws UserError for a flat at rest and for friction laws that are not known here */
void check_complex_modes(const ContactParameters &parameters);
} // namespace mesoslip

#endif
