// Contact homogenization: eqs (13) and (17) to (21) on synthetic results, and what is
// said about results that do not fit.

#include "sliding/analyses/friction_homogenization.h"
#include "../io/io_testing.h"
#include "base/files.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "material/stiffness.h"
#include "sliding/analyses/phases_of_contact.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
constexpr double T_heterogeneous = 17e-6, T_homogeneous = 15e-6;

/** Table 4: 10 % of fibres, here 20 % of the contact line. */
class FrictionHomogenization : public testing::Test
{
protected:
  FrictionHomogenization()
  {
    body.grid       = {{{10, 4}}, {{1e-4, 1e-4}}};
    body.phases     = {{"matrix", isotropic_stiffness<2>(30e9, 0.2), 1770., 0.12},
                       {"fibre", isotropic_stiffness<2>(240e9, 0.2), 1770., 0.3}};
    body.rve_digest = "abc";
    body.phase_id.assign(40, 0);
    for (const std::size_t k : {2, 7, 12, 17}) // in rows 0 and 1
      body.phase_id[k] = 1;
    // Node rule "mean"; fibres in the cells 2 and 7.
    body.node_friction.assign(11, 0.12);
    for (const std::size_t k : {2, 3, 7, 8})
      body.node_friction[k] = 0.21;
    for (const std::string name : {"het", "hom", "sca"})
      std::filesystem::create_directory(folder / name);
    parameters.heterogeneous_run = folder / "het";
    parameters.homogeneous_run   = folder / "hom";
    parameters.static_contact    = folder / "sca";

    heterogeneous                        = {{"analysis", "transient"},
                                            {"global_interface_friction_coefficient", 0.157},
                                            {"mean_contact_duration", T_heterogeneous},
                                            {"mean_contact_duration_warning", nullptr}};
    homogeneous                          = heterogeneous;
    homogeneous["mean_contact_duration"] = T_homogeneous;
    under_het                            = {{"coefficient_from", "phases"},
                                            {"pressure", 5e5},
                                            {"velocity", 2.},
                                            {"regularization_time", 1.5e-6}};
    under_hom                            = under_het;
    under_hom["coefficient_from"]        = "constant";
    under_hom["friction_coefficient"]    = 0.2;
    static_contact                       = {{"analysis", "static contact"},
                                            {"rve_digest", "abc"},
                                            {"phase_contact_pressures", {{"matrix", 0.33e6}, {"fibre", 2e6}}}};
    at_rest                              = under_het;
    at_rest["analysis"]                  = "static contact";
    at_rest["velocity"]                  = 1e-3;
    phases.names                         = {"matrix", "fibre"};
    phases.youngs_modulus                = {30e9, 240e9};
    phases.volume_fraction               = {0.9, 0.1};
    phases.friction                      = {0.12, 0.3};
    phases.share = {std::vector<double>(11, 1.), std::vector<double>(11, 0.)};
    for (const std::size_t k : {2, 3, 7, 8})
      phases.share[0][k] = phases.share[1][k] = 0.5;
    write_static_contact();
  }

  void write_dynamics(const std::string &run, const RunConditions &conditions) const
  {
    Hdf5File file = create_grid_file(folder / run + "/dynamics.h5", body);
    std::vector<double> area(11, 1e-4);
    area.front() = area.back() = 0.5e-4;
    write_run_conditions(file, conditions);
    write_series(
      file, "/contact",
      {{"friction_coefficient", "-", &body.node_friction}, {"area", "m", &area}});
    if (run == "het" || both_heterogeneous)
      write_phases_of_contact(file, phases);
    file.close();
  }

  void write_static_contact() const
  {
    std::vector<double> pressure(11, 1e5);
    pressure[2]   = 3e5;
    Hdf5File file = create_grid_file(folder / "sca/dynamics.h5", body);
    write_run_conditions(file, at_rest);
    write_series(file, "/static_contact", {{"pressure", "Pa", &pressure}});
    file.close();
  }

  FrictionHomogenizationInput read() const
  {
    write_file(folder / "het/summary.json", heterogeneous.dump());
    write_file(folder / "hom/summary.json", homogeneous.dump());
    write_file(folder / "sca/summary.json", static_contact.dump());
    write_dynamics("het", under_het);
    write_dynamics("hom", under_hom);
    return read_friction_homogenization(parameters);
  }

  std::string reading_error() const
  {
    return user_error([this]() { read(); });
  }

  TemporaryFolder folder;
  BodyDescription body;
  PhasesOfContact phases;
  bool both_heterogeneous = false;
  nlohmann::json heterogeneous, homogeneous, static_contact;
  RunConditions under_het, under_hom, at_rest;
  FrictionHomogenizationParameters parameters;
};

const FrictionEstimate &find(const std::vector<FrictionEstimate> &all,
                             const std::string &pressures,
                             const std::string &duration)
{
  for (const FrictionEstimate &e : all)
    if (e.pressures == pressures && e.duration == duration)
      return e;
  throw std::runtime_error("no estimate by " + pressures + ", " + duration);
}
} // namespace

TEST_F(FrictionHomogenization, CoefficientsOfTable4)
{
  const auto estimates = friction_estimates(read());
  EXPECT_EQ(estimates.size(), 10u);
  // (0.1 x 0.3 x 240 + 0.9 x 0.12 x 30) / (0.1 x 240 + 0.9 x 30)
  EXPECT_NEAR(find(estimates, "volume fractions", "homogeneous").mu_homo, 10.44 / 51.,
              1e-12);
  EXPECT_NEAR(find(estimates, "surface fractions", "homogeneous").mu_homo, 17.28 / 72.,
              1e-12);
  // (0.2 x 0.3 x 2 + 0.8 x 0.12 x 0.33) / (0.2 x 2 + 0.8 x 0.33)
  EXPECT_NEAR(find(estimates, "static contact", "heterogeneous").mu_homo, 0.15168 / 0.664,
              1e-12);
}

// Nodes at the edges of a fibre one cell wide carry its pressure with half its friction.
TEST_F(FrictionHomogenization, CoefficientOfTheNodes)
{
  const auto input = read();
  // Moduli 30 (matrix) and 135 GPa (edge): 5 nodes of 30, two ends of 15, four of 135.
  EXPECT_NEAR(input.mu_of_nodes, (180. * 0.12 + 540. * 0.21) / 720., 1e-14);
  EXPECT_NEAR(*input.static_mu_of_nodes, (6. * 0.12 + 6. * 0.21) / 12., 1e-14);
  const std::string warning = node_warning(input);
  expect_contains(warning, "nodes in static contact");

  FrictionHomogenizationInput equal = input;
  equal.static_mu_of_nodes =
    homogenized_friction_coefficient(input.surface, input.static_pressures);
  EXPECT_EQ(node_warning(equal), "");
}

TEST_F(FrictionHomogenization, DeltaInvertsEquation13)
{
  const auto estimates = friction_estimates(read());
  for (const FrictionEstimate &e : estimates)
    {
      if (e.mu_homo < 0.157)
        {
          EXPECT_FALSE(e.delta);
          continue;
        }
      EXPECT_EQ(e.contact_duration,
                e.duration == "homogeneous" ? T_homogeneous : T_heterogeneous);
      ASSERT_TRUE(e.delta);
      EXPECT_NEAR(mean_friction_coefficient(e.mu_homo, *e.delta, e.contact_duration),
                  0.157, 1e-12);
    }
}

// If eq. (13) is off by one factor in both runs, calibration finds the right delta.
TEST_F(FrictionHomogenization, CalibrationRemovesACommonFactor)
{
  const double mu = 10.44 / 51., delta = 2.5e-6, factor = 0.93;
  under_hom["friction_coefficient"] = mu;
  homogeneous["global_interface_friction_coefficient"] =
    factor * mean_friction_coefficient(mu, 1.5e-6, T_homogeneous);
  heterogeneous["global_interface_friction_coefficient"] =
    factor * mean_friction_coefficient(mu, delta, T_homogeneous);
  const auto input     = read();
  const auto estimates = friction_estimates(input);
  const auto &e        = find(estimates, "volume fractions", "homogeneous");
  ASSERT_TRUE(e.calibrated);
  EXPECT_NEAR(*e.calibrated, delta, 1e-14);
  EXPECT_GT(*e.delta, 1.2 * delta);
  EXPECT_FALSE(find(estimates, "volume fractions", "heterogeneous").calibrated);

  parameters.pressures = "volume fractions";
  parameters.calibrate = true;
  EXPECT_EQ(&chosen_estimate(estimates, parameters, input), &e);
}

TEST_F(FrictionHomogenization, ChoosesStaticContactIfThereIsOne)
{
  auto input     = read();
  auto estimates = friction_estimates(input);
  const auto &e  = chosen_estimate(estimates, parameters, input);
  EXPECT_EQ(e.pressures, "static contact");
  EXPECT_EQ(e.duration, "homogeneous");

  parameters.static_contact.clear();
  parameters.homogeneous_run.clear();
  input            = read();
  estimates        = friction_estimates(input);
  const auto &none = chosen_estimate(estimates, parameters, input);
  EXPECT_EQ(none.pressures, "surface fractions");
  EXPECT_EQ(none.duration, "heterogeneous");

  parameters.pressures = "static contact";
  expect_error("Static contact is empty",
               [&] { chosen_estimate(estimates, parameters, input); });
}

TEST_F(FrictionHomogenization, OneCoefficientForAllPhases)
{
  under_het["coefficient_from"] = "constant";
  phases.friction.clear();
  under_het["friction_coefficient"] = 0.25;
  write_file(folder / "het/summary.json", heterogeneous.dump());
  write_dynamics("het", under_het);
  parameters.homogeneous_run.clear();
  parameters.static_contact.clear();
  const auto input = read_friction_homogenization(parameters);
  for (const FrictionEstimate &e : friction_estimates(input))
    {
      if (e.pressures != "nodes") // whose coefficients stand in the file
        {
          EXPECT_NEAR(e.mu_homo, 0.25, 1e-14);
        }
    }
}

TEST_F(FrictionHomogenization, WhatIsMissingIsNamed)
{
  heterogeneous["global_interface_friction_coefficient"] = nullptr;
  expect_contains(reading_error(), "global_interface_friction_coefficient");
  heterogeneous["global_interface_friction_warning"] = "mu_inter is left out: no load";
  expect_contains(reading_error(), "mu_inter is left out: no load");
  heterogeneous["global_interface_friction_coefficient"] = 0.157;

  heterogeneous["analysis"] = "modal";
  expect_contains(reading_error(), "'transient' is needed");
  heterogeneous["analysis"] = "transient";

  under_hom["pressure"] = 4e5;
  expect_contains(reading_error(), "(pressure is 400000 Pa and 500000 Pa)");
  under_hom["pressure"] = 5e5;

  static_contact["rve_digest"] = "other";
  expect_contains(reading_error(), "another RVE file");
  static_contact["rve_digest"]                       = "abc";
  static_contact["phase_contact_pressures"]["fibre"] = nullptr;
  expect_contains(reading_error(), "no contact pressure of the phase fibre");
  static_contact["phase_contact_pressures"]["fibre"] = 2e6;

  parameters.heterogeneous_run = folder / "hom";
  parameters.homogeneous_run.clear();
  expect_contains(reading_error(), "has no /contact/phases, as its body is homogeneous");
  parameters.heterogeneous_run = folder / "het";

  parameters.homogeneous_run = folder / "nowhere";
  expect_contains(reading_error(),
                  "Friction homogenization/Homogeneous run: there is no folder");
  parameters.homogeneous_run.clear();
  parameters.heterogeneous_run.clear();
  expect_contains(reading_error(), "Heterogeneous run is empty");
}

TEST_F(FrictionHomogenization, AStaticContactUnderOtherLoadsIsTold)
{
  EXPECT_TRUE(read().warnings.empty());
  at_rest["velocity"] = -1e-3;
  at_rest["pressure"] = 6e5;
  write_static_contact();
  const auto warnings = read().warnings;
  ASSERT_EQ(warnings.size(), 1u);
  expect_contains(warnings[0], "pressure is 600000 Pa and 500000 Pa");
  expect_contains(warnings[0], "velocity is -0.001 m/s and 2 m/s");
}

TEST_F(FrictionHomogenization, TheHomogeneousRunHasToBeThat)
{
  both_heterogeneous = true;
  expect_contains(reading_error(), "is heterogeneous; name a run of a homogeneous one");
}

TEST_F(FrictionHomogenization, WarnsWhenContactDurationsRestOnFewNodes)
{
  const auto warning = [this]() {
    const auto input     = read();
    const auto estimates = friction_estimates(input);
    return duration_warning(input, chosen_estimate(estimates, parameters, input));
  };
  heterogeneous["mean_contact_duration_warning"] = "T_G rests on 9 %";
  EXPECT_EQ(warning(), "") << "T_G of the homogeneous run is the one that is used";
  homogeneous["mean_contact_duration_warning"] = "T_G rests on 3 %";
  expect_contains(warning(), "the proposed delta is poor");
  expect_contains(warning(), "T_G rests on 3 %");
  homogeneous["mean_contact_duration_warning"] = nullptr;
  EXPECT_EQ(warning(), "");
}

TEST_F(FrictionHomogenization, WithoutLandingsOrBelowTheLimit)
{
  heterogeneous["mean_contact_duration"] = nullptr;
  EXPECT_EQ(friction_estimates(read()).size(), 5u)
    << "T_G of the homogeneous run is left";
  homogeneous["mean_contact_duration"] = nullptr;
  expect_error("T_G", [this]() { friction_estimates(read()); });

  homogeneous["mean_contact_duration"]                   = T_homogeneous;
  heterogeneous["global_interface_friction_coefficient"] = 0.23;
  const auto input                                       = read();
  const auto estimates                                   = friction_estimates(input);
  EXPECT_FALSE(find(estimates, "static contact", "homogeneous").delta);
  expect_error("is not below mu_homo",
               [&] { chosen_estimate(estimates, parameters, input); });
}
