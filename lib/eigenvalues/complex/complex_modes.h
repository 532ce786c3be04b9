#ifndef mesoslip_eigenvalues_complex_complex_modes_h
#define mesoslip_eigenvalues_complex_complex_modes_h

#include "base/timer.h"
#include "eigenvalues/complex/growth_region.h"
#include "eigenvalues/complex/sliding_pencil.h"

#include <functional>
#include <vector>

namespace mesoslip
{
/** Options of find_complex_modes(). */
struct ComplexModesOptions
{
  double lowest_frequency  = 0.;    ///< lower end of the range (Hz)
  double highest_frequency = 200e3; ///< upper end of the range (Hz)
  double least_growth      = 0.;    ///< smallest growth rate (1/s), not above 0
  double tolerance         = 1e-10; ///< relative accuracy of the eigenvalues
  bool count               = true;  ///< whether to check that no mode is missing
  bool steep               = false; ///< friction feeds growth too fast to be counted

  /**
   * Called before each factorization with its purpose and the share of this task already
   * done; may throw to stop.
   */
  std::function<void(const char *activity, const double share)> before_factorization;

  Timer *timer = nullptr; ///< may be null
};

/** A vibration Re(shape exp(s t)) about steady sliding. */
struct ComplexMode
{
  SlidingPencil::Complex s = 0.; ///< growth rate and circular frequency (1/s)

  /** Free degrees of freedom, normalized to u^H M u = 1. */
  ComplexVector shape;

  double residual = 0.; ///< SlidingPencil::residual()

  /**
   * Contribution of the friction of each contact node to the growth rate (1/s): power
   * over twice the mean energy.
   */
  Eigen::VectorXd growth_by_friction;

  /** Contribution of the damping to the growth rate (1/s), not positive. */
  double growth_by_damping = 0.;

  /** |u|^2 of the tangential motion of each contact node (1/kg, in 2D m/kg). */
  Eigen::VectorXd motion_of_contact;

  /** Frequency (Hz). */
  double frequency() const
  {
    return s.imag() / (2. * M_PI);
  }
};

/** All modes in the requested range, and the check of completeness. */
struct ComplexModes
{
  std::vector<ComplexMode> modes; ///< fastest growing first

  double radius = 0.; ///< friction_radius()

  /** No mode with a higher circular frequency (1/s) grows; may be infinite. */
  double nothing_grows_above = 0.;

  double highest = 0.; ///< no mode has a higher circular frequency (1/s)

  /** Largest growth rate (1/s) of the counted range. */
  double fastest_counted = 0.;

  /**
   * Number of eigenvalues in the range that the search did not find, by the argument
   * principle; 0 if not counted.
   */
  int n_missing = 0;

  unsigned int n_shifts         = 0;  ///< shifts of Arnoldi iterations
  unsigned int n_factorizations = 0;  ///< all factorizations
  unsigned int n_solves         = 0;  ///< solves in Arnoldi iterations
  double factor_bytes           = 0.; ///< memory of the largest factors (bytes)
};

/**
 * All modes with a growth rate of at least ComplexModesOptions::least_growth and a
 * frequency from the lowest to the highest. Shift-and-invert Arnoldi iterations at
 * successive shifts each find all eigenvalues in a disc. The discs cover growth rates up
 * to a tenth of the circular frequency, or as far as GrowthRegion allows any. Then the
 * argument principle counts all eigenvalues between these frequencies with growth rates
 * up to 0.3 of the highest circular frequency. While some are missing, the search is
 * repeated with faster growth and other random vectors, twice at most. Decaying modes are
 * searched only if they vibrate faster than they decay. @p radius is
 * friction_radius(pencil). @throws NotConverged
 */
ComplexModes find_complex_modes(const SlidingPencil &pencil,
                                const double radius,
                                const ComplexModesOptions &options);
} // namespace mesoslip

#endif
