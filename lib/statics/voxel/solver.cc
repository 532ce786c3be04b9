#include "statics/voxel/solver.h"

#include "base/flush_denormals.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip::voxel
{
namespace
{
/** The residual is computed anew when it has dropped by such a factor: single precision. A
 *  displacement that grows over the whole body (free sides), or over the many cells that an
 *  axis of a flat body has, leaves much less of the forces of cells when they cancel. */
double trusted_drop(const VoxelGrid &grid)
{
  return grid.flat || grid.sides == Sides::free ? 1e-2 : 1e-4;
}

/** What is left of the forces of a homogeneous volume, relative to those of its cells, is
 *  round-off. */
constexpr double cancelled = 1e-12;
} // namespace

/** Norm of the loads of the cells before they cancel; see outer(). */
double Solver::gross_load(const unsigned int k) const
{
  const double volume = voxels.spacing[0] * voxels.spacing[1] * voxels.spacing[2];
  double sum          = 0.;
  for (std::size_t phase = 0; phase < stiffness.size(); ++phase)
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        {
          const double stress = voxels.sides == Sides::free
                                  ? (voigt_index<3>(c, d) == k ? 1. : 0.)
                                  : stiffness[phase](voigt_index<3>(c, d), k) / modulus;
          // On each of eight nodes, or of four that have twice as much.
          const double force = stress * volume / (4. * voxels.spacing[d]);
          sum += n_cells[phase] * (voxels.flat ? 16. : 8.) * force * force;
        }
  return std::sqrt(sum);
}

/** Forces of load case @p k that nothing balances, those at held components included, and the
 *  square of their norm. */
double Solver::unbalanced(const unsigned int k,
                          VoxelField<double> &v,
                          VoxelField<float> &out,
                          double *exact)
{
  SweepArguments<double> a = sweep_arguments(voxels, work);
  a.x                      = v.data();
  a.out                    = out.data();
  a.exact                  = exact;
  a.phase                  = phases.bytes();
  a.material               = phases.words();
  a.table                  = table.data();
  const double volume      = voxels.spacing[0] * voxels.spacing[1] * voxels.spacing[2];
  if (voxels.sides == Sides::free)
    a.stress[k] = voxels.flat ? volume / 2. : volume / 4.;
  else
    a.strain[k] = voxels.flat ? 2. : 4.;
  const Cells cells = cells_of(voxels, n_coefficients);
  return sum_over_ranks(voxels, sweep_of<double>(kernels().outer, source, cells)(a));
}

/** Residual of load case @p k, and the square of its norm. */
double Solver::outer(const unsigned int k,
                     VoxelField<double> &v,
                     VoxelField<float> &out,
                     double *exact)
{
  const double square = unbalanced(k, v, out, exact);
  if (voxels.sides != Sides::mixed)
    return square;
  clear_held(voxels, out.data());
  return sum_over_ranks(voxels, kernels().dot(out.size(), out.data(), out.data()));
}

void Solver::residual(const unsigned int k,
                      VoxelField<double> &v,
                      VoxelField<double> &out)
{
  v.set_ghosts();
  outer(k, v, multigrid->finest_buffer(), out.data());
  // From the units of stress and length.
  const double unit = (voxels.sides == Sides::free ? 1. : modulus) * length * length;
  for (std::size_t i = 0; i < out.size(); ++i)
    out.data()[i] *= unit;
}

SolverReport
Solver::solve(const unsigned int k, const double tolerance, const unsigned int limit)
{
  AssertThrow(
    voxels.sides != Sides::mixed || multigrid,
    dealii::ExcMessage("hold() has to be called before mixed sides are solved."));
  SolverReport report;
  n_solved = k == voxels.load_case(n_solved) ? n_solved + 1 : 0;
  if (!multigrid)
    return report;
  const FlushDenormals flush;
  for (VoxelField<float> *field : {&r, &p, &z})
    if (field->size() == 0)
      *field = VoxelField<float>(voxels);
  if (u.size() == 0)
    u = VoxelField<double>(voxels);
  else
    std::fill_n(u.data(), u.size(), 0.);
  VoxelField<float> &q   = multigrid->finest_buffer(); // not needed across a cycle
  const double reference = std::sqrt(outer(k, u, r));
  double norm = reference, rz = 0., trusted = reference, least = reference;
  double begun =
    2. * reference;        // the residual from which the directions were last begun anew
  bool is_new      = true; // whether they begin with the next one
  const auto trust = [&]() {
    u.set_ghosts();
    trusted = norm = std::sqrt(outer(k, u, r));
    least          = std::min(least, norm);
  };
  const auto fail = [&](const std::string &what, const NotConverged::Reason reason) {
    std::ostringstream text;
    text << "conjugate gradients " << what << " after " << report.iterations
         << " iterations at a relative residual of " << report.residual;
    throw NotConverged(text.str(), reason, least / reference);
  };
  if (reference <= cancelled * gross_load(k))
    norm = 0.;
  while (norm > tolerance * reference || !std::isfinite(norm))
    {
      if (!std::isfinite(norm))
        fail("met numbers that are not finite", NotConverged::Reason::not_finite);
      if (report.iterations == limit)
        fail("did not converge", NotConverged::Reason::iterations);
      multigrid->vmult(z, r);
      const double last = rz;
      rz = sum_over_ranks(voxels, kernels().dot(r.size(), r.data(), z.data()));
      const double beta = is_new ? 0. : rz / last;
      kernels().combine(p.size(), 1.F, z.data(), static_cast<float>(beta), p.data());
      const double pq = multigrid->finest().product(p, q);
      clear_held(voxels, q.data());
      if (!(pq > 0.) || !(rz > 0.))
        {
          // Directions are lost to round-off, the displacements are not.
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
                      sum_over_ranks(voxels, kernels().step(r.size(), static_cast<float>(alpha),
                                                            p.data(), q.data(), u.data(), r.data())));
      ++report.iterations;
      if (norm <= std::max(tolerance * reference, trusted_drop(voxels) * trusted))
        trust();
      report.residual = norm / reference;
    }
  u.set_ghosts();
  if (voxels.sides == Sides::mixed)
    unbalanced(k, u, r); // other load cases move what this one holds
  keep(k);
  return report;
}

std::array<SolverReport, 6>
Solver::solve_all(const double tolerance,
                  const std::function<void(unsigned int)> &progress)
{
  std::array<SolverReport, 6> reports;
  for (unsigned int n = 0; n < voxels.n_load_cases(); ++n)
    {
      const unsigned int k = voxels.load_case(n);
      reports[k]           = solve(k, tolerance);
      if (progress)
        progress(n + 1);
    }
  return reports;
}
} // namespace mesoslip::voxel
