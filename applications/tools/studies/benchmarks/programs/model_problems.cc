/**
 * Errors and times of problems with known solutions: a mode of the rectangle, the bar
 * that hits the wall, the growth of steady sliding, also in 3D under 45 degrees.
 *
 *     model_problems mode|bar|growth|oblique_growth <repetitions> <n>:<share>:<beta2>...
 *
 * n is the number of cells over the height, share the time step over the critical one.
 * Each choice gives one line of CSV; cpu_s is the time of the time loop alone, without
 * observers: median, lowest and highest of the repetitions.
 */
#include "box_run.h"
#include "measuring.h"
#include "verification/dynamics/impact_bar.h"
#include "verification/dynamics/rectangle_mode.h"
#include "verification/sliding/oblique_layer.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

using namespace verification;

namespace
{
struct Choice
{
  unsigned int n;
  double share, beta2;
};

/** Results of one choice. */
struct Outcome
{
  double cells, dt, steps;
  /** Relative errors; the columns are named by the problem. */
  std::vector<double> errors;
  std::vector<double> cpu_seconds;
};

double cpu_seconds(const std::function<void()> &run)
{
  const std::clock_t begin = std::clock();
  run();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

std::vector<double> repeat(const unsigned int repetitions,
                           const std::function<double()> &one)
{
  std::vector<double> seconds;
  for (unsigned int r = 0; r < repetitions; ++r)
    seconds.push_back(one());
  std::sort(seconds.begin(), seconds.end());
  return seconds;
}

Outcome outcome(const BodySetup &setup, const double end)
{
  return {double(setup.cells[0]) * setup.cells[1],
          setup.step.dt,
          double(std::lround(end / setup.step.dt)),
          {},
          {}};
}

/**
 * Five periods of the slowest shear mode, starting at rest; the error is the frequency
 * error.
 */
Outcome mode(const Choice &choice, const unsigned int repetitions)
{
  using namespace exact_modes;
  const Mode mode{1, 0, true};
  BodySetup setup  = rectangle(choice.n);
  setup.step.beta2 = choice.beta2;
  setup.choose_time_step(choice.share);
  const double exact = mode.omega(setup.classes[0]), period = 2. * M_PI / exact;
  const DiscreteMode discrete = discrete_mode(setup, mode);
  Outcome result              = outcome(setup, 5. * period);
  const unsigned int interval = std::max(1l, std::lround(period / 40. / setup.step.dt));
  result.cpu_seconds          = repeat(repetitions, [&]() {
    HeldBelow bottom(setup.step);
    Body body(setup, MPI_COMM_SELF, &bottom);
    body.u = discrete.shape;
    std::vector<double> q;
    double seconds = 0.;
    for (double step = 0; step < result.steps; step += interval)
      {
        q.push_back(mass_product(body.material, body.u, discrete.shape));
        seconds += cpu_seconds([&]() { body.run(interval); });
      }
    const auto [omega, decay] = frequency_and_decay(q, interval * setup.step.dt);
    result.errors             = {omega / exact - 1., decay * period};
    return seconds;
  });
  return result;
}

/** Share of energy dissipated in a single impact, relative error of the contact time. */
Outcome bar(const Choice &choice, const unsigned int repetitions)
{
  using namespace impact_bar;
  BodySetup setup = impact_bar::bar(choice.n, choice.beta2, 1.);
  setup.choose_time_step(choice.share);
  Outcome result      = outcome(setup, 2.);
  const Impact impact = impact_bar::impact(setup);
  if (!impact.separated)
    throw std::runtime_error("the bar is still on the wall");
  result.errors         = {1. - impact.balanced, impact.duration / exact_duration - 1.};
  setup.energy_interval = 0;
  result.cpu_seconds    = repeat(repetitions, [&]() {
    Body body(setup);
    throw_down(body);
    return cpu_seconds([&]() { body.run(result.steps); });
  });
  return result;
}

/**
 * Errors of growth rate and frequency of the fastest wave of regularized, damped sliding.
 */
Outcome growth(const Choice &choice, const unsigned int repetitions)
{
  using namespace sliding_layer;
  const Layer layer{1., 0.25, 1.5e-6, 4.4e-9};
  const Complex exact = layer.fastest();
  BodySetup setup     = layer_setup(layer, choice.n);
  setup.step.beta2    = choice.beta2;
  setup.choose_time_step(choice.share);
  Outcome result    = outcome(setup, 400e-6);
  const Growth seen = observed(setup, layer, exact);
  if (!seen.slipping)
    throw std::runtime_error("a node does not slip");
  result.errors      = {seen.rate.real() / exact.real() - 1.,
                        seen.rate.imag() / exact.imag() - 1.};
  result.cpu_seconds = repeat(repetitions, [&]() {
    Body body(setup);
    start_sliding(body, layer, exact);
    return cpu_seconds([&]() { body.run(result.steps); });
  });
  return result;
}

/**
 * The layer as a box of cubes, nine heights long and half as wide, between walls along
 * the sliding direction: this length is one wavelength under 45 degrees.
 */
ContactParameters oblique_box(const sliding_layer::ObliqueLayer &layer,
                              const unsigned int n)
{
  using namespace sliding_layer;
  ContactParameters p = box_parameters({{9 * n, 9 * n / 2, n}}, {{9. * H, 4.5 * H, H}});
  p.mesh.periodic[0]  = {"Left", "Right"};
  p.mesh.held[1]      = {"Front", "Back"};
  p.friction.coefficient  = layer.mu;
  p.contact.flat_velocity = LoadHistory(layer.flat_velocity);
  p.contact.law.time      = layer.delta;
  p.top.is_platen         = false;
  p.top.held              = {{true, true, false}};
  p.top.pressure          = LoadHistory(P);
  p.step.beta             = layer.beta;
  return p;
}

/** Starts the box with sliding under uniform stress plus the wave. */
void start_oblique(BoxRun &run,
                   const sliding_layer::ObliqueLayer &layer,
                   const ElasticPhase<3> &material,
                   const sliding_layer::Complex s)
{
  using namespace sliding_layer;
  const double seed = 1e-13, dt = run.body.setup.step.dt;
  const auto &D             = material.stiffness;
  const auto &points        = run.part().points;
  const double steady[3][2] = {{layer.mu * P / D(4, 4), H}, {0., 0.}, {-P / D(2, 2), 0.}};
  for (std::size_t i = 0; i < points.size(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      {
        const Complex wave      = seed * layer.displacement(s, points[i], c);
        const double z          = points[i][2];
        run.body.u.row(c, 0)[i] = steady[c][0] * (c == 0 ? steady[c][1] - z : z);
        run.body.u.row(c, 0)[i] += wave.real();
        run.body.w.row(c, 0)[i] = (s * std::exp(-0.5 * s * dt) * wave).real();
      }
}

/**
 * Exponent nearest to @p s in a sum of six exponentials, by linear prediction from
 * @p samples at equal intervals; waves of the same length grow nearly as fast.
 */
sliding_layer::Complex exponent(const std::vector<sliding_layer::Complex> &samples,
                                const double interval,
                                const sliding_layer::Complex s)
{
  constexpr Eigen::Index order = 6;
  const auto n                 = static_cast<Eigen::Index>(samples.size()) - order;
  Eigen::MatrixXcd before(n, order);
  Eigen::VectorXcd next(n);
  for (Eigen::Index i = 0; i < n; ++i)
    {
      // Scaling gives early and late samples the same weight.
      const auto scale = std::exp(-s * interval * static_cast<double>(i));
      for (Eigen::Index k = 0; k < order; ++k)
        before(i, k) = scale * samples[static_cast<std::size_t>(i + k)];
      next[i] = scale * samples[static_cast<std::size_t>(i + order)];
    }
  const double size          = next.norm();
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(order, order);
  companion.topRightCorner(order - 1, order - 1).setIdentity();
  companion.row(order - 1) =
    (before / size).colPivHouseholderQr().solve(next / size).transpose();
  const auto roots = companion.eigenvalues();
  auto best        = std::log(roots[0]) / interval;
  for (const auto &root : roots)
    if (std::abs(std::log(root) / interval - s) < std::abs(best - s))
      best = std::log(root) / interval;
  return best;
}

/** Errors of growth rate and frequency of an oblique wave in 3D, see growth(). */
Outcome oblique_growth(const Choice &choice, const unsigned int repetitions)
{
  using namespace sliding_layer;
  ObliqueLayer layer;
  static_cast<Layer &>(layer) = {2. * M_PI * std::sqrt(2.) / 9., 0.4, 1.5e-6, 4.4e-9};
  layer.flat_velocity         = 16.; // exceeds the waves of the sudden start of friction
  layer.angle                 = M_PI / 4.;
  const Complex exact         = fastest_oblique(layer);
  const ElasticPhase<3> phase = {isotropic_stiffness<3>(2.4 * ObliqueLayer::G, 0.2),
                                 1900.};
  ContactParameters setup     = oblique_box(layer, choice.n);
  setup.step.beta2            = choice.beta2;
  setup.step.dt               = std::nan("");
  constexpr double end = 400e-6, start = 100e-6; // the seed has no friction memory
  Outcome result{};
  const auto solve = [&]() {
    BoxRun run(setup, {phase}, MPI_COMM_SELF, choice.share);
    start_oblique(run, layer, phase, exact);
    const auto &points = run.part().points;
    std::vector<std::pair<unsigned int, Complex>> bottom;
    for (unsigned int i = 0; i < run.part().n_distinct; ++i)
      if (points[i][2] < 1e-9 * H)
        bottom.emplace_back(i, std::cos(layer.k() * layer.across() * points[i][1]) *
                                 std::exp(-I * layer.k() * layer.along() * points[i][0]));
    const double dt     = run.body.setup.step.dt;
    result.cells        = 40.5 * std::pow(choice.n, 3);
    result.dt           = dt;
    const auto interval = std::max(1L, std::lround(1.5e-6 / dt));
    std::vector<Complex> samples;
    const double seconds = cpu_seconds([&]() {
      for (result.steps = 0.; result.steps * dt < end; result.steps += interval)
        {
          Complex sum = 0.;
          for (const auto &[point, weight] : bottom)
            sum += weight * run.body.u.row(0, 0)[point];
          if (result.steps * dt >= start)
            samples.push_back(sum);
          run.body.stepper.advance(interval);
          if (run.body.contact.sums().slipping != run.body.contact_nodes.n_owned())
            throw std::runtime_error("a node does not slip");
        }
    });
    const Complex rate = exponent(samples, interval * dt, exact);
    result.errors = {rate.real() / exact.real() - 1., rate.imag() / exact.imag() - 1.};
    return seconds;
  };
  result.cpu_seconds = repeat(repetitions, solve);
  return result;
}

struct Problem
{
  std::string name, columns;
  std::function<Outcome(const Choice &, unsigned int)> solve;
};

void print(const Choice &choice, const Outcome &o)
{
  const auto &s = o.cpu_seconds;
  std::printf("%u,%g,%g,%.0f,%.10g,%.0f", choice.n, choice.share, choice.beta2, o.cells,
              o.dt, o.steps);
  for (const double e : o.errors)
    std::printf(",%.10g", e);
  std::printf(",%.6g,%.6g,%.6g,%zu\n", s[s.size() / 2], s.front(), s.back(), s.size());
  std::fflush(stdout);
}

int run(const int argc, char **argv)
{
  const std::vector<Problem> problems = {
    {"mode", "frequency_error,amplitude_lost", mode},
    {"bar", "energy_lost,contact_time_error", bar},
    {"growth", "growth_error,frequency_error", growth},
    {"oblique_growth", "growth_error,frequency_error", oblique_growth}};
  for (const Problem &problem : problems)
    if (argc > 3 && problem.name == argv[1])
      {
        std::printf("n,share,beta2,cells,dt_s,steps,%s,cpu_s,cpu_s_low,cpu_s_high,"
                    "repetitions\n",
                    problem.columns.c_str());
        const unsigned int repetitions = std::max(1, std::atoi(argv[2]));
        for (int k = 3; k < argc; ++k)
          {
            Choice choice{};
            if (std::sscanf(argv[k], "%u:%lf:%lf", &choice.n, &choice.share,
                            &choice.beta2) != 3)
              throw std::runtime_error(std::string("not cells:share:beta2: ") + argv[k]);
            print(choice, problem.solve(choice, repetitions));
          }
        return 0;
      }
  throw std::runtime_error(
    "which problem? mode, bar, growth or oblique_growth, then repetitions, choices");
}
} // namespace

int main(int argc, char **argv)
{
  return mesoslip::guarded_main(argc, argv, "model_problems", run);
}
