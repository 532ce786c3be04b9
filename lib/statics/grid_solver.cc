#include "statics/grid_solver.h"

#include "statics/grid_preconditioners.h"
#include "statics/multigrid/kernels/kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mesoslip
{
namespace
{
/** Iterations in single precision, if it lasts that long: what takes more of them is
 * likely to suffer from round-off, and needs half as many in double precision. */
constexpr unsigned int max_single_iterations = 100;

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

struct GridSolver::Implementation
{
  Implementation(const UniformMaterial &the_material,
                 const StaticSolverKind the_kind,
                 const std::optional<unsigned int> &limit)
    : material(the_material)
    , stiffness(the_material)
    , r(the_material.n_columns(), the_material.n_rows())
    , p(r)
    , q(r)
    , n(whole_vectors<float>(the_material.n_columns()))
    , kind(the_kind)
    , max_iterations(limit.value_or(kind == StaticSolverKind::jacobi ? 100000 : 5000))
  {
    const Periodicity periodic = material.periodicity();
    unique_columns             = material.n_columns() - periodic.x;
    unique_rows                = material.n_rows() - periodic.y;
  }

  bool is_ready() const
  {
    return single || twice || diagonal;
  }

  /** Zero in held degrees of freedom and duplicates: what remains is summed once. */
  void restrict_to_unknowns(NodalField<double> &v) const
  {
    for (unsigned int c = 0; c < 2; ++c)
      {
        for (unsigned int j = 0; j < material.n_rows(); ++j)
          if (unique_columns < material.n_columns())
            v.row(c, j)[unique_columns] = 0.;
        if (unique_rows < material.n_rows())
          std::fill_n(v.row(c, unique_rows), n, 0.);
      }
    for (const std::array<unsigned int, 3> &dof : held_dofs)
      v.row(dof[0], dof[2])[dof[1]] = 0.;
  }

  void copy_duplicates(NodalField<double> &v) const
  {
    for (unsigned int c = 0; c < 2; ++c)
      {
        if (unique_columns < material.n_columns())
          for (unsigned int j = 0; j < unique_rows; ++j)
            v.row(c, j)[unique_columns] = v.row(c, j)[0];
        if (unique_rows < material.n_rows())
          std::copy_n(v.row(c, 0), material.n_columns(), v.row(c, unique_rows));
      }
  }

  /** r = f - K u in the unknowns. */
  void residual(const NodalField<double> &u, const NodalField<double> &f)
  {
    stiffness.vmult(q, u);
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < unique_rows; ++j)
        {
          const double *fr = f.row(c, j), *qr = q.row(c, j);
          double *rr = r.row(c, j);
          for (unsigned int i = 0; i < unique_columns; ++i)
            rr[i] = fr[i] - qr[i];
        }
    restrict_to_unknowns(r);
  }

  double norm(const NodalField<double> &v) const
  {
    double sum = 0.;
    for_each_row([&](const unsigned int c, const unsigned int j) {
      sum += multigrid::kernels().dot(n, v.row(c, j), v.row(c, j));
    });
    return std::sqrt(sum);
  }

  template <typename Function>
  void for_each_row(const Function &function) const
  {
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < unique_rows; ++j)
        function(c, j);
  }

  double right_hand_side_norm(const NodalField<double> &u, const NodalField<double> &f);
  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &f,
                     const double reference,
                     const double tolerance);
  template <typename Preconditioner>
  std::optional<NotConverged::Reason> iterate(Preconditioner &preconditioner,
                                              NodalField<double> &u,
                                              const double scale,
                                              const double tolerance,
                                              const unsigned int last,
                                              SolverReport &report);

  const UniformMaterial &material;
  UniformGridOperator stiffness;
  DofMask held;
  multigrid::RigidModes modes;
  /** Of the three there is one; none before set_held(). */
  std::unique_ptr<MultigridCycle<float>> single;
  std::unique_ptr<MultigridCycle<double>> twice;
  std::unique_ptr<Diagonal> diagonal;

  /** component, column, row */
  std::vector<std::array<unsigned int, 3>> held_dofs;

  NodalField<double> r, p, q;

  /** Columns in whole vectors. */
  unsigned int n;
  const StaticSolverKind kind;
  const unsigned int max_iterations;
  unsigned int unique_columns = 0;
  unsigned int unique_rows    = 0;
};

GridSolver::GridSolver(const UniformMaterial &material,
                       const StaticSolverKind kind,
                       const std::optional<unsigned int> &max_iterations)
  : implementation(std::make_unique<Implementation>(material, kind, max_iterations))
{
}

GridSolver::~GridSolver() = default;

unsigned int GridSolver::n_levels() const
{
  const Implementation &s = *implementation;
  return s.single ? s.single->cycle.n_levels() : s.twice->cycle.n_levels();
}

void GridSolver::set_held(const DofMask &mask)
{
  Implementation &s = *implementation;
  if (mask.n_columns() != s.material.n_columns() || mask.n_rows() != s.material.n_rows())
    throw std::invalid_argument("The mask of held degrees of freedom has another size "
                                "than the grid.");
  if (s.is_ready() && mask == s.held)
    return;
  s.held_dofs.clear();
  for (unsigned int j = 0; j < mask.n_rows(); ++j)
    for (unsigned int i = 0; i < mask.n_columns(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        if (mask.is_held(c, i, j))
          s.held_dofs.push_back({{c, i % s.unique_columns, j % s.unique_rows}});
  s.held  = mask;
  s.modes = multigrid::RigidModes(s.material, mask);
  s.twice.reset();
  if (s.kind == StaticSolverKind::jacobi)
    s.diagonal = std::make_unique<Diagonal>(s.stiffness, mask);
  else if (s.single)
    s.single->cycle.set_held(mask);
  else
    s.single = std::make_unique<MultigridCycle<float>>(s.material, s.stiffness, mask);
}

/** || f - K u_held ||: the scale of the residual, whatever the first guess. */
double GridSolver::Implementation::right_hand_side_norm(const NodalField<double> &u,
                                                        const NodalField<double> &f)
{
  p.set_zero();
  for (const std::array<unsigned int, 3> &dof : held_dofs)
    p.row(dof[0], dof[2])[dof[1]] = u.row(dof[0], dof[2])[dof[1]];
  copy_duplicates(p);
  residual(p, f);
  modes.remove_from(r);
  restrict_to_unknowns(r);
  return norm(r);
}

SolverReport GridSolver::solve(NodalField<double> &u,
                               const NodalField<double> &force,
                               const double tolerance)
{
  Implementation &s = *implementation;
  if (!s.is_ready())
    set_held(DofMask(s.material.n_columns(), s.material.n_rows()));
  const double reference    = s.right_hand_side_norm(u, force);
  const SolverReport report = s.solve(u, force, reference, tolerance);
  s.copy_duplicates(u);
  s.modes.remove_from(u);
  return report;
}

SolverReport GridSolver::Implementation::solve(NodalField<double> &u,
                                               const NodalField<double> &f,
                                               const double reference,
                                               const double tolerance)
{
  SolverReport report;
  if (twice)
    report.single_iterations = 0;
  while (true)
    {
      copy_duplicates(u);
      residual(u, f);
      modes.remove_from(r);
      restrict_to_unknowns(r);
      const double scale = reference > 0. ? reference : norm(r);
      const auto failure =
        diagonal ? iterate(*diagonal, u, scale, tolerance, max_iterations, report)
        : single ? iterate(*single, u, scale, tolerance,
                           std::min(max_single_iterations, max_iterations), report)
                 : iterate(*twice, u, scale, tolerance, max_iterations, report);
      if (!failure)
        return report;
      if (!single || *failure == NotConverged::Reason::not_finite ||
          report.iterations == max_iterations)
        throw NotConverged(failure_text(*failure, report), *failure);
      single.reset();
      twice = std::make_unique<MultigridCycle<double>>(material, stiffness, held);
      report.single_iterations = report.iterations;
    }
}

/**
 * Flexible conjugate gradients (Polak and Ribiere's beta), which do not mind that the
 * preconditioner is symmetric up to its precision only, until the number @p last of
 * iterations in all. Returns why it ended before the tolerance was met.
 */
template <typename Preconditioner>
std::optional<NotConverged::Reason>
GridSolver::Implementation::iterate(Preconditioner &preconditioner,
                                    NodalField<double> &u,
                                    const double scale,
                                    const double tolerance,
                                    const unsigned int last,
                                    SolverReport &report)
{
  using Reason                                  = NotConverged::Reason;
  using Number                                  = typename Preconditioner::Number;
  const multigrid::GridKernels<Number> &kernels = multigrid::grid_kernels<Number>();
  NodalField<Number> &z                         = preconditioner.z;
  double residual_norm = norm(r), alpha = 0., rz = 0.;
  if (!std::isfinite(residual_norm) || !std::isfinite(scale))
    return Reason::not_finite;
  report.residual = scale > 0. ? residual_norm / scale : 0.;
  while (!(report.residual <= tolerance))
    {
      if (report.iterations == last)
        return Reason::iterations;
      // One over the norm brings r into the range of single precision.
      for_each_row([&](const unsigned int c, const unsigned int j) {
        kernels.scaled(n, 1. / residual_norm, r.row(c, j), preconditioner.b.row(c, j));
      });
      preconditioner.apply();
      double dots[2] = {0., 0.};
      for_each_row([&](const unsigned int c, const unsigned int j) {
        double row[2];
        kernels.two_dots(n, r.row(c, j), q.row(c, j), z.row(c, j), row);
        dots[0] += row[0];
        dots[1] += row[1];
      });
      // z is short of the factor residual_norm, which beta has to make up for.
      const double rz_new = dots[0] * residual_norm;
      const double beta   = alpha == 0. ? 0. : -alpha * dots[1] * residual_norm / rz;
      rz                  = rz_new;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < material.n_rows(); ++j)
          kernels.direction(n, residual_norm, beta, z.row(c, j), p.row(c, j));
      copy_duplicates(p);
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
