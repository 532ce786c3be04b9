#include "material/shear_impedance.h"
#include "supports_column.h"

namespace supports
{
namespace
{
/** Share of the energy of a pulse that comes back from the top of a long column, of @p n cells a wave length. */
template <int dim>
double reflected(BodySetup setup,
                 const ElasticPhase<3> &solid,
                 const std::array<double, 2> &direction,
                 const double c,
                 const double wave)
{
  const double h = setup.spacing[1], height = h * setup.cells[1], middle = 0.5 * height;
  setup.step.dt    = 0.5 * h / c_p;
  BodyIn<dim> body = make_body<dim>(setup, {solid, 1, 0.6});
  const auto pulse = [&](const double y) {
    const double x = (y - middle) / wave;
    return 1e-6 * std::exp(-x * x) * std::cos(2. * M_PI * x);
  };
  // Up it goes: u(y - c t).
  const double dt = setup.step.dt;
  body.set_u([&](double, const double y, const unsigned int k) {
    return direction[k] * pulse(y);
  });
  body.set_w([&](double, const double y, const unsigned int k) {
    return direction[k] * (pulse(y) - pulse(y + c * dt)) / dt;
  });
  body.run(std::lround(0.95 * height / c / dt));
  const EnergyHistory e = body.energy->reduce();
  EXPECT_LT(largest(e.residual()), 1e-12 * e.initial);
  EXPECT_NEAR(e.dashpots.back(), e.initial - e.kinetic.back() - e.elastic.back(),
              1e-9 * e.initial);
  return (e.kinetic.back() + e.elastic.back()) / e.initial;
}
} // namespace

// A dashpot z on waves of impedance Z sends back ((Z - z) / (Z + z))^2 of their energy, and nothing at z = Z.
TEST(Supports, DashpotsReflectByTheirImpedance)
{
  constexpr double wave = 2e-3;
  for (const double share : {0.2, 1., 3.})
    for (const unsigned int component : {0U, 1U})
      {
        const double c = component == 0 ? c_s : c_p, R = (1. - share) / (1. + share);
        const auto setup = [&](const unsigned int n, const unsigned int dim) {
          BodySetup s    = column(n * 10, 10. * wave);
          Suspension &on = s.top.suspension;
          if (component == 0)
            on.dashpot[0] = on.dashpot[dim - 2] = share * Z_s;
          else
            on.dashpot[dim - 1] = share * Z_p;
          return s;
        };
        const std::array<double, 2> direction = {
          {component == 0 ? 1. : 0., 1. * component}};
        const auto error = [&](const unsigned int n) {
          return std::fabs(
            reflected<2>(setup(n, 2), column_material<3>(), direction, c, wave) - R * R);
        };
        EXPECT_LT(error(30), share == 1. ? 1e-3 : 3e-3) << share << component;
        EXPECT_LT(error(60), 0.3 * error(30) + 1e-12) << share << component;
        EXPECT_LT(
          std::fabs(reflected<3>(setup(30, 3), column_material<3>(), direction, c, wave) -
                    R * R),
          share == 1. ? 1e-3 : 3e-3)
          << share << component;
        measured::number(brief_text(3, "energy from a dashpot of ", share, " Z, ",
                                    component == 0 ? "S" : "P"),
                         R * R, R * R + error(60));
      }
}

// In a solid whose axes are turned both waves move along and across; the impedances of the half-space absorb both.
TEST(Supports, TurnedSolidsAreAbsorbed)
{
  constexpr double wave = 2e-3;
  VoigtMatrix<2> D;
  D << 60e9, 10e9, 12e9, 10e9, 20e9, 6e9, 12e9, 6e9, 14e9;
  const auto Z = impedance<2>(D, rho);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> waves(Z);
  for (const int w : {0, 1})
    {
      const Eigen::Vector2d mode = waves.eigenvectors().col(w);
      const double c             = waves.eigenvalues()[w] / rho;
      BodySetup s                = column(300, 10. * wave);
      s.classes                  = {{D, rho}};
      s.top.suspension.absorbing = true;
      for (unsigned int k = 0; k < 4; ++k)
        s.top.nodes.impedance.emplace_back(2, Z(k / 2, k % 2));
      const double share =
        reflected<2>(s, column_material<3>(), {{mode[0], mode[1]}}, c, wave);
      EXPECT_LT(share, 1e-3) << c;
      s.top.suspension.absorbing = false;
      s.top.suspension.dashpot   = {{Z(0, 0), Z(1, 1), 0.}};
      EXPECT_GT(reflected<2>(s, column_material<3>(), {{mode[0], mode[1]}}, c, wave),
                10. * share)
        << c;
    }
}

// A body that is thrown on dashpots far beyond its impedance: they stop its top within a step, whatever they are, and the
// energy of the throw is all that there is.
TEST(Supports, StiffDashpotsAreHolds)
{
  for (const bool platen : {false, true})
    for (const double dashpot : {1e12, 1e14})
      {
        BodySetup s                = column(20);
        s.top.is_platen            = platen;
        s.top.suspension.dashpot   = {{dashpot, dashpot, 0.}};
        s.top.suspension.stiffness = {{1e9, 0., 0.}};
        s.step.dt                  = 0.5 * s.spacing[0] / c_p;
        Body body(s), held([&]() {
          BodySetup of_held = s;
          of_held.top.hold();
          of_held.top.suspension = {};
          return of_held;
        }());
        for (Body *some : {&body, &held})
          {
            some->set_initial_velocity({{0.3, -1., 0.}});
            some->run(500);
          }
        const EnergyHistory e = body.energy->reduce();
        const double thrown   = 0.5 * rho * H * s.spacing[0] * 1.09;
        EXPECT_NEAR(e.initial, thrown, 0.1 * thrown) << dashpot;
        EXPECT_LT(largest(e.residual()), 1e-24 * dashpot * thrown) << dashpot;
        EXPECT_LT(relative_difference(held.u, body.u), 1e-3) << dashpot;
      }
}
} // namespace supports
