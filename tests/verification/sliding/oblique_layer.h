#ifndef mesoslip_tests_verification_oblique_layer_h
#define mesoslip_tests_verification_oblique_layer_h

#include "sliding_layer.h"

#include <deal.II/base/point.h>

namespace verification
{
namespace sliding_layer
{
/** Perturbations exp(i k (x cos t + y sin t) + s t) of the sliding layer: a wave in the
 * vertical plane along the direction t and one of shear across it, which meet in the
 * friction alone. */
struct ObliqueLayer : Layer
{
  double angle         = 0.; ///< t
  double flat_velocity = 0.; ///< m/s

  double along() const
  {
    return std::cos(angle);
  }
  double across() const
  {
    return std::sin(angle);
  }
  /** Friction across the motion of the flat over -u_y: along the slip of the step. */
  Complex drag(const Complex s) const
  {
    const Complex rate = scheme_dt > 0. ? (std::exp(s * scheme_dt) - 1.) / scheme_dt : s;
    return friction(s) * P / flat_velocity * rate;
  }

  /** What the two waves have at the flat: forces that are not in balance along x and y. */
  struct Bottom
  {
    std::array<Complex, 2> plane, shear;
  };

  Bottom bottom(const Complex s) const
  {
    // The wave in the plane is shape(), that across it sinh(b (H - z)) / cosh(b H).
    const Waves w    = waves(s);
    const Complex Gg = G * softening(s), size = w.A * w.a, u = w.along() / size,
                  shear    = Gg * w.shear_stress() / size,
                  pressure = -Gg * w.normal_stress() / size;
    Bottom found;
    found.plane = {
      {along() * shear + friction(s) * pressure, across() * (shear - drag(s) * u)}};
    found.shear = {{across() * Gg * w.b, -along() * (Gg * w.b + drag(s) * w.tb)}};
    return found;
  }

  Complex determinant(const Complex s) const
  {
    const Bottom f = bottom(s);
    return f.plane[0] * f.shear[1] - f.plane[1] * f.shear[0];
  }

  /** The root near @p s by Newton's method. */
  Complex root_oblique(Complex s) const
  {
    for (unsigned int n = 0; n < 60; ++n)
      {
        const double step = 1e-6 * std::abs(s);
        s -= determinant(s) * 2. * step / (determinant(s + step) - determinant(s - step));
      }
    return s;
  }

  /** The wave and its mirror image in y, which vanish together at walls. */
  Complex
  displacement(const Complex s, const dealii::Point<3> &p, const unsigned int c) const
  {
    const Complex b     = decay(s, c_T);
    const Bottom f      = bottom(s);
    const Complex shear = -f.plane[1] / f.shear[1] * std::sinh(b * (H - p[2])) /
                          std::cosh(b * H),
                  plane = shape(s, p[2], 0);
    const double phase  = k() * across() * p[1];
    const Complex wave  = std::exp(I * k() * along() * p[0]);
    return wave * (c == 0   ? (along() * plane - across() * shear) * std::cos(phase)
                   : c == 1 ? I * (across() * plane + along() * shear) * std::sin(phase)
                            : shape(s, p[2], 1) * std::cos(phase));
  }
};

/** The fastest wave at 0 degrees, followed to the angle of @p layer. */
inline Complex fastest_oblique(ObliqueLayer layer)
{
  const double angle = layer.angle;
  Complex s          = layer.fastest();
  for (unsigned int k = 0; k <= 45; ++k)
    {
      layer.angle = k / 45. * angle;
      s           = layer.root_oblique(s);
    }
  return s;
}
} // namespace sliding_layer
} // namespace verification

#endif
