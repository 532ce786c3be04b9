// What a checkpoint holds: bodies that are saved, forgotten and restored go on bit by bit
// as if nothing had happened.
#include "contact/laws/rate_and_state.h"
#include "sliding_body.h"

#include "base/object_exchange.h"
#include "dynamics/stability_monitor.h"
#include "observation/grid_probes.h"
#include "observation/steady_record.h"
#include "observation/steady_state.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
constexpr unsigned int recent_interval = 2;

/** A sliding body with everything that is observed. */
struct ObservedBody : Body
{
  explicit ObservedBody(const BodySetup &setup)
    : Body(setup)
    , monitor(
        stepper,
        [this]() { return boundary_work(); },
        [](const Runaway &, std::uint64_t) { throw std::runtime_error("blown up"); })
    , probes({{"", "inside", {{0.9e-3, 0.7e-3}}}, {"", "contact", {{0.5e-3, 0.}}}},
             material,
             stepper,
             &contact,
             false,
             5)
    , watch(LimitCycleCriterion(), 10, setup.energy_interval, MPI_COMM_SELF)
    , statistics(recent_interval, setup.step.dt, 16)
    , recent_contact(recent_interval, setup.monitored_nodes, setup.step)
    , recent_top(recent_interval)
  {
    contact.observe(recent_contact);
    top.observe(recent_top);
    set_w([](const double x, const double y, const unsigned int c) {
      return c == 0 ? 0.3 * std::sin(900. * x + 500. * y) : -0.2;
    });
  }

  void run_to(const std::uint64_t end)
  {
    std::vector<StepObserver *> observers = {&monitor, &probes};
    if (energy)
      observers.push_back(energy.get());
    run_time_loop(stepper, observers, end, 20, [this](std::uint64_t) {
      const ContactHistory fresh = recent_contact.take();
      statistics.add(fresh);
      statistics.add(recent_top.take());
      return watch.update(fresh, energy.get());
    });
  }

  template <class Archive>
  void serialize(Archive &archive, const unsigned int version)
  {
    SlidingGrid::serialize(archive, version);
    archive &monitor &probes &watch &statistics;
  }

  StabilityMonitor monitor;
  GridProbes probes;
  LimitCycleWatch watch;
  SteadyRecord statistics;
  ContactRecorder<2> recent_contact;
  TopRecorder recent_top;
};

BodySetup small_body()
{
  BodySetup setup;
  setup.cells   = {{9, 6}};
  setup.spacing = {{2e-4, 2.5e-4}};
  setup.classes = {resin(), resin(2500.)};
  for (unsigned int k = 0; k < 54; ++k)
    setup.ids.push_back(k % 5 == 0 ? 1 : 0);
  setup.step.beta             = 4e-9;
  setup.step.beta2            = 0.6;
  setup.friction              = 0.4;
  setup.contact.flat_velocity = LoadHistory(3.);
  setup.history_interval      = 3;
  setup.steps_per_block       = 41;
  setup.monitored_nodes       = {4};
  setup.top.pressure          = LoadHistory(4e6);
  return setup;
}

/** A platen that is held half-way, delta constant, energy in every step. */
BodySetup with_platen()
{
  BodySetup setup       = small_body();
  setup.top.is_platen   = true;
  setup.top.platen_mass = 0.01;
  setup.energy_interval = 1;
  setup.choose_time_step(0.8);
  setup.top.hold_from = 149.5 * setup.step.dt;
  return setup;
}

/** A pressure, the slip-rate law, periodic sides, energy now and then. */
BodySetup with_pressure()
{
  BodySetup setup            = small_body();
  setup.top.is_platen        = false;
  setup.contact.law.node_law = std::make_shared<SlipRateRegularization>(3e-6, 1e-3);
  setup.periodic             = true;
  setup.energy_interval      = 7;
  setup.choose_time_step(0.9);
  return setup;
}

/** The same with rate-and-state friction and a memory of the normal stress. */
BodySetup with_states()
{
  BodySetup setup                   = with_pressure();
  setup.contact.law.normal_stress   = {1e-7, 0., 0.};
  setup.contact.law.reference       = setup.friction;
  setup.contact.law.coefficient_law = std::make_shared<RateAndState>(
    RateAndState::Constants{setup.friction, 0.01, 0.02, 1e-6, 1e-3, 1e-3, true});
  return setup;
}
} // namespace

TEST(Restart, ContinuesBitByBit)
{
  constexpr std::uint64_t end = 400;
  for (const BodySetup &setup : {with_platen(), with_pressure(), with_states()})
    {
      ObservedBody whole(setup);
      whole.run_to(end);
      whole.node_statistics.finish(whole.contact);
      const ContactHistory &h = whole.contact_recorder.history();
      for (const auto *values :
           {&h.sticking, &h.slipping, &h.separated, &h.impact_energy})
        EXPECT_TRUE(!setup.periodic || largest(*values) > 0.) << "not all states";
      // Before and after the platen is held; around samples; the first and the last step.
      for (const std::uint64_t n : {1, 83, 84, 85, 148, 150, 151, 207, 399})
        {
          SCOPED_TRACE(n);
          std::string state;
          {
            ObservedBody first(setup);
            first.run_to(n);
            state = save_state(first);
          }
          BodySetup other       = setup;
          other.steps_per_block = 17; // a continued run keeps what it began with
          ObservedBody second(other);
          load_state(state, second, "test");
          EXPECT_EQ(second.stepper.step_number(), n);
          second.run_to(end);
          second.node_statistics.finish(second.contact);
          // Fields, histories, statistics, probes, energies and all that judges them.
          EXPECT_TRUE(save_state(whole) == save_state(second));
        }
    }
}

TEST(Restart, StatesThatDoNotFitAreRefused)
{
  BodySetup setup = with_pressure();
  ObservedBody body(setup);
  body.run_to(100);
  const std::string state = save_state(body);
  load_state(state, body, "test");
  setup.cells = {{10, 6}};
  setup.ids.assign(60, 0);
  ObservedBody wider(setup);
  EXPECT_THROW(load_state(state, wider, "test"), UserError);
}
