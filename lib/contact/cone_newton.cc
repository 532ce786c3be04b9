#include "contact/cone_newton.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesoslip
{
namespace
{
/** Residual that vanishes at a solution, and its derivative. */
struct Residual
{
  Eigen::VectorXd value;
  Eigen::MatrixXd derivative;

  /** Sets the equation of component @p k to c d_k = 0. */
  void hold(const Eigen::Index k, const double c, const double d)
  {
    value[k] = c * d;
    derivative.row(k).setZero();
    derivative(k, k) = c;
  }
};

/**
 * Adds the friction of a slipping node: norm @p limit, direction of the augmented force.
 */
void add_friction(Residual &of,
                  const ConeProblem &problem,
                  const ConeProblem::Node &node,
                  const Eigen::VectorXd &direction,
                  const double size,
                  const double limit,
                  const double mu)
{
  const double turn = limit / size;
  for (std::size_t a = 0; a < node.along.size(); ++a)
    {
      const Eigen::Index k = node.along[a];
      const double e       = direction[static_cast<Eigen::Index>(a)];
      of.value[k] -= limit * e;
      if (limit > 0.)
        of.derivative.row(k) -= mu * e * problem.S.row(node.normal);
      for (std::size_t b = 0; b < node.along.size(); ++b)
        {
          const Eigen::Index l = node.along[b];
          const double across =
            turn * ((a == b ? 1. : 0.) - e * direction[static_cast<Eigen::Index>(b)]);
          of.derivative.row(k) -= across * problem.S.row(l);
          of.derivative(k, l) += across * problem.c;
        }
    }
}

/** Residual at @p d with coefficients of friction multiplied by @p share. */
Residual
residual_at(const ConeProblem &problem, const Eigen::VectorXd &d, const double share)
{
  const double c          = problem.c;
  const Eigen::VectorXd f = problem.F + problem.S * d, augmented = f - c * d;
  Residual of = {f, problem.S};
  for (const ConeProblem::Node &node : problem.nodes)
    {
      const bool touches = augmented[node.normal] > 0.;
      const double mu    = share * node.mu,
                   limit = touches ? mu * std::max(0., f[node.normal]) : 0.;
      Eigen::VectorXd along(static_cast<Eigen::Index>(node.along.size()));
      for (Eigen::Index a = 0; a < along.size(); ++a)
        along[a] = augmented[node.along[static_cast<std::size_t>(a)]];
      const double size = along.norm();
      if (touches)
        of.hold(node.normal, c, d[node.normal]);
      if (size > limit)
        add_friction(of, problem, node, along / size, size, limit, mu);
      else
        for (const Eigen::Index k : node.along)
          of.hold(k, c, d[k]);
    }
  return of;
}

/** Newton step; the shortest one if the body can slide as a whole. */
Eigen::VectorXd newton_step(const Residual &now)
{
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(now.derivative);
  if (lu.rcond() > 1e-13)
    return -lu.solve(now.value);
  return -now.derivative.completeOrthogonalDecomposition().solve(now.value);
}

void iterate(const ConeProblem &problem, Eigen::VectorXd &d, const double share)
{
  constexpr unsigned int most_steps = 60, most_halvings = 10;
  const double small = 1e-12 * problem.F.lpNorm<1>();
  Residual now       = residual_at(problem, d, share);
  for (unsigned int k = 0;
       k < most_steps && !(now.value.template lpNorm<Eigen::Infinity>() < small); ++k)
    {
      const Eigen::VectorXd step = newton_step(now), from = d;
      const double before = now.value.norm();
      double best         = -1.;
      for (unsigned int halved = 0; halved < most_halvings; ++halved)
        {
          const double part           = std::ldexp(1., -static_cast<int>(halved));
          const Eigen::VectorXd trial = from + part * step;
          Residual there              = residual_at(problem, trial, share);
          const double norm           = there.value.norm();
          if (best < 0. || norm < best)
            {
              best = norm;
              d    = trial;
              now  = std::move(there);
            }
          if (best < (1. - 1e-4 * part) * before)
            break;
        }
      if (k > most_steps / 2 && !(best < before))
        return;
    }
}
} // namespace

Eigen::VectorXd cone_newton(const ConeProblem &problem)
{
  constexpr int n_steps = 10;
  Eigen::VectorXd d     = Eigen::VectorXd::Zero(problem.F.size());
  for (int n = 0; n <= n_steps; ++n)
    iterate(problem, d, static_cast<double>(n) / n_steps);
  return d;
}
} // namespace mesoslip
