#include "eigenvalues/complex/still_vibrations.h"

#include "eigenvalues/complex/arnoldi.h"
#include "statics/static_solver.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;
using Factors = Eigen::SimplicialLDLT<RealMatrix>;

/** The x of K u = x M u whose vibration with damping, s^2 + beta x s + x = 0, has the circular
 * frequency @p omega; infinite where none has. */
double square_at(const double omega, const double beta)
{
  // Of x - (beta x / 2)^2 = omega^2 the lower one.
  const double root = 1. - std::pow(beta * omega, 2);
  return root < 0. ? std::numeric_limits<double>::infinity()
                   : 2. * omega * omega / (1. + std::sqrt(root));
}

/** The largest x in @p range: -s is beta x / 2, and beta^2 x / 4 over 1 - beta^2 x / 4 the square of its steepness. */
double largest_square(const CountedRange &range, const double beta)
{
  const double highest = square_at(range.top, beta), steep = range.steep * range.steep;
  if (!(beta > 0.))
    return highest;
  return std::min(
    {highest, 2. * range.decay / beta, 4. * steep / ((1. + steep) * beta * beta)});
}

/** Of K - x M. */
void factorize(Factors &factors, const SlidingPencil &still, const double x)
{
  RealMatrix shifted = still.stiffness;
  shifted.diagonal() -= x * still.mass;
  factors.compute(shifted);
  if (factors.info() != Eigen::Success)
    throw NotConverged("a pivot vanished in the count of eigenvalues");
}

/** Number of eigenvalues of K u = x M u below the shift. */
int n_below(const Factors &factors)
{
  return static_cast<int>((factors.vectorD().array() < 0.).count());
}

/** An x, and how many eigenvalues are below. */
struct Border
{
  double x = 0.;
  int n    = 0;
};

Border border_at(const SlidingPencil &still, const double x)
{
  if (!(x > 0.))
    return {}; // K has no motion without energy
  Factors factors;
  factorize(factors, still, x);
  return {x, n_below(factors)};
}

/** The eigenvalues nearest to the shift @p x, as many as are between @p low and @p high; fewer if one was missed. */
std::vector<double> nearest(const Factors &factors,
                            const Eigen::VectorXd &mass,
                            const double x,
                            const Border &low,
                            const Border &high,
                            const double tolerance,
                            const unsigned int seed)
{
  ArnoldiOptions options;
  options.count     = high.n - low.n;
  options.tolerance = tolerance;
  options.seed      = seed;
  const auto pairs  = arnoldi(
     mass.size(),
     [&](ComplexVector &dst, const ComplexVector &src) {
      const Eigen::VectorXd real      = factors.solve(mass.cwiseProduct(src.real())),
                            imaginary = factors.solve(mass.cwiseProduct(src.imag()));
      dst.resize(src.size());
      dst.real() = real;
      dst.imag() = imaginary;
    },
     options);
  std::vector<double> found;
  for (Eigen::Index k = 0; pairs && k < pairs->values.size(); ++k)
    if (const double value = x + 1. / pairs->values[k].real();
        value > (low.x > 0. ? low.x : -high.x) && value < high.x)
      found.push_back(value);
  return found;
}

/** Appends all eigenvalues between @p low and @p high. */
void collect(const SlidingPencil &still,
             const Border &low,
             const Border &high,
             const double tolerance,
             std::vector<double> &values)
{
  constexpr int most = 30;
  const int n        = high.n - low.n;
  if (n <= 0)
    return;
  const double middle = 0.5 * (low.x + high.x);
  if (!(middle > low.x && high.x - low.x > 1e-12 * high.x))
    throw NotConverged("eigenvalues without friction are too close to be told apart");
  Factors factors;
  factorize(factors, still, middle);
  if (n <= most && n + 1 < still.size())
    for (const unsigned int seed : {1U, 2U})
      if (const auto found =
            nearest(factors, still.mass, middle, low, high, tolerance, seed);
          static_cast<int>(found.size()) == n)
        {
          values.insert(values.end(), found.begin(), found.end());
          return;
        }
  const Border between = {middle, n_below(factors)};
  collect(still, low, between, tolerance, values);
  collect(still, between, high, tolerance, values);
}
} // namespace

// A reference for the count is as good without alpha and dashpots, with springs that are damped as the body is, and with
// the mean of damping by phase.
SlidingPencil without_friction(SlidingPencil pencil)
{
  for (RealMatrix *matrix :
       {&pencil.targets, &pencil.spring_targets, &pencil.damped_targets,
        &pencil.damped_friction, &pencil.drag, &pencil.late_drag, &pencil.friction,
        &pencil.spring_friction, &pencil.resistance, &pencil.late_resistance})
    *matrix *= 0.;
  pencil.stiffness   = pencil.whole_stiffness();
  pencil.springs     = RealMatrix(pencil.size(), pencil.size());
  pencil.resistances = pencil.springs;
  pencil.law.delta = pencil.law.state_time = pencil.law.alpha = 0.;
  pencil.law.beta += pencil.beta_besides;
  return pencil;
}

int count_still(const SlidingPencil &still, const CountedRange &range)
{
  const double beta = still.law.beta;
  return std::max(0, border_at(still, largest_square(range, beta)).n -
                       border_at(still, square_at(range.low, beta)).n);
}

std::vector<Complex>
find_still(const SlidingPencil &still, const CountedRange &range, const double tolerance)
{
  const double beta = still.law.beta;
  std::vector<double> squares;
  collect(still, border_at(still, square_at(range.low, beta)),
          border_at(still, largest_square(range, beta)), tolerance, squares);
  std::vector<Complex> found;
  for (const double x : squares)
    if (const double decay = 0.5 * beta * x; x > decay * decay)
      found.emplace_back(-decay, std::sqrt(x - decay * decay));
  return found;
}
} // namespace mesoslip
