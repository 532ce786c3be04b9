// Friction that falls with the slip rate by more or by less than shear waves carry away: whether
// growth has a limit as the cells become smaller.

#include "contact/laws/friction_expression.h"
#include "sliding/friction/rate_weakening.h"
#include "sliding_layer.h"

#include "../../measured.h"

#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

namespace weakening_column
{
using namespace verification;
using sliding_layer::Complex;
using sliding_layer::I;

constexpr double H = sliding_layer::H, rho = 1900., c = 2560., P = 5e6, V = 50., mu = 0.3;

/** A column of cells in shear, of which friction falls by @p r times rho c with the slip rate.
 * Pressure waves are twice as fast as shear waves. */
struct Column
{
  double r           = 0.;
  double delta       = 0.;   ///< s
  double beta        = 0.;   ///< s
  unsigned int n     = 20;   ///< cells over the height
  double courant     = 0.05; ///< of shear waves
  Complex s          = 0.;   ///< of the vibration at the start (1/s)
  bool is_of_surface = false;

  BodySetup setup() const
  {
    BodySetup result;
    result.cells                  = {{1, n}};
    result.spacing                = {{H / n, H / n}};
    ElasticPhase<2> material      = resin();
    material.density              = rho;
    material.stiffness            = VoigtMatrix<2>::Zero();
    material.stiffness.diagonal() = VoigtVector<2>(4., 4., 1.) * rho * c * c;
    result.classes                = {material};
    result.periodic               = true;
    result.friction               = mu;
    std::ostringstream law;
    law << std::setprecision(17) << mu << " - " << r * rho * c / P << "*(V - " << V
        << ")";
    result.contact.law.coefficient_law =
      std::make_shared<FrictionExpression>(law.str(), 2, Healing());
    result.contact.law.reference = mu;
    result.contact.law.time      = delta;
    result.contact.flat_velocity = LoadHistory(V);
    result.top.is_platen         = false;
    result.top.held              = {{true, true, false}};
    result.top.pressure          = LoadHistory(P);
    result.step.beta             = beta;
    result.step.dt               = courant * H / n / c;
    result.sweep.steps_at_once   = 1;
    return result;
  }

  /** sinh(k (H - y)) of the layer; of the wave that is bound to the contact exp(-q y / h), of
   * the cells themselves. */
  Complex shape(const double y) const
  {
    if (is_of_surface)
      {
        const double sigma = s.real() * H / n / c;
        return std::exp(-std::acosh(1. + 0.5 * sigma * sigma) * y * n / H);
      }
    const Complex k = s / (c * std::sqrt(1. + beta * s));
    return std::sinh(k * (H - y)) / std::sinh(k * H);
  }

  /** Displacements of the contact from steady sliding, a sample every @p every steps. */
  std::vector<double> samples(const unsigned int count, const unsigned int every) const
  {
    Body body(setup());
    const double seed = 1e-12, dt = body.setup.step.dt;
    const auto &D = body.setup.classes[0].stiffness;
    body.set_u([&](double, const double y, const unsigned int k) {
      const double steady = k == 0 ? mu * P / D(2, 2) * (H - y) : -P / D(1, 1) * y;
      return steady + (k == 0 ? seed * shape(y).real() : 0.);
    });
    body.set_w([&](double, const double y, const unsigned int k) {
      return k == 0 ? seed * (s * shape(y) * std::exp(-0.5 * s * dt)).real() : 0.;
    });
    std::vector<double> result;
    for (unsigned int m = 0; m < count; ++m)
      {
        body.run(every);
        result.push_back(body.u.row(0, 0)[0] - mu * P / D(2, 2) * H);
      }
    return result;
  }
};

// Below the impedance all vibrations of the column grow at (c/H) artanh r, on any cells.
TEST(RateWeakening, HasALimitBelowTheImpedance)
{
  Column column;
  column.r = 0.8;
  column.s = c / H * (std::atanh(column.r) + 0.5 * M_PI * I);
  std::vector<double> errors;
  for (const unsigned int n : {10, 20, 40})
    {
      column.n           = n;
      const double every = 0.25 * H / c;
      const auto steps =
        static_cast<unsigned int>(std::lround(every / column.setup().step.dt));
      const Complex found =
        sliding_layer::rate_of(column.samples(24, steps), steps * column.setup().step.dt);
      errors.push_back(std::abs(found - column.s) / std::abs(column.s));
      std::printf("r = 0.8, H/%u: growth %.1f (%.1f) 1/s, error %.2g of s\n", n,
                  found.real(), column.s.real(), errors.back());
    }
  EXPECT_LT(errors.back(), 2e-3);
  EXPECT_FALSE((RateWeakening{0.8, 1., 0., 0.}.is_too_steep()));
}

// Above it a wave that is bound to the contact grows at 2 c sqrt(r^2 - 1) / h on cells of height h.
TEST(RateWeakening, HasNoneAboveTheImpedance)
{
  for (const double r : {1.05, 1.2, 1.5})
    for (const unsigned int n : {20, 40, 80})
      {
        Column column;
        column.r                    = r;
        column.n                    = n;
        column.is_of_surface        = true;
        const double due            = 2. * c * std::sqrt(r * r - 1.) * n / H;
        column.s                    = due;
        const std::vector<double> u = column.samples(2, 40);
        const double found = std::log(u[1] / u[0]) / (40. * column.setup().step.dt);
        std::printf("r = %g, H/%u: growth %.4g (%.4g) 1/s\n", r, n, found, due);
        if (r == 1.2)
          measured::number("growth (1/s), r = 1.2, H/" + std::to_string(n), due, found);
        EXPECT_NEAR(found, due, 0.01 * due) << r << " " << n;
      }
}

// Regularization and damping limit what grows above the impedance; of damping a run has it, whatever
// the cells. (A run with delta begins without the memory of friction, a jump that is not small.)
TEST(RateWeakening, RegularizationAndDampingAreALimit)
{
  for (const double delta : {0., 2e-7})
    for (const double beta : {0., 1e-7})
      {
        const double s = RateWeakening{1.2, 1., delta, beta}.fastest_growth();
        if (delta == 0. && beta == 0.)
          EXPECT_TRUE(std::isinf(s));
        else
          EXPECT_NEAR(std::sqrt(1. + beta * s) * (1. + delta * s), 1.2, 1e-12);
      }
  // Of the layer it is sqrt(1 + beta s) coth(k H) = r, with k H = 23 here.
  Column column;
  column.r         = 1.2;
  column.beta      = 1e-7;
  const double due = RateWeakening{1.2, 1., 0., column.beta}.fastest_growth();
  column.s         = due;
  std::vector<double> errors;
  for (const unsigned int n : {100, 200, 400})
    {
      column.n         = n;
      column.courant   = 0.01; // damping asks for short steps
      const double dt  = column.setup().step.dt;
      const auto steps = static_cast<unsigned int>(std::lround(2. / (due * dt)));
      const std::vector<double> u = column.samples(3, steps);
      const double found          = std::log(u[2] / u[1]) / (steps * dt);
      errors.push_back(std::fabs(found / due - 1.));
      std::printf("beta %g s, H/%u: growth %.5g (%.5g) 1/s\n", column.beta, n, found,
                  due);
    }
  EXPECT_LT(errors.back(), 0.01);
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}
} // namespace weakening_column
