#include "statics/voxel/conjugate_gradients.h"

#include "base/flush_denormals.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip::voxel
{
ConjugateGradients::ConjugateGradients(const Stiffness &stiffness)
  : stiffness(stiffness)
{
}

void ConjugateGradients::release()
{
  p = VoxelField<float>();
  z = VoxelField<float>();
}

SolverReport ConjugateGradients::solve(VoxelField<double> &u,
                                       Multigrid &multigrid,
                                       const Problem &problem)
{
  const FlushDenormals flush;
  const VoxelGrid &grid = stiffness.grid;
  for (VoxelField<float> *field : {&r, &p, &z})
    if (field->size() == 0)
      *field = VoxelField<float>(grid);
  std::fill_n(p.data(), p.size(), 0.F);               // as NaN times zero is NaN
  VoxelField<float> &q   = multigrid.finest_buffer(); // free between cycles
  const double reference = std::sqrt(problem.residual(u, r));
  report                 = {};
  report.residual        = 1.;
  double norm = reference, rz = 0., trusted = reference, least = reference;
  double begun =
    2. * reference;        // residual at which the search directions were last restarted
  bool is_new      = true; // whether directions restart with the next iteration
  double round_off = 0.;   // smallest residual above round-off
  const auto trust = [&]() {
    u.set_ghosts();
    trusted = norm = std::sqrt(problem.residual(u, r));
    least          = std::min(least, norm);
    if (problem.round_off)
      round_off = problem.round_off(u);
  };
  const auto fail = [&](const std::string &what, const NotConverged::Reason reason) {
    std::ostringstream text;
    text << "conjugate gradients " << what << " after " << report.iterations
         << " iterations at a relative residual of " << report.residual;
    throw NotConverged(text.str(), reason, least / reference);
  };
  if (reference <= problem.negligible)
    norm = report.residual = 0.;
  while (norm > std::max(problem.tolerance * reference, round_off) ||
         !std::isfinite(norm))
    {
      if (!std::isfinite(norm))
        fail("met numbers that are not finite", NotConverged::Reason::not_finite);
      if (report.iterations == problem.limit)
        fail("did not converge", NotConverged::Reason::iterations);
      multigrid.vmult(z, r);
      if (problem.improve)
        problem.improve(z, r);
      const double last = rz;
      rz = sum_over_ranks(grid, kernels().dot(r.size(), r.data(), z.data()));
      const double beta = is_new ? 0. : rz / last;
      kernels().combine(p.size(), 1.F, z.data(), static_cast<float>(beta), p.data());
      const double pq = multigrid.finest().product(p, q);
      multigrid.finest().clear_held(q.data());
      if (!(pq > 0.) || !(rz > 0.))
        {
          // Round-off spoils the directions, but not the displacements.
          trust();
          report.residual = norm / reference;
          if (is_new || !(norm < 0.5 * begun))
            fail("broke down", NotConverged::Reason::broke_down);
          begun  = norm;
          is_new = true;
          continue;
        }
      is_new             = false;
      const double alpha = rz / pq;
      norm               = std::sqrt(
                      sum_over_ranks(grid, kernels().step(r.size(), static_cast<float>(alpha), p.data(),
                                                          q.data(), u.data(), r.data())));
      ++report.iterations;
      if (norm <= std::max({problem.tolerance * reference, round_off,
                            problem.trusted_drop * trusted}))
        trust();
      report.residual = norm / reference;
    }
  u.set_ghosts();
  return report;
}
} // namespace mesoslip::voxel
