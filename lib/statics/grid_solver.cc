#include "statics/grid_solver.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Largest number of iterations in single precision: more iterations indicate round-off,
 * and double precision needs half as many. */
constexpr unsigned int max_single_iterations = 100;

UniformMaterial to_precondition(const UniformMaterial &material)
{
  std::vector<ElasticPhase<2>> phases = material.phases();
  for (ElasticPhase<2> &phase : phases)
    phase = phase_to_precondition(phase);
  return material.with_phases(phases);
}

std::string failure_text(const NotConverged::Reason reason, const SolverReport &report)
{
  using Reason = NotConverged::Reason;
  std::ostringstream text;
  text << "conjugate gradients ";
  if (reason == Reason::not_finite)
    text << "met numbers that are not finite";
  else
    text << (reason == Reason::broke_down ? "broke down" : "did not converge")
         << " after " << report.iterations << " iterations at a relative residual of "
         << report.residual;
  return text.str();
}
} // namespace

GridSolver::GridSolver(const UniformMaterial &material,
                       const StaticSolverKind kind,
                       const std::optional<unsigned int> &limit)
  : material(material)
  , use_diagonal(kind == StaticSolverKind::jacobi ||
                 !multigrid::Multigrid<float>::can_coarsen(material.grid()))
  , max_iterations(limit.value_or(use_diagonal ? 100000 : 5000))
  , unique_columns(material.n_columns() - material.periodicity().x)
  , unique_rows(material.n_rows() - material.periodicity().y)
  , n(whole_vectors<float>(material.n_columns()))
  , stiffness(material)
  , gentle(to_precondition(material))
  , gentle_stiffness(gentle)
  , r(material.n_columns(), material.n_rows())
  , p(r)
  , q(r)
{
}

void GridSolver::set_constrained(const DofMask &new_mask)
{
  if (new_mask.n_columns() != material.n_columns() ||
      new_mask.n_rows() != material.n_rows())
    throw std::invalid_argument("The mask of constrained degrees of freedom has another "
                                "size than the grid.");
  if ((single || twice || diagonal) && new_mask == mask)
    return;
  mask        = new_mask;
  constrained = multigrid::ConstrainedUnknowns(
    mask,
    multigrid::Axis::uniform(material.grid().cells[0], 1., material.periodicity().x),
    multigrid::Axis::uniform(material.grid().cells[1], 1., material.periodicity().y));
  modes = multigrid::RigidModes(material, mask);
  twice.reset();
  if (use_diagonal)
    diagonal = std::make_unique<Diagonal>(stiffness, mask);
  else if (single)
    single->multigrid.set_constrained(mask);
  else
    single = std::make_unique<Cycle<float>>(gentle, gentle_stiffness, mask);
}

template <typename Function>
void GridSolver::for_each_row(const Function &function) const
{
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < unique_rows; ++j)
      function(c, j);
}

/** Zero in constrained degrees of freedom and periodic copies, so that sums count each
 * unknown once. */
void GridSolver::restrict_to_unknowns(NodalField<double> &v) const
{
  for (unsigned int c = 0; c < 2; ++c)
    {
      for (unsigned int j = 0; j < material.n_rows(); ++j)
        if (unique_columns < material.n_columns())
          v.row(c, j)[unique_columns] = 0.;
      if (unique_rows < material.n_rows())
        std::fill_n(v.row(c, unique_rows), n, 0.);
    }
  constrained.clear(v, 2);
}

/** r = f - K u in the unknowns, without rigid motions; its norm. */
double GridSolver::residual(const NodalField<double> &u, const NodalField<double> &f)
{
  stiffness.vmult(q, u);
  for_each_row([&](const unsigned int c, const unsigned int j) {
    for (unsigned int i = 0; i < unique_columns; ++i)
      r.row(c, j)[i] = f.row(c, j)[i] - q.row(c, j)[i];
  });
  restrict_to_unknowns(r);
  modes.remove_from(r);
  restrict_to_unknowns(r);
  return norm(r);
}

double GridSolver::norm(const NodalField<double> &v) const
{
  double sum = 0.;
  for_each_row([&](const unsigned int c, const unsigned int j) {
    sum += multigrid::kernels().dot(n, v.row(c, j), v.row(c, j));
  });
  return std::sqrt(sum);
}

/** || f - K u_constrained ||: scale of the residual, independent of the initial guess. */
double GridSolver::right_hand_side_norm(const NodalField<double> &u,
                                        const NodalField<double> &f)
{
  p.set_zero();
  for (unsigned int j = 0; j < unique_rows; ++j)
    for (const multigrid::ConstrainedUnknowns::Node &node : constrained.row(j))
      for (unsigned int c = 0; c < 2; ++c)
        if (node.has(c))
          p.row(c, j)[node.column] = u.row(c, j)[node.column];
  material.update_copies(p);
  return residual(p, f);
}

SolverReport GridSolver::solve(NodalField<double> &u,
                               const NodalField<double> &force,
                               const double tolerance)
{
  if (!single && !twice && !diagonal)
    set_constrained(DofMask(material.n_columns(), material.n_rows()));
  const double reference = right_hand_side_norm(u, force);
  SolverReport report;
  if (twice)
    report.single_iterations = 0;
  while (true)
    {
      material.update_copies(u);
      const double start = residual(u, force);
      const double scale = reference > 0. ? reference : start;
      const auto failure =
        diagonal ? iterate(*diagonal, u, scale, tolerance, max_iterations, report)
        : single ? iterate(*single, u, scale, tolerance,
                           std::min(max_single_iterations, max_iterations), report)
                 : iterate(*twice, u, scale, tolerance, max_iterations, report);
      if (!failure)
        break;
      if (!single || *failure == NotConverged::Reason::not_finite ||
          report.iterations == max_iterations)
        throw NotConverged(failure_text(*failure, report), *failure, report.residual);
      single.reset();
      twice = std::make_unique<Cycle<double>>(gentle, gentle_stiffness, mask);
      report.single_iterations = report.iterations;
    }
  material.update_copies(u);
  modes.remove_from(u);
  return report;
}

/**
 * Flexible conjugate gradients (Polak and Ribiere's beta), which tolerate a
 * preconditioner that is symmetric only up to its precision, until iteration number
 * @p last in total.
 * @return the reason if the tolerance was not met
 */
template <typename Preconditioner>
std::optional<NotConverged::Reason> GridSolver::iterate(Preconditioner &preconditioner,
                                                        NodalField<double> &u,
                                                        const double scale,
                                                        const double tolerance,
                                                        const unsigned int last,
                                                        SolverReport &report)
{
  using Reason                = NotConverged::Reason;
  using Number                = typename Preconditioner::Number;
  const auto &k               = multigrid::grid_kernels<Number>();
  const NodalField<Number> &z = preconditioner.z;
  double residual_norm = norm(r), alpha = 0., rz = 0.;
  if (!std::isfinite(residual_norm) || !std::isfinite(scale))
    return Reason::not_finite;
  report.residual = scale > 0. ? residual_norm / scale : 0.;
  while (!(report.residual <= tolerance))
    {
      if (report.iterations == last)
        return Reason::iterations;
      // Scaling by the norm brings r into the range of single precision.
      for_each_row([&](const unsigned int c, const unsigned int j) {
        k.scaled(n, 1. / residual_norm, r.row(c, j), preconditioner.b.row(c, j));
      });
      preconditioner.apply();

      double dots[2] = {0., 0.};
      for_each_row([&](const unsigned int c, const unsigned int j) {
        double row[2];
        k.two_dots(n, r.row(c, j), q.row(c, j), z.row(c, j), row);
        dots[0] += row[0];
        dots[1] += row[1];
      });
      // z lacks the factor residual_norm, which beta has to compensate.
      const double rz_new = dots[0] * residual_norm;
      const double beta   = alpha == 0. ? 0. : -alpha * dots[1] * residual_norm / rz;
      rz                  = rz_new;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < material.n_rows(); ++j)
          k.direction(n, residual_norm, beta, z.row(c, j), p.row(c, j));
      material.update_copies(p);

      stiffness.vmult(q, p);
      restrict_to_unknowns(q);
      double pq = 0.;
      for_each_row([&](const unsigned int c, const unsigned int j) {
        pq += multigrid::kernels().dot(n, p.row(c, j), q.row(c, j));
      });
      if (!(pq > 0.) || !std::isfinite(pq) || !(rz > 0.))
        return Reason::broke_down;
      alpha      = rz / pq;
      double sum = 0.;
      for_each_row([&](const unsigned int c, const unsigned int j) {
        sum += multigrid::kernels().step(n, alpha, p.row(c, j), q.row(c, j), u.row(c, j),
                                         r.row(c, j));
      });
      residual_norm   = std::sqrt(sum);
      report.residual = residual_norm / scale;
      ++report.iterations;
    }
  return {};
}
} // namespace mesoslip
