#include "eigenvalues/complex/still_vibrations.h"

#include "eigenvalues/complex/arnoldi.h"
#include "statics/static_solver.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;
using Factors = Eigen::SimplicialLDLT<RealMatrix>;

/**
 * x of K u = x M u whose damped vibration, s^2 + beta x s + x = 0, has the circular
 * frequency @p omega; infinite if there is none.
 */
double square_at(const double omega, const double beta)
{
  // The smaller solution of x - (beta x / 2)^2 = omega^2.
  const double root = 1. - std::pow(beta * omega, 2);
  return root < 0. ? std::numeric_limits<double>::infinity()
                   : 2. * omega * omega / (1. + std::sqrt(root));
}

/**
 * Largest x in @p range: the decay rate is beta x / 2, and beta^2 x / 4 over 1 - beta^2 x
 * / 4 is the squared ratio of decay rate to frequency.
 */
double largest_square(const CountedRange &range, const double beta)
{
  const double highest = square_at(range.top, beta), steep = range.steep * range.steep;
  if (!(beta > 0.))
    return highest;
  return std::min(
    {highest, 2. * range.decay / beta, 4. * steep / ((1. + steep) * beta * beta)});
}

/** Factorizes K - x M. */
void factorize(Factors &factors, const SlidingPencil &still, const double x)
{
  RealMatrix shifted = still.stiffness;
  shifted -= x * still.mass;
  factors.compute(shifted);
  if (factors.info() != Eigen::Success)
    throw NotConverged("a pivot vanished in the count of eigenvalues");
}

/** Number of eigenvalues of K u = x M u below the shift. */
int n_below(const Factors &factors)
{
  return static_cast<int>((factors.vectorD().array() < 0.).count());
}

/** A value x, and the number of eigenvalues below it. */
struct Border
{
  double x = 0.;
  int n    = 0;
};

Border border_at(const SlidingPencil &still, const double x)
{
  if (!(x > 0.))
    return {}; // K is positive semi-definite
  Factors factors;
  factorize(factors, still, x);
  return {x, n_below(factors)};
}

/**
 * Squared circular frequency x and shape; the shape is complex for multiple eigenvalues.
 */
struct Vibration
{
  double square = 0.;
  ComplexVector shape;
};

/** Eigenpairs of a symmetric pencil by Arnoldi iterations. */
class Vibrations
{
public:
  Vibrations(const SlidingPencil &still,
             const double tolerance,
             const std::function<void(unsigned int)> &before_solve)
    : still(still)
    , tolerance(tolerance)
    , before_solve(before_solve)
  {
  }

  /** At most @p n eigenvalues nearest to the shift @p x of the @p factors. */
  std::vector<Vibration>
  nearest(const Factors &factors, const double x, const int n, const unsigned int seed)
  {
    ArnoldiOptions options;
    options.count     = n;
    options.tolerance = tolerance;
    options.seed      = seed;
    const auto pairs  = arnoldi(
       still.size(),
       [&](ComplexVector &dst, const ComplexVector &src) {
        if (before_solve)
          before_solve(n_solves);
        ++n_solves;
        const Eigen::VectorXd real      = factors.solve(still.mass * src.real()),
                              imaginary = factors.solve(still.mass * src.imag());
        dst.resize(src.size());
        dst.real() = real;
        dst.imag() = imaginary;
      },
       options);
    std::vector<Vibration> found;
    for (Eigen::Index k = 0; pairs && k < pairs->values.size(); ++k)
      found.push_back({x + 1. / pairs->values[k].real(), pairs->vectors.col(k)});
    return found;
  }

  /** Appends all eigenvalues between @p low and @p high to all. */
  void collect(const Border &low, const Border &high)
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
        {
          std::vector<Vibration> found = nearest(factors, middle, n, seed);
          const double lowest          = low.x > 0. ? low.x : -high.x;
          found.erase(std::remove_if(found.begin(), found.end(),
                                     [&](const Vibration &one) {
                                       return !(one.square > lowest &&
                                                one.square < high.x);
                                     }),
                      found.end());
          if (static_cast<int>(found.size()) == n)
            {
              all.insert(all.end(), found.begin(), found.end());
              return;
            }
        }
    const Border between = {middle, n_below(factors)};
    collect(low, between);
    collect(between, high);
  }

  std::vector<Vibration> all; ///< collected vibrations
  unsigned int n_solves = 0;  ///< number of solves so far

private:
  const SlidingPencil &still;
  const double tolerance;
  const std::function<void(unsigned int)> before_solve;
};

/** Real shapes that span the same space as @p found, with u^T M u = 1. */
void make_real(const SlidingPencil &still,
               const std::vector<Vibration> &found,
               LowestVibrations &result)
{
  constexpr double least = 1e-6; // least norm of a further direction
  std::vector<Eigen::VectorXd> basis;
  for (const Vibration &one : found)
    for (Eigen::VectorXd x :
         {Eigen::VectorXd(one.shape.real()), Eigen::VectorXd(one.shape.imag())})
      {
        const double size =
          std::sqrt(one.shape.dot(product(still.mass, one.shape)).real());
        for (int pass = 0; pass < 2; ++pass)
          for (const Eigen::VectorXd &b : basis)
            x -= b.dot(still.mass * x) * b;
        if (const double rest = std::sqrt(x.dot(still.mass * x)); rest > least * size)
          basis.emplace_back(x / rest);
      }
  const auto n = static_cast<Eigen::Index>(basis.size());
  Eigen::MatrixXd V(still.size(), n);
  for (Eigen::Index k = 0; k < n; ++k)
    V.col(k) = basis[static_cast<std::size_t>(k)];
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(V.transpose() *
                                                            (still.stiffness * V).eval());
  for (Eigen::Index k = 0; k < n; ++k)
    {
      result.squares.push_back(ritz.eigenvalues()[k]);
      result.shapes.emplace_back(V * ritz.eigenvectors().col(k));
    }
}
} // namespace

// As a reference for the count, alpha and dashpots can be left out, springs can be damped
// like the body, and damping by phase can be replaced by its mean.
SlidingPencil without_friction(SlidingPencil pencil)
{
  for (RealMatrix *matrix : {&pencil.targets, &pencil.spring_targets,
                             &pencil.damped_targets, &pencil.drag, &pencil.late_drag})
    *matrix *= 0.;
  pencil.slack *= 0.;
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
  Vibrations vibrations(still, tolerance, {});
  vibrations.collect(border_at(still, square_at(range.low, beta)),
                     border_at(still, largest_square(range, beta)));
  std::vector<Complex> found;
  for (const Vibration &one : vibrations.all)
    if (const double x = one.square, decay = 0.5 * beta * x; x > decay * decay)
      found.emplace_back(-decay, std::sqrt(x - decay * decay));
  return found;
}

LowestVibrations lowest_vibrations(const SlidingPencil &still,
                                   const int n,
                                   const double unit,
                                   const double tolerance,
                                   const std::function<void(unsigned int)> &before_solve)
{
  // Threshold for rigid motions, which round-off shifts from zero.
  const Eigen::VectorXd diagonal = still.stiffness.diagonal();
  const double rigid =
    1e-9 * unit + 1e-14 * (diagonal.array() / still.mass.diagonal().array()).maxCoeff();
  const Border lowest = border_at(still, rigid);
  Vibrations vibrations(still, tolerance, before_solve);
  double border = 0.;
  {
    const double shift = -1e-2 * unit;
    Factors factors;
    factorize(factors, still, shift);
    std::vector<double> squares;
    for (const Vibration &one : vibrations.nearest(factors, shift, n + lowest.n, 1))
      squares.push_back(one.square);
    if (squares.empty())
      throw NotConverged("no vibration without friction was found");
    border = std::max(rigid, *std::max_element(squares.begin(), squares.end()));
  }
  Border highest;
  for (border *= 1. + 1e-4; highest.n < n + lowest.n; border *= 1.5)
    highest = border_at(still, border);
  vibrations.collect(lowest, highest);
  LowestVibrations result;
  make_real(still, vibrations.all, result);
  result.n_rigid  = static_cast<unsigned int>(lowest.n);
  result.n_solves = vibrations.n_solves;
  result.squares.resize(static_cast<std::size_t>(n));
  result.shapes.resize(static_cast<std::size_t>(n));
  return result;
}
} // namespace mesoslip
