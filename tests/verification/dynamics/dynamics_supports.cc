#include "supports_column.h"

namespace supports
{
// omega Z tan(omega H / c) = k - m omega^2: each node on springs with a mass, and a platen on springs.
TEST(Supports, ColumnOnSpringsHasItsFrequency)
{
  for (const unsigned int component : {0U, 1U})
    for (const double stiffness : {1e11, 1e12})
      for (const double mass : {0., 8.})
        {
          const double omega = frequency_on_springs(component, stiffness, mass);
          const auto setup   = [&](const unsigned int n, const bool platen,
                                 const unsigned int dim) {
            BodySetup s     = column(n);
            s.top.is_platen = platen;
            Suspension &on  = s.top.suspension;
            if (component == 0)
              on.stiffness[0] = on.stiffness[dim - 2] = stiffness;
            else
              on.stiffness[dim - 1] = stiffness;
            if (!platen)
              on.mass = mass;
            else
              s.top.platen_mass = mass * s.spacing[0] * (dim == 3 ? s.spacing[0] : 1.);
            return s;
          };
          const std::string what = brief_text(3, component == 0 ? "S" : "P", " on ",
                                              stiffness, " Pa/m with ", mass, " kg/m^2");
          for (const bool platen : {false, true})
            {
              const std::string top = platen ? ", platen" : "";
              expect_order_two(
                [&](const unsigned int n) {
                  return error_of<2>(setup(n, platen, 2), {component, omega});
                },
                2e-3, "column: " + what + top, stiffness == 1e12 && mass > 0.);
              expect_order_two(
                [&](const unsigned int n) {
                  return error_of<3>(setup(n, platen, 3), {component, omega});
                },
                2e-3, "box: " + what + top, false);
            }
        }
}

// As shares of the frequencies of the clamped column, 80.74 and 43.61 kHz.
TEST(Supports, FrequenciesOfTheFormulaAreThoseGiven)
{
  const auto share = [](const unsigned int component, const double k) {
    const double c = component == 0 ? c_s : c_p;
    return frequency_on_springs(component, k, 0.) / (0.5 * M_PI * c / H);
  };
  EXPECT_NEAR(share(1, 1e12), 0.3508, 5e-5);
  EXPECT_NEAR(share(0, 1e12), 0.5776, 5e-5);
  EXPECT_NEAR(share(1, 1e15), 0.9971, 5e-5);
  EXPECT_NEAR(share(0, 1e15), 0.9991, 5e-5);
}
// Far end and body move alike: nothing is stretched, nothing slides, from the first step on.
TEST(Supports, MovesWithItsFarEnd)
{
  BodySetup s    = column(8);
  Suspension &on = s.top.suspension;
  on.stiffness   = {{1e12, 1e12, 0.}};
  on.dashpot     = {{1e6, 1e6, 0.}};
  on.mass        = 3.;
  on.motion[0]   = LoadHistory(1., "3*t");
  on.motion[1]   = LoadHistory(1., "-0.5*t");
  s.step.dt      = 0.5 * s.spacing[0] / c_p;
  for (const bool platen : {false, true})
    {
      s.top.is_platen = platen;
      Body body(s);
      body.set_initial_velocity({{3., -0.5, 0.}});
      body.run(1000);
      const double t = 1000 * s.step.dt;
      for (unsigned int j = 0; j <= 8; ++j)
        {
          EXPECT_NEAR(body.u.row(0, j)[0], 3. * t, 1e-11 * 3. * t);
          EXPECT_NEAR(body.u.row(1, j)[0], -0.5 * t, 1e-11 * t);
        }
    }
}

// u = a cos(omega y / c) cos(omega t) with a (k cos(omega H / c) - Z omega sin(omega H / c)) = k X.
TEST(Supports, FarEndDrivesTheColumn)
{
  constexpr double omega = 1.1e5, k = 1e12, a = 1e-6;
  for (const unsigned int component : {0U, 1U})
    {
      const double c = component == 0 ? c_s : c_p, angle = omega * H / c,
                   X   = a * (std::cos(angle) - rho * c * omega * std::sin(angle) / k);
      const auto error = [&](const unsigned int n) {
        BodySetup s                           = column(n);
        s.top.suspension.stiffness[component] = k;
        s.top.suspension.motion[component]    = LoadHistory(
             1., std::to_string(1e6 * X) + "e-6*cos(" + std::to_string(omega) + "*t)");
        return error_of<2>(s, {component, omega, a});
      };
      expect_order_two(error, 5e-3,
                       component == 0 ? "driven column, S" : "driven column, P");
    }
}
} // namespace supports
