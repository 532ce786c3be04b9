#ifndef verification_dynamics_supports_column_h
#define verification_dynamics_supports_column_h

#include "../../measured.h"
#include "../sliding/box_body.h"
#include "material/plausibility.h"

#include <gtest/gtest.h>

/** Columns whose tops stand on springs and dashpots. */
namespace supports
{
using namespace verification;

constexpr double H = 0.016, rho = 1770., D22 = 47.26e9, D33 = 13.785e9;
inline const double c_p = std::sqrt(D22 / rho), c_s = std::sqrt(D33 / rho);
inline const double Z_p = rho * c_p, Z_s = rho * c_s;

/** Waves along the normal have the speeds c_p and c_s, and do not mix. */
template <int dim>
ElasticPhase<dim> column_material()
{
  VoigtMatrix<dim> D = rho * c_s * c_s * VoigtMatrix<dim>::Identity();
  for (unsigned int k = 0; k < dim; ++k)
    D(k, k) = rho * c_p * c_p;
  return {D, rho};
}

/** One column of cells of height @p height, free of the flat. */
inline BodySetup column(const unsigned int n, const double height = H)
{
  BodySetup s;
  s.cells           = {{1, n}};
  s.spacing         = {{height / n, height / n}};
  s.classes         = {column_material<2>()};
  s.periodic        = true;
  s.contact.gap     = 1.;
  s.top.is_platen   = false;
  s.top.pressure    = LoadHistory(0.);
  s.energy_interval = 1;
  return s;
}

/** A column that vibrates as u = a cos(omega y / c) cos(omega t) + what its top asks for. */
struct Vibration
{
  unsigned int component; ///< 0: shear
  double omega;           ///< 1/s
  double amplitude = 1e-6;
};

/** Smallest root of Z omega tan(omega H / c) = k - m omega^2. */
inline double
frequency_on_springs(const unsigned int component, const double k, const double m)
{
  const double c = component == 0 ? c_s : c_p;
  double low = 0., high = 0.5 * M_PI * c / H * (1. - 1e-12);
  for (unsigned int n = 0; n < 200; ++n)
    {
      const double omega = 0.5 * (low + high);
      (rho * c * omega * std::tan(omega * H / c) < k - m * omega * omega ? low : high) =
        omega;
    }
  return low;
}

/** Largest error of u over its amplitude after three quarters of a period, where errors of the frequency
 * count most. */
template <int dim>
double error_of(BodySetup setup, const Vibration &vibration)
{
  const double c = vibration.component == 0 ? c_s : c_p, omega = vibration.omega,
               end          = 1.5 * M_PI / omega;
  const auto n              = setup.cells[1];
  const std::uint64_t steps = std::ceil(end * c_p / (0.6 * H / n));
  setup.step.dt             = end / steps;
  BodyIn<dim> body          = make_body<dim>(setup, {column_material<3>(), 1, 0.6});
  const auto shape          = [&](const double y, const unsigned int k) {
    return k == vibration.component ? vibration.amplitude * std::cos(omega * y / c) : 0.;
  };
  body.set_u([&](double, const double y, const unsigned int k) { return shape(y, k); });
  body.set_w([&](double, const double y, const unsigned int k) {
    return setup.step.beta2 * setup.step.dt * omega * omega * shape(y, k);
  });
  body.run(steps);
  double worst = 0.;
  for (unsigned int j = 0; j <= n; ++j)
    for (unsigned int k = 0; k < 2; ++k)
      worst = std::max(worst, std::fabs(body.at(body.u, k, 0, j)));
  const EnergyHistory e = body.energy->reduce();
  EXPECT_LT(largest(e.residual()), 1e-12 * e.initial);
  return worst / vibration.amplitude;
}

/** The error falls with order two on 10, 20 and 40 cells, to @p finest at most; it is recorded as a @p series. */
template <typename Error>
void expect_order_two(const Error &error,
                      const double finest,
                      const std::string &what,
                      const bool series = true)
{
  std::vector<double> errors;
  for (const unsigned int n : {10U, 20U, 40U})
    {
      errors.push_back(error(n));
      if (series)
        measured::error(what, n, errors.back());
    }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8) << what;
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.9) << what;
  EXPECT_LT(errors[2], finest) << what;
}
} // namespace supports

#endif
