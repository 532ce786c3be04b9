#ifndef mesoslip_tests_unit_material_testing_h
#define mesoslip_tests_unit_material_testing_h

#include "material/stiffness.h"

#include <cmath>

namespace material_testing
{
using namespace mesoslip;

inline const double pi  = std::acos(-1.);
inline const double GPa = 1e9;

inline VoigtMatrix<2> plane(const double xx,
                            const double xy,
                            const double yy,
                            const double ss,
                            const double xs = 0.,
                            const double ys = 0.)
{
  VoigtMatrix<2> D;
  D << xx, xy, xs, xy, yy, ys, xs, ys, ss;
  return D * GPa;
}

/** Eq. (10). */
inline const VoigtMatrix<2> paper_stiffness = plane(36.54, 9.1, 47.26, 13.785);

/** Carbon-epoxy, fibres along axis 1. */
inline const OrthotropicConstants carbon = {140 * GPa, 10 * GPa, 8 * GPa, 0.3,    0.28,
                                            0.4,       5 * GPa,  4 * GPa, 3 * GPa};

template <int n>
double largest_difference(const Eigen::Matrix<double, n, n, Eigen::RowMajor> &a,
                          const Eigen::Matrix<double, n, n, Eigen::RowMajor> &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
} // namespace material_testing

#endif
