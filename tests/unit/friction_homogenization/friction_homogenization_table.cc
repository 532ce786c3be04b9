// Tables of friction, and laws in the parameters.

#include "../io/io_testing.h"
#include "base/errors.h"
#include "parameters/keys.h"
#include "sliding/friction/friction_parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace mesoslip;

namespace
{
FrictionTable::Points table_of(const std::string &rows)
{
  const mesoslip_tests::TemporaryFolder folder;
  const std::string path = folder / "friction_table.csv";
  std::ofstream(path) << rows;
  return read_friction_table(path);
}

/** What the law of these lines of section Friction makes of the coefficient in statics. */
double static_coefficient(const std::string &lines, const double speed)
{
  Keys keys(RawParameters::parse("subsection Friction\n" + lines + "end\n", "test.prm"));
  FrictionParameters friction;
  FrictionLaw law;
  const auto bind = [&](FrictionParameters &p) {
    const auto section = keys.section("Friction");
    p.bind(keys, law);
  };
  FrictionParameters defaults;
  bind(defaults);
  keys.apply();
  bind(friction);
  FrictionParameters::Use use;
  use.speed   = speed;
  use.in_time = false;
  friction.make_coefficient_law(keys, use, law);
  return friction.coefficient;
}
} // namespace

TEST(FrictionTableFile, RowsInAnyOrder)
{
  const FrictionTable::Points points =
    table_of("pressure [Pa],slip rate [m/s],coefficient [-]\n2e6,1,0.2\n1e6,0,0.4\n"
             "1e6,1,0.3\n2e6,0,0.35\n");
  EXPECT_EQ(points.slip_rate, (std::vector<double>{0., 1.}));
  EXPECT_EQ(points.pressure, (std::vector<double>{1e6, 2e6}));
  EXPECT_EQ(points.coefficient, (std::vector<double>{0.4, 0.35, 0.3, 0.2}));
  EXPECT_EQ(table_of("slip rate [m/s],coefficient [-]\n0,0.4\n1,0.3\n").pressure.size(),
            1U);
}

TEST(FrictionTableFile, RefusesAnotherUnitOfThePressure)
{
  for (const std::string heading : {"pressure [MPa]", "Pressure [Pa]", "pressure"})
    mesoslip_tests::expect_error(
      "the column '" + heading + "' has to be called 'pressure [Pa]'",
      [&]() { table_of("slip rate [m/s]," + heading + ",coefficient [-]\n0,1,0.4\n"); });
}

TEST(FrictionTableFile, RefusesWhatIsNoTable)
{
  const std::string heading = "slip rate [m/s],pressure [Pa],coefficient [-]\n";
  for (const std::string &rows :
       {heading, heading + "0,1e6,nan\n", heading + "0,1e6,-0.1\n",
        heading + "-1,1e6,0.1\n", heading + "0,1e6,0.1\n0,1e6,0.2\n",
        heading + "0,1e6,0.1\n1,2e6,0.2\n", heading + "0,1e6,0.1\n1,1e6\n",
        heading + "0,1e6,inf\n", std::string("slip rate [m/s]\n0\n")})
    EXPECT_THROW(table_of(rows), UserError) << rows;
}

TEST(FrictionParameters, StaticsTakeTheSteadyCoefficient)
{
  const std::string weakening =
    "set Coefficient law = linear slip weakening\nset Coefficient = 0.6\n"
    "set Kinetic coefficient = 0.4\n";
  EXPECT_EQ(static_coefficient(weakening, 0.), 0.6);
  EXPECT_EQ(static_coefficient(weakening, 1.), 0.4);
  const std::string curve =
    "set Coefficient law = static and kinetic\nset Coefficient = "
    "0.6\nset Kinetic coefficient = 0.4\nset Critical velocity = 2\n";
  EXPECT_EQ(static_coefficient(curve, 0.), 0.6);
  EXPECT_NEAR(static_coefficient(curve, 1.), 0.4 + 0.2 * std::exp(-0.5), 1e-15);
  const std::string state =
    "set Coefficient law = rate and state\nset Coefficient = 0.6\nsubsection Rate and "
    "state\nset Direct effect = 0.02\nset Evolution effect = 0.03\nset Velocity = "
    "1e-3\nend\n";
  EXPECT_NEAR(static_coefficient(state, 1.), 0.6 - 0.01 * std::log(1e3), 1e-12);
  EXPECT_THROW(static_coefficient(state, 0.), UserError);
  EXPECT_THROW(static_coefficient("set Coefficient law = expression\nset Coefficient "
                                  "expression = 0.3 + p/1e9\n",
                                  1.),
               UserError);
}
