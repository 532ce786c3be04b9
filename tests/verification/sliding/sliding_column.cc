#include "../../measured.h"
#include "box_body.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
constexpr double H = 0.016, rho = 1900., c = 2560., P = 5e6, mu = 0.25;
constexpr double round_trip = 2. * H / c, brake = mu * P / (rho * c);

/** Thrown with 6.6 times the velocity that friction can take away in one wave. */
constexpr double v           = 6.6 * brake;
constexpr unsigned int trips = 3;
constexpr double slip        = trips * round_trip * (v - trips * brake);

/** Both wave speeds along the column are c. */
template <int dim>
ElasticPhase<dim> column_material()
{
  return {rho * c * c * VoigtMatrix<dim>::Identity(), rho};
}

/** One column of cells. */
BodySetup column(const unsigned int n, const double courant)
{
  BodySetup s;
  s.cells            = {{1, n}};
  s.spacing          = {{H / n, H / n}};
  s.classes          = {column_material<2>()};
  s.periodic         = true;
  s.friction         = mu;
  s.contact.law.time = 0.;
  s.top.is_platen    = false;
  s.top.pressure     = LoadHistory(P);
  s.step.dt          = courant * H / n / c;
  s.energy_interval  = 1;
  return s;
}

struct Stop
{
  double slip;     ///< of the contact, at the end (m)
  double friction; ///< work of friction (J/m^2)
  double energy;   ///< of the swinging column at the end (J/m^2)
  bool in_steps;   ///< slips during the first three round trips, sticks during the fourth
};

/** Five and a half round trips of the column, statically compressed from the start; as a box it
 * is thrown at an angle to the axes. */
template <int dim>
Stop thrown(const BodySetup &setup)
{
  BodyIn<dim> body   = make_body<dim>(setup, {column_material<3>(), 1, 0.6});
  const double width = setup.spacing[0] * body.depth, strain = P / (rho * c * c);
  body.set_u([&](double, const double y, const unsigned int k) {
    return k == 1 ? -strain * y : 0.;
  });
  body.set_w([](double, double, const unsigned int k) { return k == 0 ? v : 0.; });
  body.run(std::lround(5.5 * round_trip / setup.step.dt));
  const EnergyHistory e   = body.energy->reduce();
  const ContactHistory &h = body.contact_recorder.history();
  EXPECT_LT(largest(e.residual()), 1e-12 * e.initial);
  bool in_steps = true;
  for (std::size_t k = 0; k < h.time.size(); ++k)
    {
      const double trip = h.time[k] / round_trip, share = trip - std::floor(trip);
      if (trip < trips + 1. && share > 0.1 && share < 0.9)
        in_steps = in_steps && (h.slipping[k] > 0.) == (trip < trips);
    }
  const double energy = (e.kinetic.back() + e.elastic.back()) / width;
  return {body.at(body.u, 0, 0, 0), e.friction.back() / width,
          energy - 0.5 * P * strain * H, in_steps};
}

// The flat at rest takes `brake` from what arrives at it while more arrives, and the free
// top doubles that: the contact slides with v - brake, v - 3 brake, ... for a round trip
// each. When less than `brake` is left it sticks for good, and the column swings with it.
template <int dim>
void expect_stop(const std::string &what)
{
  constexpr double left = v - 2. * trips * brake;
  std::vector<double> errors;
  for (const unsigned int n : {50, 100, 200, 400})
    {
      const Stop stop = thrown<dim>(column(n, 0.9));
      EXPECT_TRUE(stop.in_steps) << n;
      EXPECT_NEAR(stop.friction, mu * P * slip, 1e-4 * mu * P * slip);
      EXPECT_NEAR(stop.energy, 0.5 * rho * H * left * left, 0.012 * stop.energy);
      errors.push_back(stop.slip / slip - 1.);
      measured::error("slip of a braked column" + what, n, std::abs(errors.back()));
      if (n == 400)
        {
          measured::number("slip (micrometres), n = 400" + what, 1e6 * slip,
                           1e6 * stop.slip);
          measured::number("work of friction (J/m^2)" + what, mu * P * slip,
                           stop.friction);
        }
    }
  EXPECT_LT(std::abs(errors.back()), 5e-4);
  for (const double order : orders(errors))
    EXPECT_NEAR(order, 1., 0.12);
}
} // namespace

TEST(Column, BrakesInStepsAndSticks)
{
  expect_stop<2>("");
}

TEST(BoxColumn, BrakesInStepsAndSticks)
{
  expect_stop<3>(", box");
}
