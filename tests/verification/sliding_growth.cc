#include "sliding_body.h"

#include <complex>
#include <gtest/gtest.h>

using namespace verification;

namespace
{
using Complex = std::complex<double>;
constexpr Complex I(0., 1.);
constexpr double H = 0.016, c_T = 2560., V = 50., P = 5e6;

/** Steady sliding of a layer, numerics.md 5.5: perturbations exp(i k x + s t). */
struct Layer
{
  double kH, mu, delta, beta;

  /** Time step (s) whose friction law is meant; 0: the law itself. */
  double dt = 0.;

  /** Friction over mu times the pressure. The scheme takes the pressure at the end of a
   *  step for that of the whole step, which is half a step early. */
  Complex friction(const Complex s) const
  {
    if (dt == 0. || delta == 0.)
      return mu / (1. + s * delta);
    const double q = std::exp(-dt / delta);
    return mu * (1. - q) / (1. - q * std::exp(-s * dt));
  }

  double k() const
  {
    return kH / H;
  }
  /** a (c_L) or b (c_T) */
  Complex decay(const Complex s, const double speed) const
  {
    return std::sqrt(k() * k() + s * s / (speed * speed * (1. + beta * s)));
  }
  double c_L() const
  {
    return c_T * std::sqrt(1.6 / 0.6);
  }

  /** Left side of the dispersion relation. */
  Complex operator()(const Complex s) const
  {
    const Complex a = decay(s, c_L()), b = decay(s, c_T), k2 = k() * k();
    return s * s / (c_T * c_T * (1. + beta * s)) +
           I * k() * friction(s) *
             ((b * b + k2) * std::tanh(a * H) / a - 2. * b * std::tanh(b * H));
  }

  /** The root near @p s by Newton's method. */
  Complex root(Complex s) const
  {
    for (unsigned int n = 0; n < 60; ++n)
      {
        const double step = 1e-6 * std::abs(s);
        s -= (*this)(s)*2. * step / ((*this)(s + step) - (*this)(s - step));
      }
    return s;
  }

  /** The fastest growing perturbation. */
  Complex fastest() const
  {
    Complex best = -1.;
    for (const double sign : {1., -1.})
      for (double f = 20e3; f < 120e3; f += 2e3)
        {
          const Complex s = root(Complex(1e4, sign * 2. * M_PI * f));
          if (std::abs((*this)(s)) < 1e-9 * std::abs(s * s) / (c_T * c_T) &&
              std::abs(s.imag()) > 2. * M_PI * 1e4 && s.real() > best.real())
            best = s;
        }
    return best;
  }

  /** Its shape: a dilatation and a shear that leave u_x = sigma_yy = 0 on top and u_y = 0
   *  below. */
  Complex shape(const Complex s, const double y, const unsigned int c) const
  {
    const Complex a = decay(s, c_L()), b = decay(s, c_T), eta = H - y;
    const Complex A = -I * k() * std::cosh(b * H), B = a * std::cosh(a * H);
    const Complex size = A * a * std::cosh(a * H);
    return c == 0
             ? (I * k() * A * std::sinh(a * eta) - b * B * std::sinh(b * eta)) / size
             : (-a * A * std::cosh(a * eta) - I * k() * B * std::cosh(b * eta)) / size;
  }
};

/** Fourier component k of a row: its log over time, the phase unwrapped. */
struct FourierProbe : StepObserver
{
  explicit FourierProbe(const SlidingBody &body)
    : body(body)
  {
  }

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return next_multiple(n, 10);
  }
  void before_step(const std::uint64_t n) override
  {
    Complex sum      = 0.;
    const unsigned N = body.setup.cells[0];
    for (unsigned int i = 0; i < N; ++i)
      sum += body.u.row(0, 0)[i] * std::exp(-2. * M_PI * I * (double(i) / N));
    Complex next = std::log(sum);
    if (!logs.empty())
      next += 2. * M_PI * I * std::round((logs.back() - next).imag() / (2. * M_PI));
    logs.push_back(next);
    times.push_back(n * body.setup.step.dt);
  }
  void after_step(const std::uint64_t) override
  {
  }

  /** Slope of the straight line through the logs from @p start on. */
  Complex rate(const double start) const
  {
    double n = 0., t1 = 0., t2 = 0.;
    Complex l1 = 0., lt = 0.;
    for (std::size_t k = 0; k < times.size(); ++k)
      if (times[k] >= start)
        {
          n += 1.;
          t1 += times[k];
          t2 += times[k] * times[k];
          l1 += logs[k];
          lt += logs[k] * times[k];
        }
    return (lt - l1 * t1 / n) / (t2 - t1 * t1 / n);
  }

  const SlidingBody &body;
  std::vector<double> times;
  std::vector<Complex> logs;
};

double time_step(const Layer &layer, const unsigned int n)
{
  return 0.9 * H / n / layer.c_L();
}

/** Growth rate and frequency of the layer with @p n cells over its height. */
Complex observed(const Layer &layer, const Complex s, const unsigned int n)
{
  BodySetup setup;
  const double length         = 2. * M_PI / layer.k();
  const unsigned int n_length = 20 * std::lround(length / H * n / 20.);
  setup.cells                 = {{n_length, n}};
  setup.spacing               = {{length / n_length, H / n}};
  setup.classes               = {resin()};
  setup.periodic              = true;
  setup.friction              = layer.mu;
  setup.contact.flat_velocity = LoadHistory(V);
  setup.contact.law.time      = layer.delta;
  setup.top.kind              = TopSetup::Kind::pressure;
  setup.top.lateral_held      = true;
  setup.top.pressure          = LoadHistory(P);
  setup.step.beta             = layer.beta;
  setup.step.dt               = time_step(layer, n);
  setup.sweep.wavefront       = 1;
  SlidingBody body(setup);

  // Sliding under uniform stress, and the seed on top of it.
  const double seed = 1e-13, dt = setup.step.dt;
  const auto &D = setup.classes[0].stiffness;
  body.set_u([&](const double x, const double y, const unsigned int c) {
    const double steady = c == 0 ? layer.mu * P / D(2, 2) * (H - y) : -P / D(1, 1) * y;
    return steady + seed * (layer.shape(s, y, c) * std::exp(I * layer.k() * x)).real();
  });
  body.set_w([&](const double x, const double y, const unsigned int c) {
    const Complex wave = std::exp(I * layer.k() * x - 0.5 * s * dt);
    return seed * (s * layer.shape(s, y, c) * wave).real();
  });
  FourierProbe probe(body);
  // Coulomb: much shorter waves grow faster, from round-off to separation in 57 us at
  // n = 80. Otherwise the missing friction memory of the seed has to fade.
  const double start = layer.delta > 0. ? 150e-6 : 5e-6;
  const double end   = layer.delta > 0. ? 400e-6 : 50e-6;
  body.run(std::lround(end / dt), &probe);

  // The perturbation was linear all the time: every node slipped.
  const ContactHistory &h = body.contact.history();
  for (std::size_t m = 0; m < h.time.size(); ++m)
    if (h.slipping[m] != n_length)
      {
        ADD_FAILURE() << "a node does not slip at " << h.time[m];
        break;
      }
  return probe.rate(start);
}

void expect_growth(const Layer &layer, const double growth, const double frequency)
{
  const Complex s = layer.fastest();
  EXPECT_NEAR(s.real(), growth, 2e-3);
  EXPECT_NEAR(std::abs(s.imag()) / (2. * M_PI), frequency, 2e-3);

  std::vector<double> errors, law_errors;
  for (const unsigned int n : {20, 40, 80})
    {
      const Complex found = observed(layer, s, n);
      Layer discrete      = layer;
      discrete.dt         = time_step(layer, n);
      const Complex exact = discrete.root(s);
      errors.push_back(std::abs(found - exact));
      law_errors.push_back(std::abs(exact - s));
      std::printf(
        "H/%u: growth %.1f 1/s at %.2f Hz; error %.5f %% of s, of the law %.5f %%\n", n,
        found.real(), std::abs(found.imag()) / (2. * M_PI),
        100. * errors.back() / std::abs(s), 100. * law_errors.back() / std::abs(s));
      if (n == 80)
        {
          EXPECT_NEAR(found.real(), s.real(), 0.01 * s.real());
          EXPECT_NEAR(found.imag(), s.imag(), 1e-3 * std::abs(s.imag()));
        }
    }
  EXPECT_NEAR(orders(errors).back(), 2., 0.25);
  if (layer.delta > 0.)
    {
      EXPECT_NEAR(orders(law_errors).back(), 1., 0.05);
    }
}
} // namespace

TEST(Growth, Coulomb)
{
  expect_growth({1.15, 0.25, 0., 0.}, 30030.410, 49264.050);
}

TEST(Growth, RegularizedAndDamped)
{
  expect_growth({1., 0.25, 1.5e-6, 4.4e-9}, 23574.532, 45632.343);
}
