// What a checkpoint holds: bodies that are saved, forgotten and restored go on bit by bit
// as if nothing had happened.
#include "sliding_body.h"

#include "base/archive.h"
#include "dynamics/stability_monitor.h"
#include "observation/probe_recorder.h"
#include "observation/steady_record.h"
#include "sliding/transient/limit_cycle_watch.h"

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
    , probes(
        {{"inside", {{0.9e-3, 0.7e-3}}}, {"contact", {{0.5e-3, 0.}}}},
        material,
        rows,
        setup.step,
        u,
        w,
        5,
        [this](const unsigned int node) {
          return std::array<double, 2>{
            {contact.tangential_force()[node], contact.normal_force()[node]}};
        },
        MPI_COMM_SELF)
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

void expect_equal(const std::vector<double> &a,
                  const std::vector<double> &b,
                  const std::string &what)
{
  EXPECT_FALSE(a.empty()) << what;
  EXPECT_TRUE(a == b) << what;
}

void expect_equal_contact(const Body &a, const Body &b)
{
  const ContactHistory &x = a.contact_recorder.history(),
                       &y = b.contact_recorder.history();
  EXPECT_TRUE(x.step == y.step);
  expect_equal(x.time, y.time, "time");
  expect_equal(x.normal_force, y.normal_force, "normal force");
  expect_equal(x.tangential_force, y.tangential_force, "tangential force");
  expect_equal(x.sticking, y.sticking, "sticking");
  expect_equal(x.slipping, y.slipping, "slipping");
  expect_equal(x.separated, y.separated, "separated");
  expect_equal(x.friction_energy, y.friction_energy, "friction energy");
  expect_equal(x.impact_energy, y.impact_energy, "impact energy");
  expect_equal(x.flat_work, y.flat_work, "flat work");
  expect_equal(x.nodes[0].ux, y.nodes[0].ux, "u_x");
  expect_equal(x.nodes[0].uy, y.nodes[0].uy, "u_y");
  expect_equal(x.nodes[0].vx, y.nodes[0].vx, "v_x");
  expect_equal(x.nodes[0].vy, y.nodes[0].vy, "v_y");
  expect_equal(x.nodes[0].normal_force, y.nodes[0].normal_force, "node's pressure");
  expect_equal(x.nodes[0].tangential_force, y.nodes[0].tangential_force,
               "node's friction");
  const std::vector<NodeCounts> &v = a.node_statistics.blocks(),
                                &w = b.node_statistics.blocks();
  ASSERT_EQ(v.size(), w.size());
  for (std::size_t k = 0; k < v.size(); ++k)
    {
      const NodeCounts &p = v[k], &q = w[k];
      EXPECT_TRUE(p.first_step == q.first_step && p.n_steps == q.n_steps) << k;
      EXPECT_TRUE(p.stick == q.stick && p.slip == q.slip && p.landings == q.landings)
        << k;
    }
}

void expect_equal_observations(ObservedBody &a, ObservedBody &b)
{
  expect_equal(std::vector<double>(a.u.begin(), a.u.begin() + a.u.size()),
               std::vector<double>(b.u.begin(), b.u.begin() + b.u.size()), "u");
  expect_equal(std::vector<double>(a.w.begin(), a.w.begin() + a.w.size()),
               std::vector<double>(b.w.begin(), b.w.begin() + b.w.size()), "w");
  expect_equal_contact(a, b);
  const TopHistory &s = a.top_recorder.history(), &t = b.top_recorder.history();
  expect_equal(s.normal_force, t.normal_force, "top's normal force");
  expect_equal(s.tangential_force, t.tangential_force, "top's tangential force");
  expect_equal(s.displacement, t.displacement, "top's displacement");
  expect_equal(s.work, t.work, "top's work");
  EXPECT_EQ(a.top.work(), b.top.work());
  const EnergyHistory &e = a.energy->local_history(), &f = b.energy->local_history();
  expect_equal(e.time, f.time, "energy's time");
  expect_equal(e.kinetic, f.kinetic, "kinetic");
  expect_equal(e.elastic, f.elastic, "elastic");
  expect_equal(e.potential, f.potential, "potential");
  expect_equal(e.external_work, f.external_work, "external work");
  expect_equal(e.friction, f.friction, "friction");
  expect_equal(e.impact, f.impact, "impact");
  expect_equal(e.damping, f.damping, "damping");
  expect_equal(e.scheme, f.scheme, "scheme");
  EXPECT_EQ(e.initial, f.initial);
  const auto p = a.probes.gather(), q = b.probes.gather();
  for (std::size_t k = 0; k < 2; ++k)
    {
      EXPECT_TRUE(p[k].name == q[k].name && p[k].on_contact == q[k].on_contact);
      expect_equal(p[k].time, q[k].time, "probe's time");
      expect_equal(p[k].displacement, q[k].displacement, "probe's displacement");
      expect_equal(p[k].velocity, q[k].velocity, "probe's velocity");
      expect_equal(p[k].strain, q[k].strain, "probe's strain");
      expect_equal(p[k].stress, q[k].stress, "probe's stress");
      EXPECT_TRUE(p[k].traction == q[k].traction && p[k].traction.empty() == (k == 0));
    }
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
          expect_equal_observations(whole, second);
          EXPECT_EQ(save_state(whole.monitor), save_state(second.monitor));
          EXPECT_EQ(save_state(whole.watch), save_state(second.watch));
          EXPECT_EQ(save_state(whole.statistics), save_state(second.statistics));
        }
    }
}

namespace
{
/** Three nodes whose vibration grows, settles, and later grows again. */
ContactHistory vibration(const std::size_t n)
{
  ContactHistory h;
  h.nodes.resize(3);
  for (std::size_t k = 0; k < n; ++k)
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
  return {d.reached() ? 1. : 0., d.reached_at().value_or(-1.), d.steady_from(),
          d.period()};
}
} // namespace

TEST(Restart, LimitCycleIsJudgedAlike)
{
  // While it grows, when it has settled, after the judgement was withdrawn.
  bool reached = false, withdrawn = false;
  for (const std::size_t end : {3000, 30001, 50000})
    {
      LimitCycleWatch whole(LimitCycleCriterion(), 3, 0, MPI_COMM_SELF);
      whole.update(vibration(end), nullptr);
      withdrawn = withdrawn || (reached && !whole.detector().reached());
      reached   = reached || whole.detector().reached();
      for (const std::size_t n : {std::size_t(1), end / 7, end - 1, end})
        {
          SCOPED_TRACE(std::to_string(n) + " of " + std::to_string(end));
          LimitCycleWatch first(LimitCycleCriterion(), 3, 0, MPI_COMM_SELF);
          first.update(vibration(n), nullptr);
          LimitCycleWatch second(LimitCycleCriterion(), 3, 0, MPI_COMM_SELF);
          load_state(save_state(first), second, "test");
          second.update(vibration(end), nullptr);
          EXPECT_EQ(second.detector().description(), whole.detector().description());
          EXPECT_EQ(judgement(second.detector()), judgement(whole.detector()));
          EXPECT_EQ(save_state(second), save_state(whole));
        }
    }
  EXPECT_TRUE(reached && withdrawn);
}

namespace
{
/** The state after @p n steps. */
std::string state_after(const BodySetup &setup, const std::uint64_t n)
{
  ObservedBody body(setup);
  body.run_to(n);
  return save_state(body);
}

bool is_refused(const std::string &state, const BodySetup &setup)
{
  ObservedBody body(setup);
  try
    {
      load_state(state, body, "test");
    }
  catch (const mesoslip::UserError &)
    {
      return true;
    }
  return false;
}
} // namespace

TEST(Restart, StatesThatDoNotFitAreRefused)
{
  const BodySetup setup   = with_pressure();
  const std::string state = state_after(setup, 100);
  EXPECT_FALSE(is_refused(state, setup));
  BodySetup wider = setup;
  wider.cells     = {{10, 6}};
  wider.ids.assign(60, 0);
  EXPECT_TRUE(is_refused(state, wider));
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

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  ::testing::InitGoogleTest(&argc, argv);
  const int result = RUN_ALL_TESTS();
  MPI_Finalize();
  return result;
}
