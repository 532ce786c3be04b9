#include "elasticity/conjugate_gradients.h"

#include <cmath>
#include <sstream>

namespace mesoslip
{
ConjugateGradients::ConjugateGradients(const UniformMaterial &material,
                                       const unsigned int max_iterations)
  : material(material)
  , stiffness(material)
  , held(material.n_columns(), material.n_rows())
  , max_iterations(max_iterations)
{
}

void ConjugateGradients::set_held(const DofMask &new_held)
{
  held     = new_held;
  singular = true;
  for (unsigned int j = 0; j < held.n_rows() && singular; ++j)
    for (unsigned int i = 0; i < held.n_columns() && singular; ++i)
      singular = held.held(i, j) == 0;
  prepare();
}

void ConjugateGradients::clear_held(NodalField<double> &x) const
{
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < x.n_rows(); ++j)
      {
        double *row = x.row(c, j);
        for (unsigned int i = 0; i < x.n_columns(); ++i)
          if (held.is_held(c, i, j))
            row[i] = 0.;
      }
}

void ConjugateGradients::copy_duplicates(NodalField<double> &x) const
{
  const Periodicity periodic = material.periodicity();
  for (unsigned int c = 0; c < 2; ++c)
    {
      for (unsigned int j = 0; periodic.x && j < x.n_rows(); ++j)
        x.row(c, j)[x.n_columns() - 1] = x.row(c, j)[0];
      if (periodic.y)
        std::copy_n(x.row(c, 0), x.n_columns(), x.row(c, x.n_rows() - 1));
    }
}

// On a floating body residuals are in equilibrium up to round-off; without this that
// round-off would grow. Rotations need no such care in practice: they converge last and
// change no strain.
void ConjugateGradients::remove_translations(NodalField<double> &x) const
{
  const unsigned int nx = x.n_columns() - (material.periodicity().x ? 1 : 0);
  const unsigned int ny = x.n_rows() - (material.periodicity().y ? 1 : 0);
  for (unsigned int c = 0; c < 2; ++c)
    {
      double sum = 0.;
      for (unsigned int j = 0; j < ny; ++j)
        {
          double row = 0.;
          for (unsigned int i = 0; i < nx; ++i)
            row += x.row(c, j)[i];
          sum += row;
        }
      const double mean = sum / (static_cast<double>(nx) * ny);
      for (unsigned int j = 0; j < x.n_rows(); ++j)
        for (unsigned int i = 0; i < x.n_columns(); ++i)
          x.row(c, j)[i] -= mean;
    }
}

double ConjugateGradients::dot(const NodalField<double> &x,
                               const NodalField<double> &y) const
{
  const unsigned int nx = x.n_columns() - (material.periodicity().x ? 1 : 0);
  const unsigned int ny = x.n_rows() - (material.periodicity().y ? 1 : 0);
  double sum            = 0.;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < ny; ++j)
      {
        const double *a = x.row(c, j), *b = y.row(c, j);
        double lanes[8] = {};
        unsigned int i  = 0;
        for (; i + 8 <= nx; i += 8)
          for (unsigned int l = 0; l < 8; ++l)
            lanes[l] += a[i + l] * b[i + l];
        for (; i < nx; ++i)
          lanes[0] += a[i] * b[i];
        for (const double lane : lanes)
          sum += lane;
      }
  return sum;
}

SolverReport ConjugateGradients::solve(NodalField<double> &u,
                                       const NodalField<double> &force,
                                       const double tolerance)
{
  const std::size_t n = u.size();
  NodalField<double> r(u.n_columns(), u.n_rows()), z = r, p = r, Kp = r;

  // Start from the prescribed values and zero elsewhere if u brings nothing.
  stiffness.vmult(Kp, u);
  for (std::size_t k = 0; k < n; ++k)
    r.begin()[k] = force.begin()[k] - Kp.begin()[k];
  clear_held(r);
  if (singular)
    remove_translations(r);

  SolverReport report;
  const double initial = std::sqrt(dot(r, r));
  double rho           = 0.;
  if (!std::isfinite(initial))
    throw NotConverged("conjugate gradients met numbers that are not finite",
                       NotConverged::Reason::not_finite);
  while (initial > 0.)
    {
      const double norm = std::sqrt(dot(r, r));
      report.residual   = norm / initial;
      if (report.residual <= tolerance)
        break;
      if (report.iterations == max_iterations || !std::isfinite(norm))
        {
          std::ostringstream message;
          message << "conjugate gradients stopped after " << report.iterations
                  << " iterations at a relative residual of " << report.residual
                  << ", wanted " << tolerance;
          throw NotConverged(message.str(), std::isfinite(norm)
                                              ? NotConverged::Reason::iterations
                                              : NotConverged::Reason::not_finite);
        }
      precondition(z, r);
      const double rho_new = dot(r, z), beta = report.iterations > 0 ? rho_new / rho : 0.;
      rho = rho_new;
      for (std::size_t k = 0; k < n; ++k)
        p.begin()[k] = z.begin()[k] + beta * p.begin()[k];
      stiffness.vmult(Kp, p);
      clear_held(Kp);
      const double alpha = rho / dot(p, Kp);
      for (std::size_t k = 0; k < n; ++k)
        {
          u.begin()[k] += alpha * p.begin()[k];
          r.begin()[k] -= alpha * Kp.begin()[k];
        }
      ++report.iterations;
    }
  copy_duplicates(u);
  if (singular)
    remove_translations(u);
  return report;
}

JacobiSolver::JacobiSolver(const UniformMaterial &material)
  : ConjugateGradients(material, 100000)
  , inverse_diagonal(material.n_columns(), material.n_rows())
{
}

void JacobiSolver::prepare()
{
  stiffness.diagonal(inverse_diagonal);
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < inverse_diagonal.n_rows(); ++j)
      for (unsigned int i = 0; i < inverse_diagonal.n_columns(); ++i)
        {
          double &d = inverse_diagonal.row(c, j)[i];
          d         = held.is_held(c, i, j) ? 0. : 1. / d;
        }
}

void JacobiSolver::precondition(NodalField<double> &z, const NodalField<double> &r)
{
  for (std::size_t k = 0; k < r.size(); ++k)
    z.begin()[k] = inverse_diagonal.begin()[k] * r.begin()[k];
}
} // namespace mesoslip
