#include "elasticity/row_sweep.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/**
 * Sets the constants that the kernel multiplies with (Ex, d_y, Sh) = (r e_x, d_y, r d_x +
 * e_y), r = hx / hy, to get A_x, scaled sigma_yy and sigma_xy in the units of
 * row_kernel.h; and the hourglass coefficients. Integrating the squares of the hourglass
 * strains (g_x Y/hx, g_y X/hy, g_x X/hy + g_y Y/hx), mean of X^2 = Y^2 = 1/12, gives the
 * energy
 *
 *     hx hy / 24 [   (D11/hx^2 + D33/hy^2) g_x^2 + (D22/hy^2 + D33/hx^2) g_y^2
 *                  + 2 (D13/hx^2 + D23/hy^2) g_x g_y ]
 *
 * with the stiffness about the mean, see hourglass_stiffness().
 */
template <typename Number>
void set_coefficients(const ElasticPhase<2> &phase,
                      const double hx,
                      const double hy,
                      const unsigned int c,
                      kernels::Constants<Number> &constants)
{
  using namespace kernels;
  const auto set = [&](const CoefficientIndex k, const double value) {
    constants.coefficient[k][c] = static_cast<Number>(value);
  };
  const VoigtMatrix<2> &D = phase.stiffness;
  const Eigen::Matrix2d H = hourglass_stiffness(phase, {{hx, hy}});
  set(c11, D(0, 0) * hy * hy / (2. * hx * hx * hx));
  set(c12, D(0, 1) / (2. * hx));
  set(c22, D(1, 1) * hx / (2. * hy * hy));
  set(c33, D(2, 2) / (2. * hx));
  set(c13, D(0, 2) * hy / (2. * hx * hx));
  set(c23, D(1, 2) / (2. * hy));
  set(gx, hy / 6. * H(0, 0));
  set(gy, hx / 6. * H(1, 1));
  set(gxy, hy / 6. * H(0, 1));
}

template <typename Number>
std::unique_ptr<kernels::Constants<Number>>
make_constants(const UniformMaterial &material)
{
  auto constants  = std::make_unique<kernels::Constants<Number>>();
  auto &c         = *constants;
  const double hx = material.grid().spacing[0], hy = material.grid().spacing[1];
  c.n_cells  = material.grid().cells[0];
  c.periodic = material.periodicity().x;
  c.ratio    = static_cast<Number>(hx / hy);
  c.scale_x  = static_cast<Number>(hx / 2.);
  c.scale_y  = static_cast<Number>(hy / 2.);
  for (auto &row : c.coefficient)
    std::fill(std::begin(row), std::end(row), Number(0));
  const auto &occurring = material.phases_that_occur();
  for (const unsigned int k : occurring)
    set_coefficients(material.phases()[k], hx, hy, material.is_homogeneous() ? 0 : k, c);
  return constants;
}
} // namespace

std::string kernels::name(const Choice &choice)
{
  const char *const materials[] = {"homogeneous", "two phases", "phases in a register",
                                   "phases in two registers", "any phases"};
  std::string result            = materials[static_cast<int>(choice.material)];
  result += choice.anisotropic ? ", anisotropic" : ", orthotropic";
  if (choice.damping)
    result += ", damped";
  if (choice.gravity)
    result += ", forces on the mass";
  return result;
}

template <typename Number>
RowKernels<Number>::RowKernels(const UniformMaterial &material,
                               const InstructionSet isa,
                               const bool damping,
                               const bool gravity)
  : constants(make_constants<Number>(material))
{
  if (!material.is_homogeneous())
    choice.n_phases = material.phases_that_occur().back() + 1;
  choice.anisotropic = !material.is_orthotropic();
  choice.damping     = damping;
  choice.gravity     = gravity;
  using namespace kernels;
  void (*const selections[])(Choice &, Kernels<Number> &) = MESOSLIP_VARIANTS(select);
  variant(selections, isa)(choice, functions);
}

template struct RowKernels<double>;
template struct RowKernels<float>;
} // namespace mesoslip
