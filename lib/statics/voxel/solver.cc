#include "statics/voxel/solver.h"

#include "statics/flush_denormals.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip::voxel
{
namespace
{
/** The residual is computed anew when it has dropped by this factor: single precision. */
constexpr double trusted_drop = 1e-4;

/** What is left of the forces of a homogeneous volume, relative to those of its cells, is
 *  round-off. */
constexpr double cancelled = 1e-12;

/** Adds the mean strains of a row of cells from component @p c along four rows of nodes,
 *  numbered by y and 2 z; @p unit is 1 / (4 h). */
void add_strains(const double *const at[4],
                 const double unit[3],
                 const double factor,
                 const unsigned int c,
                 std::array<std::vector<double>, 6> &strain)
{
  double *out[3];
  for (unsigned int d = 0; d < 3; ++d)
    out[d] = strain[voigt_index<3>(c, d)].data();
  const double x = factor * unit[0], y = factor * unit[1], z = factor * unit[2];
  const std::size_t n = strain[0].size();
  for (std::size_t i = 0; i < n; ++i)
    {
      const double n0 = at[0][i] + at[0][i + 1], n1 = at[1][i] + at[1][i + 1],
                   n2 = at[2][i] + at[2][i + 1], n3 = at[3][i] + at[3][i + 1];
      out[0][i] += x * (at[0][i + 1] - at[0][i] + at[1][i + 1] - at[1][i] + at[2][i + 1] -
                        at[2][i] + at[3][i + 1] - at[3][i]);
      out[1][i] += y * (n1 - n0 + n3 - n2);
      out[2][i] += z * (n2 - n0 + n3 - n1);
    }
}

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
          const double force  = stress * volume / (4. * voxels.spacing[d]);
          sum += n_cells[phase] * 8. * force * force;
        }
  return std::sqrt(sum);
}

/** Residual of load case @p k, and the square of its norm. */
double Solver::outer(const unsigned int k,
                     VoxelField<double> &v,
                     VoxelField<float> &out,
                     double *exact)
{
  SweepArguments<double> a = sweep_arguments(voxels, work);
  a.x                      = v.data();
  a.out                    = out.data();
  a.exact                  = exact;
  a.phase                  = phases.data();
  a.table                  = table.data();
  const double volume      = voxels.spacing[0] * voxels.spacing[1] * voxels.spacing[2];
  if (voxels.sides == Sides::free)
    a.stress[k] = volume / 4.;
  else
    a.strain[k] = 4.;
  return sum_over_ranks(voxels, kernels().outer[n_coefficients == n_general](a));
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
  SolverReport report;
  n_solved = k == n_solved ? k + 1 : 0;
  if (!multigrid)
    return report;
  const FlushDenormals flush;
  for (VoxelField<float> *field : {&r, &p, &q, &z})
    if (field->size() == 0)
      *field = VoxelField<float>(voxels);
  u[k]                   = VoxelField<double>(voxels);
  const double reference = std::sqrt(outer(k, u[k], r));
  double norm = reference, alpha = 0., rz = 0., trusted = reference;
  const auto fail = [&](const std::string &what, const NotConverged::Reason reason) {
    std::ostringstream text;
    text << "conjugate gradients " << what << " after " << report.iterations
         << " iterations at a relative residual of " << report.residual;
    throw NotConverged(text.str(), reason);
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
      double dots[2];
      kernels().two_dots(r.size(), r.data(), q.data(), z.data(), dots);
      sum_over_ranks(voxels, dots, 2);
      const double beta = alpha == 0. ? 0. : -alpha * dots[1] / rz;
      rz                = dots[0];
      kernels().combine(p.size(), 1.F, z.data(), static_cast<float>(beta), p.data());
      const double pq = multigrid->finest().product(p, q);
      if (!(pq > 0.) || !(rz > 0.))
        fail("broke down", NotConverged::Reason::broke_down);
      alpha = rz / pq;
      norm  = std::sqrt(sum_over_ranks(
         voxels, kernels().step(r.size(), static_cast<float>(alpha), p.data(), q.data(),
                                u[k].data(), r.data())));
      ++report.iterations;
      if (norm <= std::max(tolerance * reference, trusted_drop * trusted))
        {
          u[k].set_ghosts();
          trusted = norm = std::sqrt(outer(k, u[k], r));
        }
      report.residual = norm / reference;
    }
  u[k].set_ghosts();
  for (unsigned int l = 0; l <= k; ++l)
    if (u[l].size() == r.size())
      corrections(l, k) =
        sum_over_ranks(voxels, kernels().mixed_dot(r.size(), r.data(), u[l].data()));
  return report;
}

std::array<SolverReport, 6>
Solver::solve_all(const double tolerance,
                  const std::function<void(unsigned int)> &progress)
{
  std::array<SolverReport, 6> reports;
  for (unsigned int k = 0; k < 6; ++k)
    {
      reports[k] = solve(k, tolerance);
      if (progress)
        progress(k + 1);
    }
  return reports;
}

VoigtMatrix<3> Solver::effective_stiffness()
{
  AssertThrow(n_solved == 6, dealii::ExcMessage("All load cases have to be solved."));
  if (!multigrid)
    return mean_stiffness * modulus;
  const double volume = voxels.spacing[0] * voxels.spacing[1] * voxels.spacing[2] *
                        voxels.cells[0] * voxels.cells[1] * voxels.cells[2];
  // In the place of what the next solve makes anew.
  r = p = q = z = VoxelField<float>();
  VoxelField<double> zero(voxels), force(voxels);
  VoxelField<float> &unused    = multigrid->finest_buffer();
  VoigtMatrix<3> work_of_loads = VoigtMatrix<3>::Zero();
  for (unsigned int k = 0; k < 6; ++k)
    {
      outer(k, zero, unused, force.data());
      for (unsigned int l = k; l < 6; ++l)
        work_of_loads(k, l) = work_of_loads(l, k) =
          (sum_over_ranks(voxels,
                          kernels().double_dot(force.size(), force.data(), u[l].data())) +
           corrections(k, l)) /
          volume;
    }
  if (voxels.sides == Sides::free)
    return work_of_loads.inverse() * modulus;
  return (mean_stiffness - work_of_loads) * modulus;
}

void Solver::evaluate(const unsigned int j, const unsigned int k, RowOfCells &row) const
{
  const unsigned int n = voxels.cells[0], plane = k + voxels.first_cell_plane(),
                     line = j + voxels.first();
  row.phase =
    &phases[((std::size_t{voxels.n_nodes(1)} + 1) * plane + line) * voxels.stride() +
            voxels.first()];
  const bool free      = voxels.sides == Sides::free;
  const double unit[3] = {0.25 / voxels.spacing[0], 0.25 / voxels.spacing[1],
                          0.25 / voxels.spacing[2]};
  for (unsigned int load = 0; load < 6; ++load)
    {
      for (unsigned int m = 0; m < 6; ++m)
        row.strain[load][m].assign(n, !free && m == load ? 1. : 0.);
      for (unsigned int c = 0; multigrid && c < 3; ++c)
        {
          const double *at[4];
          for (unsigned int corner = 0; corner < 4; ++corner)
            at[corner] = u[load].row(c, line + (corner & 1U), plane + (corner >> 1)) +
                         voxels.first();
          add_strains(at, unit, free ? 1. / modulus : 1., c, row.strain[load]);
        }
    }
}
} // namespace mesoslip::voxel
