// What a checkpoint holds: bodies that are saved, forgotten and restored go on bit by bit
// as if nothing had happened.
#include "sliding_body.h"

#include "base/archive.h"
#include "dynamics/stability_monitor.h"
#include "observation/probe_recorder.h"
#include "observation/steady_record.h"
#include "observation/steady_state.h"

#include <gtest/gtest.h>

#include <cstring>

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
    , probes({{"inside", {{0.9e-3, 0.7e-3}}}, {"contact", {{0.5e-3, 0.}}}},
             material,
             stepper,
             contact,
             5)
    , watch(LimitCycleCriterion(), 10, setup.energy_interval, MPI_COMM_SELF)
    , statistics(recent_interval, setup.step.dt, setup.contact.flat_velocity, 16)
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
    SlidingBody::serialize(archive, version);
    archive &monitor &probes &watch &statistics;
  }

  StabilityMonitor monitor;
  ProbeRecorder probes;
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
  setup.top.kind        = TopSetup::Kind::platen;
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
  setup.top.kind             = TopSetup::Kind::pressure;
  setup.contact.law.node_law = std::make_shared<SlipRateRegularization>(3e-6, 1e-3);
  setup.periodic             = true;
  setup.energy_interval      = 7;
  setup.choose_time_step(0.9);
  return setup;
}
} // namespace

TEST(Restart, ContinuesBitByBit)
{
  constexpr std::uint64_t end = 400;
  for (const BodySetup &setup : {with_platen(), with_pressure()})
    {
      ObservedBody whole(setup);
      whole.run_to(end);
      whole.node_statistics.finish(whole.contact);
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

namespace
{
/** Three nodes whose vibration grows, settles, and later grows again; from sample first.
 */
ContactHistory vibration(const std::size_t first, const std::size_t end)
{
  ContactHistory h;
  h.nodes.resize(3);
  for (std::size_t k = first; k < end; ++k)
    {
      const double t = 1e-5 + 2e-8 * static_cast<double>(k);
      const double a = t > 7e-4 ? 1e-6 + 8e-3 * (t - 7e-4) : 1e-6 * std::tanh(1e4 * t);
      h.step.push_back(k);
      h.time.push_back(t);
      for (unsigned int node = 0; node < 3; ++node)
        h.nodes[node].ux.push_back(2e-6 + node * 1e-7 + a * std::sin(2.6e5 * t + node));
      h.friction_energy.push_back(1e5 * t + 0.01 * std::sin(2.6e5 * t));
      h.normal_force.push_back(5e4);
      h.tangential_force.push_back(1e4 * (1. + 0.1 * std::sin(2.6e5 * t)));
      h.sticking.push_back(1.);
      h.slipping.push_back(2.);
    }
  return h;
}

std::vector<double> judgement(const LimitCycleDetector &d)
{
  return {d.reached() ? 1. : 0., d.reached_at(), d.steady_from(), d.period()};
}
} // namespace

TEST(Restart, LimitCycleIsJudgedAlike)
{
  // While it grows, when it has settled, after the judgement was withdrawn.
  bool reached = false, withdrawn = false;
  for (const std::size_t end : {3000, 30001, 50000})
    {
      LimitCycleWatch whole(LimitCycleCriterion(), 3, 0, MPI_COMM_SELF);
      whole.update(vibration(0, end), nullptr);
      withdrawn = withdrawn || (reached && !whole.reached());
      reached   = reached || whole.reached();
      for (const std::size_t n : {std::size_t(1), end / 7, end - 1, end})
        {
          SCOPED_TRACE(std::to_string(n) + " of " + std::to_string(end));
          LimitCycleWatch first(LimitCycleCriterion(), 3, 0, MPI_COMM_SELF);
          first.update(vibration(0, n), nullptr);
          LimitCycleWatch second(LimitCycleCriterion(), 3, 0, MPI_COMM_SELF);
          load_state(save_state(first), second, "test");
          second.update(vibration(n, end), nullptr);
          EXPECT_EQ(second.description(), whole.description());
          EXPECT_EQ(judgement(second), judgement(whole));
          EXPECT_EQ(save_state(second), save_state(whole));
        }
    }
  EXPECT_TRUE(reached && withdrawn);
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

TEST(Restart, TheRunExercisesTheState)
{
  ObservedBody body(with_pressure());
  body.run_to(400);
  const ContactHistory &h = body.contact_recorder.history();
  for (const auto *values : {&h.sticking, &h.slipping, &h.separated, &h.impact_energy})
    EXPECT_GT(*std::max_element(values->begin(), values->end()), 0.);
  float landings = 0.f;
  for (const NodeCounts &block : body.node_statistics.blocks())
    for (const float n : block.landings)
      landings += n;
  EXPECT_GT(landings, 0.f);
  EXPECT_GT(body.energy->local_history().damping.back(), 0.);
}
