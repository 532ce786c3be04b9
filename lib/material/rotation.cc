#include "material/rotation.h"

#include "material/mandel.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** Turns stresses and strains in Mandel's notation; orthogonal. */
VoigtMatrix<2> mandel_rotation(const double angle)
{
  const double c  = std::cos(angle);
  const double s  = std::sin(angle);
  const double cs = std::sqrt(2.) * c * s;
  VoigtMatrix<2> Q;
  Q << c * c, s * s, -cs, //
    s * s, c * c, cs,     //
    cs, -cs, c * c - s * s;
  return Q;
}
} // namespace

VoigtMatrix<2> rotate_stiffness(const VoigtMatrix<2> &stiffness, const double angle)
{
  const VoigtMatrix<2> Q = mandel_rotation(angle);
  return stiffness_from_mandel<2>(Q * stiffness_to_mandel<2>(stiffness) * Q.transpose());
}

} // namespace mesoslip
