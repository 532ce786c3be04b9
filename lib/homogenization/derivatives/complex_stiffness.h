#ifndef mesoslip_homogenization_derivatives_complex_stiffness_h
#define mesoslip_homogenization_derivatives_complex_stiffness_h

#include "base/serialize_members.h"
#include "material/voigt.h"

#include <algorithm>
#include <vector>

namespace mesoslip
{
/** The effective stiffness D(z) of phases with the stiffness C (1 + z eta), and its derivative. */
template <int dim>
struct StiffnessAt
{
  VoigtMatrix<dim> value = VoigtMatrix<dim>::Zero(); ///< Pa
  VoigtMatrix<dim> slope = VoigtMatrix<dim>::Zero(); ///< dD/dz (Pa)
};

/** A complex stiffness. */
template <int dim>
struct ComplexStiffness
{
  VoigtMatrix<dim> real      = VoigtMatrix<dim>::Zero(); ///< Pa
  VoigtMatrix<dim> imaginary = VoigtMatrix<dim>::Zero(); ///< Pa

  /** Truncation error: last term of the polynomial over the largest entry, the larger of
   * both parts. */
  double error = 0.;

  /** Saves or restores all members, for boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** Step |z| of the two further solves: at most 1, and small enough that no phase changes
 * by more than half. */
inline double distance_of_loss(const double largest_loss_factor)
{
  return std::min(1., 0.5 / largest_loss_factor);
}

/** D(i) from the polynomial of degree 5 through values and slopes at 0, @p distance and
 * -@p distance. D is an analytic function of z, so real solves give the complex
 * stiffness. */
template <int dim>
ComplexStiffness<dim> complex_stiffness(const StiffnessAt<dim> &at_zero,
                                        const StiffnessAt<dim> &above,
                                        const StiffnessAt<dim> &below,
                                        const double distance)
{
  using Matrix   = VoigtMatrix<dim>;
  const double t = distance, t2 = t * t;
  // D = sum of a_k z^k, from the even and the odd part of D, and of its slopes.
  const Matrix even       = 0.5 * (above.value + below.value) - at_zero.value,
               odd        = 0.5 * (above.value - below.value) - t * at_zero.slope,
               even_slope = 0.5 * (above.slope - below.slope),
               odd_slope  = 0.5 * (above.slope + below.slope) - at_zero.slope;
  const Matrix a4         = (t * even_slope - 2. * even) / (2. * t2 * t2),
               a2         = even / t2 - t2 * a4,
               a5         = (t * odd_slope - 3. * odd) / (2. * t2 * t2 * t),
               a3         = odd / (t2 * t) - t2 * a5;
  ComplexStiffness<dim> result;
  result.real      = at_zero.value - a2 + a4;
  result.imaginary = at_zero.slope - a3 + a5;
  result.error =
    std::max(a4.cwiseAbs().maxCoeff() / result.real.cwiseAbs().maxCoeff(),
             a5.cwiseAbs().maxCoeff() / result.imaginary.cwiseAbs().maxCoeff());
  return result;
}
} // namespace mesoslip

#endif
