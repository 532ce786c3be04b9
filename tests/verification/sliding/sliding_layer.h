#ifndef mesoslip_tests_verification_sliding_layer_h
#define mesoslip_tests_verification_sliding_layer_h

#include "box_body.h"

#include <complex>
#include <limits>

namespace verification
{
namespace sliding_layer
{
using Complex = std::complex<double>;
constexpr Complex I(0., 1.);
constexpr double H = 0.016, c_T = 2560., V = 50., P = 5e6;

/** The layer's material: c_T = 2560 m/s, nu = 0.2. */
template <int dim>
ElasticPhase<dim> layer_material()
{
  const double density = 1900.;
  return {isotropic_stiffness<dim>(2.4 * density * c_T * c_T, 0.2), density};
}

/** Steady sliding of a layer, perturbations exp(i k x + s t) (theory.md, 3). */
struct Layer
{
  double kH, mu, delta, beta;

  /** Time step (s) of the discrete friction law; 0: the law itself. */
  double dt = 0.;

  /** Time step (s) of the scheme: leapfrog, and damping of the velocity half a step
   *  earlier; 0: differential equations. */
  double scheme_dt = 0.;

  /** Of springs below the layer for the area (Pa/m). */
  double springs = std::numeric_limits<double>::infinity();

  double alpha = 0.; ///< of the damping in proportion to the mass (1/s)

  static constexpr double G = 1900. * c_T * c_T; ///< shear modulus (Pa)

  /** Friction over the pressure. The scheme solves the law for a pressure that is linear
   * in time within a step. */
  Complex friction(const Complex s) const
  {
    if (dt == 0. || delta == 0.)
      return mu / (1. + s * delta);
    const double q = std::exp(-dt / delta), mean = (1. - q) * delta / dt;
    const Complex before = std::exp(-s * dt);
    return mu * (1. - mean + (mean - q) * before) / (1. - q * before);
  }

  double k() const
  {
    return kH / H;
  }
  /** Inertia over stiffness with their damping, s (s + alpha) / (1 + beta s). */
  Complex inertia(const Complex s) const
  {
    if (scheme_dt == 0.)
      return s * (s + alpha) / (1. + beta * s);
    const Complex root     = 2. / scheme_dt * std::sinh(0.5 * s * scheme_dt),
                  velocity = (1. - std::exp(-s * scheme_dt)) / scheme_dt;
    return (root * root + alpha * std::sinh(s * scheme_dt) / scheme_dt) /
           (1. + beta * velocity);
  }
  /** a (c_L) or b (c_T) */
  Complex decay(const Complex s, const double speed) const
  {
    return std::sqrt(k() * k() + inertia(s) / (speed * speed));
  }
  double c_L() const
  {
    return c_T * std::sqrt(1.6 / 0.6);
  }

  /** Stiffness with damping over that without. */
  Complex softening(const Complex s) const
  {
    return 1. + beta * (scheme_dt > 0. ? (1. - std::exp(-s * scheme_dt)) / scheme_dt : s);
  }

  /** A dilatation A sinh(a eta) / cosh(a H) and a shear B cosh(b eta) / cosh(b H), eta = H - y, leave
   * u_x = sigma_yy = 0 on top. */
  struct Waves
  {
    Complex a, b, ta, tb, A, B; ///< ta, tb: tanh(a H), tanh(b H)
    double k;

    /** Over G and its softening at the flat, for A = @p of_a and B = @p of_b. */
    Complex normal_stress(const Complex of_a, const Complex of_b) const
    {
      return (b * b + k * k) * ta * of_a + 2. * I * k * b * tb * of_b;
    }
    Complex normal_stress() const
    {
      return normal_stress(A, B);
    }
    Complex shear_stress() const
    {
      return -2. * I * k * a * A + (b * b + k * k) * B;
    }
    /** u_x at the flat. */
    Complex along() const
    {
      return I * k * ta * A - b * tb * B;
    }
  };

  /** Those with sigma_yy = springs u_y at the flat, and u_y = 0 on a rigid one. */
  Waves waves(const Complex s) const
  {
    Waves w              = {decay(s, c_L()), decay(s, c_T), 0., 0., 0., 0., k()};
    w.ta                 = std::tanh(w.a * H);
    w.tb                 = std::tanh(w.b * H);
    const Complex yields = G * softening(s) / springs;
    w.A                  = -I * k() - yields * w.normal_stress(0., 1.);
    w.B                  = w.a + yields * w.normal_stress(1., 0.);
    return w;
  }

  /** Left side of the dispersion relation. */
  Complex operator()(const Complex s) const
  {
    const Waves w = waves(s);
    return (w.shear_stress() - friction(s) * w.normal_stress()) / w.a;
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

  /** Its shape. */
  Complex shape(const Complex s, const double y, const unsigned int c) const
  {
    const Waves w     = waves(s);
    const Complex eta = H - y, a = w.a, b = w.b, A = w.A / std::cosh(a * H),
                  B = w.B / std::cosh(b * H), size = w.A * a;
    return c == 0
             ? (I * k() * A * std::sinh(a * eta) - b * B * std::sinh(b * eta)) / size
             : (-a * A * std::cosh(a * eta) - I * k() * B * std::cosh(b * eta)) / size;
  }
};

/** The log of a complex amplitude over time, the phase unwrapped. */
struct Amplitude
{
  void add(const double time, const Complex value)
  {
    Complex next = std::log(value);
    if (!logs.empty())
      next += 2. * M_PI * I * std::round((logs.back() - next).imag() / (2. * M_PI));
    logs.push_back(next);
    times.push_back(time);
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

  std::vector<double> times;
  std::vector<Complex> logs;
};

/**
 * The circular frequency and growth of a real signal that is one wave Re(c exp(s t)):
 * samples follow q(n + 1) = a q(n) + b q(n - 1), with a and b by least squares.
 */
inline Complex rate_of(const std::vector<double> &q, const double interval)
{
  double m11 = 0., m12 = 0., m22 = 0., r1 = 0., r2 = 0.;
  for (std::size_t n = 1; n + 1 < q.size(); ++n)
    {
      m11 += q[n] * q[n];
      m12 += q[n] * q[n - 1];
      m22 += q[n - 1] * q[n - 1];
      r1 += q[n + 1] * q[n];
      r2 += q[n + 1] * q[n - 1];
    }
  const double det = m11 * m22 - m12 * m12, a = (r1 * m22 - r2 * m12) / det,
               b = (m11 * r2 - m12 * r1) / det;
  return std::log(0.5 * a + std::sqrt(Complex(0.25 * a * a + b))) / interval;
}

/** A Fourier component of the lowest row. */
template <class AnyBody>
struct FourierProbe : StepObserver, Amplitude
{
  explicit FourierProbe(const AnyBody &body,
                        const unsigned int waves    = 1,
                        const unsigned int interval = 10)
    : body(body)
    , waves(waves)
    , interval(interval)
  {
  }

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return next_multiple(n, interval);
  }
  void before_step(const std::uint64_t n) override
  {
    Complex sum      = 0.;
    const unsigned N = body.setup.cells[0];
    for (unsigned int i = 0; i < N; ++i)
      sum +=
        body.at(body.u, 0, i, 0) * std::exp(-2. * M_PI * I * (double(waves * i) / N));
    add(n * body.setup.step.dt, sum);
  }
  void after_step(const std::uint64_t) override
  {
  }

  const AnyBody &body;
  const unsigned int waves, interval;
};

/** The layer with @p n cells over its height, on the verge of moving; the Courant
 *  number is 0.9. */
inline BodySetup layer_setup(const Layer &layer, const unsigned int n)
{
  BodySetup setup;
  const double length                   = 2. * M_PI / layer.k();
  const unsigned int n_length           = 20 * std::lround(length / H * n / 20.);
  setup.cells                           = {{n_length, n}};
  setup.spacing                         = {{length / n_length, H / n}};
  setup.classes                         = {resin()};
  setup.periodic                        = true;
  setup.friction                        = layer.mu;
  setup.contact.flat_velocity           = LoadHistory(V);
  setup.contact.law.time                = layer.delta;
  setup.contact.normal_spring.stiffness = layer.springs;
  setup.top.is_platen                   = false;
  setup.top.held                        = {{true, true, false}};
  setup.top.pressure                    = LoadHistory(P);
  setup.step.alpha                      = layer.alpha;
  setup.step.beta                       = layer.beta;
  setup.step.dt                         = 0.9 * H / n / layer.c_L();
  setup.sweep.steps_at_once             = 1;
  return setup;
}

/** Sliding under uniform stress, and the seed exp(i k x + s t) on top of it. */
template <class AnyBody>
void start_sliding(AnyBody &body, const Layer &layer, const Complex s)
{
  const double seed = 1e-13, dt = body.setup.step.dt;
  const auto &D = body.setup.classes[0].stiffness;
  body.set_u([&](const double x, const double y, const unsigned int c) {
    const double steady =
      c == 0 ? layer.mu * P / D(2, 2) * (H - y) : -P / D(1, 1) * y - P / layer.springs;
    return steady + seed * (layer.shape(s, y, c) * std::exp(I * layer.k() * x)).real();
  });
  body.set_w([&](const double x, const double y, const unsigned int c) {
    const Complex wave = std::exp(I * layer.k() * x - 0.5 * s * dt);
    return seed * (s * layer.shape(s, y, c) * wave).real();
  });
}

/** Growth rate (1/s) and circular frequency of the layer that @p setup describes. */
struct Growth
{
  Complex rate;
  /** Every node slipped all the time: the perturbation was linear. */
  bool slipping = true;
};

/** As a box the layer is one cell deep. */
template <int dim = 2>
Growth observed(const BodySetup &setup, const Layer &layer, const Complex s)
{
  BodyIn<dim> body = make_body<dim>(setup, {layer_material<3>()});
  start_sliding(body, layer, s);
  FourierProbe probe(body);
  // Coulomb: much shorter waves grow faster, from round-off to separation in 57 us at
  // n = 80. Otherwise the missing friction memory of the seed has to fade.
  const double start = layer.delta > 0. ? 150e-6 : 5e-6;
  const double end   = layer.delta > 0. ? 400e-6 : 50e-6;
  body.run(std::lround(end / setup.step.dt), &probe);
  const ContactHistory &h = body.contact_recorder.history();
  Growth growth{probe.rate(start)};
  for (const double n : h.slipping)
    growth.slipping = growth.slipping && n == setup.cells[0] * body.nodes_deep;
  return growth;
}
} // namespace sliding_layer
} // namespace verification

#endif
