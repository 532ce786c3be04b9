#include "elasticity/multigrid/multigrid_solver.h"

#include "elasticity/multigrid/kernels.h"
#include "elasticity/multigrid/multigrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace mesoslip
{
namespace
{


[[noreturn]] void
fail(const std::string &what, const unsigned int iterations, const double residual)
{
  std::ostringstream text;
  text << "multigrid conjugate gradients " << what << " after " << iterations
       << " iterations at a relative residual of " << residual;
  throw NotConverged(text.str());
}
} // namespace

struct MultigridSolver::Implementation
{
  Implementation(const UniformMaterial &the_material,
                 const unsigned int the_max_iterations)
    : material(the_material)
    , stiffness(the_material)
    , preconditioner(the_material, stiffness)
    , r(the_material.n_columns(), the_material.n_rows())
    , p(r)
    , q(r)
    , b32(the_material.n_columns(), the_material.n_rows())
    , z32(b32)
    , n(multigrid::whole_vectors<float>(the_material.n_columns()))
    , max_iterations(the_max_iterations)
  {
    const Periodicity periodic = material.periodicity();
    unique_columns             = material.n_columns() - periodic.x;
    unique_rows                = material.n_rows() - periodic.y;
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
  void precondition(const double scale);
  SolverReport
  iterate(NodalField<double> &u, const double reference, const double tolerance);

  const UniformMaterial &material;
  UniformGridOperator stiffness;
  multigrid::Multigrid preconditioner;
  DofMask held;
  bool ready = false;

  /** component, column, row */
  std::vector<std::array<unsigned int, 3>> held_dofs;

  NodalField<double> r, p, q;
  NodalField<float> b32, z32;

  /** Columns in whole vectors. */
  unsigned int n;
  unsigned int max_iterations;
  unsigned int unique_columns = 0;
  unsigned int unique_rows    = 0;
};

MultigridSolver::MultigridSolver(const UniformMaterial &material,
                                 const unsigned int max_iterations)
  : implementation(std::make_unique<Implementation>(material, max_iterations))
{
}

MultigridSolver::~MultigridSolver() = default;

unsigned int MultigridSolver::n_levels() const
{
  return implementation->preconditioner.n_levels();
}

void MultigridSolver::set_held(const DofMask &mask)
{
  Implementation &s = *implementation;
  if (mask.n_columns() != s.material.n_columns() || mask.n_rows() != s.material.n_rows())
    throw std::invalid_argument("The mask of held degrees of freedom has another size "
                                "than the grid.");
  if (s.ready && mask == s.held)
    return;
  s.ready = false;
  s.held_dofs.clear();
  for (unsigned int j = 0; j < mask.n_rows(); ++j)
    for (unsigned int i = 0; i < mask.n_columns(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        if (mask.is_held(c, i, j))
          s.held_dofs.push_back({{c, i % s.unique_columns, j % s.unique_rows}});
  s.preconditioner.set_held(mask);
  s.held  = mask;
  s.ready = true;
}

/** || f - K u_held ||: the scale of the residual, whatever the first guess. */
double MultigridSolver::Implementation::right_hand_side_norm(const NodalField<double> &u,
                                                             const NodalField<double> &f)
{
  p.set_zero();
  for (const std::array<unsigned int, 3> &dof : held_dofs)
    p.row(dof[0], dof[2])[dof[1]] = u.row(dof[0], dof[2])[dof[1]];
  copy_duplicates(p);
  residual(p, f);
  preconditioner.rigid_modes().remove_from(r);
  restrict_to_unknowns(r);
  return norm(r);
}

/** z = M^-1 r; @p scale brings r into the range of single precision. */
void MultigridSolver::Implementation::precondition(const double scale)
{
  for_each_row([&](const unsigned int c, const unsigned int j) {
    multigrid::kernels().narrow(n, scale, r.row(c, j), b32.row(c, j));
  });
  preconditioner.vmult(z32, b32);
}

SolverReport MultigridSolver::solve(NodalField<double> &u,
                                    const NodalField<double> &force,
                                    const double tolerance)
{
  Implementation &s = *implementation;
  if (!s.ready)
    set_held(DofMask(s.material.n_columns(), s.material.n_rows()));
  s.copy_duplicates(u);
  const double reference = s.right_hand_side_norm(u, force);
  s.residual(u, force);
  s.preconditioner.rigid_modes().remove_from(s.r);
  s.restrict_to_unknowns(s.r);
  const SolverReport report = s.iterate(u, reference, tolerance);
  s.copy_duplicates(u);
  s.preconditioner.rigid_modes().remove_from(u);
  return report;
}

/**
 * Flexible conjugate gradients (Polak and Ribiere's beta), which do not mind that the
 * preconditioner is symmetric up to single precision only.
 */
SolverReport MultigridSolver::Implementation::iterate(NodalField<double> &u,
                                                      const double reference,
                                                      const double tolerance)
{
  SolverReport report;
  double residual_norm = norm(r), alpha = 0., rz = 0.;
  if (!std::isfinite(residual_norm) || !std::isfinite(reference))
    fail("met numbers that are not finite", 0, residual_norm);
  const double scale = reference > 0. ? reference : residual_norm;
  report.residual    = scale > 0. ? residual_norm / scale : 0.;
  while (!(report.residual <= tolerance))
    {
      if (report.iterations == max_iterations)
        fail("did not converge", report.iterations, report.residual);
      precondition(1. / residual_norm);
      double dots[2] = {0., 0.};
      for_each_row([&](const unsigned int c, const unsigned int j) {
        double row[2];
        multigrid::kernels().two_dots(n, r.row(c, j), q.row(c, j), z32.row(c, j), row);
        dots[0] += row[0];
        dots[1] += row[1];
      });
      // z is short of the factor residual_norm, which beta has to make up for.
      const double rz_new = dots[0] * residual_norm;
      const double beta =
        report.iterations == 0 ? 0. : -alpha * dots[1] * residual_norm / rz;
      rz = rz_new;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < material.n_rows(); ++j)
          multigrid::kernels().direction(n, residual_norm, beta, z32.row(c, j),
                                         p.row(c, j));
      stiffness.vmult(q, p);
      restrict_to_unknowns(q);
      double pq = 0.;
      for_each_row([&](const unsigned int c, const unsigned int j) {
        pq += multigrid::kernels().dot(n, p.row(c, j), q.row(c, j));
      });
      if (!(pq > 0.) || !std::isfinite(pq) || !(rz > 0.))
        fail("broke down", report.iterations, report.residual);
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
  return report;
}
} // namespace mesoslip
