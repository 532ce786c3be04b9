#include "body/brick_solver.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
constexpr unsigned int most_iterations = 5000;
} // namespace

/**
 * Flexible conjugate gradients (Polak-Ribiere beta) from the current correction on, with
 * the same preconditioner.
 */
void BrickSolver::iterate_in_double(const voxel::ConjugateGradients::Problem &problem,
                                    SolverReport &report)
{
  Field r(K.grid), p(K.grid);
  voxel::VoxelField<float> z(K.grid), &b = iteration.r;
  const auto for_each = [this](const auto &action) {
    for_each_row(K.grid,
                 [&](const unsigned int c, const unsigned int j, const unsigned int k) {
                   for (unsigned int i = 1; i <= K.grid.n_nodes(0); ++i)
                     action(c, j, k, i);
                 });
  };
  const auto dot_with_z = [&](const Field &field) {
    double sum = 0.;
    for_each([&](unsigned int c, unsigned int j, unsigned int k, unsigned int i) {
      sum += field.row(c, j, k)[i] * z.row(c, j, k)[i];
    });
    return sum_over_ranks(K.grid, sum);
  };
  correction.set_ghosts();
  double norm  = std::sqrt(unbalanced(correction, multigrid->finest_buffer()));
  r            = product;
  double alpha = 0., rz = 0.;
  const auto fail = [&](const char *what, const NotConverged::Reason reason) {
    throw NotConverged(brief_text(6, "conjugate gradients ", what, " after ",
                                  report.iterations,
                                  " iterations at a relative residual of ", norm),
                       reason, norm);
  };
  while (!(norm <= std::max(problem.tolerance, problem.round_off(correction))))
    {
      if (!std::isfinite(norm))
        fail("met numbers that are not finite", NotConverged::Reason::not_finite);
      if (report.iterations == most_iterations)
        fail("did not converge", NotConverged::Reason::iterations);
      std::fill_n(b.data(), b.size(), 0.F);
      for_each([&](unsigned int c, unsigned int j, unsigned int k, unsigned int i) {
        b.row(c, j, k)[i] = static_cast<float>(r.row(c, j, k)[i] / norm);
      });
      multigrid->vmult(z, b);
      if (problem.improve)
        problem.improve(z, b);
      // The product of the previous step gives the change of the residual.
      const double beta = alpha == 0. ? 0. : alpha * norm * dot_with_z(product) / rz;
      rz                = norm * dot_with_z(r);
      for_each([&](unsigned int c, unsigned int j, unsigned int k, unsigned int i) {
        double &x = p.row(c, j, k)[i];
        x         = norm * z.row(c, j, k)[i] + beta * x;
      });
      p.set_ghosts();
      take_forces(p, multigrid->finest_buffer());
      double pq = 0.;
      for_each([&](unsigned int c, unsigned int j, unsigned int k, unsigned int i) {
        pq -= p.row(c, j, k)[i] * product.row(c, j, k)[i];
      });
      pq = sum_over_ranks(K.grid, pq);
      if (!(pq > 0.) || !(rz > 0.))
        fail("broke down", NotConverged::Reason::broke_down);
      alpha = rz / pq;
      for_each([&](unsigned int c, unsigned int j, unsigned int k, unsigned int i) {
        correction.row(c, j, k)[i] += alpha * p.row(c, j, k)[i];
        r.row(c, j, k)[i] += alpha * product.row(c, j, k)[i];
      });
      norm = std::sqrt(square_of(r));
      ++report.iterations;
    }
  report.residual = norm;
}
} // namespace mesoslip
