#ifndef mesoslip_eigenvalues_complex_complex_modes_h
#define mesoslip_eigenvalues_complex_complex_modes_h

#include "base/timer.h"
#include "eigenvalues/complex/growth_region.h"
#include "eigenvalues/complex/sliding_pencil.h"

#include <functional>
#include <vector>

namespace mesoslip
{
/** What is wanted of the complex modes, and how they are computed. */
struct ComplexModesOptions
{
  double lowest_frequency  = 0.;    ///< Hz
  double highest_frequency = 200e3; ///< Hz
  double least_growth      = 0.;    ///< growth rate (1/s), not above 0
  double tolerance         = 1e-10; ///< relative, of the eigenvalues
  bool count               = true;  ///< check that no mode is missing
  bool steep = false; ///< friction feeds growth that is too fast to be counted

  /** Called before each factorization with what it is for and which share of that is done; may
   * throw to stop. */
  std::function<void(const char *activity, const double share)> before_factorization;

  Timer *timer = nullptr; ///< may be none
};

/** A vibration Re(shape exp(s t)) about steady sliding. */
struct ComplexMode
{
  SlidingPencil::Complex s = 0.; ///< growth rate and circular frequency (1/s)

  /** Of the free degrees of freedom, u^H M u is one. */
  ComplexVector shape;

  double residual = 0.; ///< SlidingPencil::residual()

  /** Of each contact node, the power of its friction over twice the mean energy: what it adds to
   * the growth rate (1/s). */
  Eigen::VectorXd growth_by_friction;

  /** Likewise of the damping, not positive (1/s). */
  double growth_by_damping = 0.;

  /** Of each contact node, |u|^2 of its motion along the flat (1/kg, in 2D m/kg). */
  Eigen::VectorXd motion_of_contact;

  /** Hz. */
  double frequency() const
  {
    return s.imag() / (2. * M_PI);
  }
};

/** All modes in the range that was asked for, and how that is known. */
struct ComplexModes
{
  std::vector<ComplexMode> modes; ///< fastest growing first

  double radius = 0.; ///< friction_radius()

  /** No mode of a higher circular frequency (1/s) grows; may be infinite. */
  double nothing_grows_above = 0.;

  double highest = 0.; ///< no mode has a higher circular frequency (1/s)

  /** Largest growth rate (1/s) of the range that is counted. */
  double fastest_counted = 0.;

  /** Eigenvalues in the range that the search did not find, by the argument principle; 0
   * if it was not asked for. */
  int n_missing = 0;

  unsigned int n_shifts         = 0;  ///< of Arnoldi iterations
  unsigned int n_factorizations = 0;  ///< all of them
  unsigned int n_solves         = 0;  ///< in the Arnoldi iterations
  double factor_bytes           = 0.; ///< of the largest factors
};

/**
 * All modes with a growth rate of at least ComplexModesOptions::least_growth and a
 * frequency from the lowest to the highest: shift-and-invert Arnoldi iterations at shifts one above
 * the other, each of which knows all eigenvalues in a disc. The discs cover growth rates up
 * to a tenth of the circular frequency, or as far as GrowthRegion allows any. Then the
 * argument principle counts all eigenvalues between these frequencies with growth rates
 * up to 0.3 of the highest circular frequency. While some are missing, faster growth and other random vectors
 * are tried, twice at most. Of modes that decay only those that vibrate faster than they
 * decay are looked for.
 * @p radius is friction_radius(pencil). @throws NotConverged
 */
ComplexModes find_complex_modes(const SlidingPencil &pencil,
                                const double radius,
                                const ComplexModesOptions &options);
} // namespace mesoslip

#endif
