#ifndef mesoslip_tests_verification_rectangle_mode_h
#define mesoslip_tests_verification_rectangle_mode_h

#include "../sliding/sliding_body.h"

#include <Eigen/Eigenvalues>

namespace verification
{
namespace exact_modes
{
/** Size of the rectangle (m). */
constexpr double L = 0.024, H = 0.016;

/** Wave numbers of mode (m, n) of a rectangle between frictionless, rigid sides. */
struct Mode
{
  unsigned int m, n;
  bool shear;

  double kx() const
  {
    return m * M_PI / L;
  }
  double ky() const
  {
    return (2 * n + 1) * M_PI / (2. * H);
  }

  /** Circular frequency (1/s). */
  double omega(const ElasticPhase<2> &material) const
  {
    const double modulus = shear ? material.stiffness(2, 2) : material.stiffness(0, 0);
    return std::sqrt(modulus / material.density) * std::hypot(kx(), ky());
  }

  double operator()(const double x, const double y, const unsigned int c) const
  {
    const double X = shear ? ky() : kx(), Y = shear ? -kx() : ky();
    const double size = std::hypot(kx(), ky());
    return c == 0 ? X / size * std::sin(kx() * x) * std::cos(ky() * y)
                  : Y / size * std::cos(kx() * x) * std::sin(ky() * y);
  }
};

/** Sides and top u_x = 0, nothing else on top; the bottom is the caller's. */
inline BodySetup rectangle(const unsigned int n_vertical)
{
  BodySetup s;
  s.cells            = {{3 * n_vertical / 2, n_vertical}};
  s.spacing          = {{L / s.cells[0], H / s.cells[1]}};
  s.classes          = {resin()};
  s.sides.left_held  = {{true, false}};
  s.sides.right_held = {{true, false}};
  s.top.is_platen    = false;
  s.top.held         = {{true, true, false}};
  return s;
}

/**
 * Circular frequency and decay rate (1/s) of samples q from the last of q_(n+1) = z1 q_n -
 * z2 q_(n-1), z2 = |z|^2, by least squares.
 */
inline std::array<double, 2> frequency_and_decay(const std::vector<double> &q,
                                                 const double interval)
{
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d r = Eigen::Vector2d::Zero();
  for (std::size_t n = 1; n + 1 < q.size(); ++n)
    {
      const Eigen::Vector2d row(q[n], q[n - 1]);
      A += row * row.transpose();
      r += row * q[n + 1];
    }
  const Eigen::Vector2d z = A.inverse() * r;
  return {{std::acos(0.5 * z(0) / std::sqrt(-z(1))) / interval,
           -0.5 * std::log(-z(1)) / interval}};
}

/**
 * The discrete mode: on a uniform grid it is spanned by the two shapes of the same wave
 * numbers, so that a 2x2 eigenproblem gives it exactly.
 */
struct DiscreteMode
{
  double omega;
  NodalField<double> shape;
};

inline DiscreteMode discrete_mode(const BodySetup &setup, const Mode &mode)
{
  const UniformMaterial material = setup.material();
  const NodeRows rows            = NodeRows::all(material.n_rows());
  const UniformGridOperator op(material);
  std::array<NodalField<double>, 2> basis, image;
  for (unsigned int k = 0; k < 2; ++k)
    {
      basis[k] = image[k] = NodalField<double>(material.n_columns(), material.n_rows());
      const Mode shape{mode.m, mode.n, k == 1};
      Body::set(basis[k], material, rows, shape);
      op.vmult(image[k], basis[k]);
    }
  Eigen::Matrix2d K, M;
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int l = 0; l < 2; ++l)
      {
        M(k, l) = mass_product(material, basis[k], basis[l]);
        K(k, l) = std::inner_product(basis[k].begin(), basis[k].begin() + basis[k].size(),
                                     image[l].begin(), 0.);
      }
  if (mode.m == 0) // there is no second shape
    M(1, 1) = 1.;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(K, M);
  const unsigned int which = mode.shear ? 0 : 1; // shear waves are the slower ones
  DiscreteMode result{std::sqrt(solver.eigenvalues()(which)), basis[0]};
  const Eigen::Vector2d v = solver.eigenvectors().col(which);
  for (std::size_t k = 0; k < result.shape.size(); ++k)
    result.shape.begin()[k] = v(0) * basis[0].begin()[k] + v(1) * basis[1].begin()[k];
  return result;
}
} // namespace exact_modes
} // namespace verification

#endif
