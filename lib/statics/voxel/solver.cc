#include "statics/voxel/solver.h"

#include "statics/flush_denormals.h"
#include "statics/voxel/brick_matrices.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip::voxel
{
namespace
{
/** The phase of what lies outside of the body. */
constexpr unsigned int outside = 255;
/** Ratio of stiffness beyond which smoothing pays. */
constexpr double strong_ratio = 30.;
/** The residual is computed anew when it has dropped by this factor: single precision. */
constexpr double trusted_drop = 1e-4;

/** Largest over smallest entry of the diagonals among the phases that occur: grows with the
 *  contrast and where a phase is nearly incompressible. */
double stiffness_ratio(const PhaseMap<3> &map,
                       const std::vector<VoigtMatrix<3>> &stiffness)
{
  std::array<bool, 256> occurs = {};
  for (const std::uint8_t id : map.id)
    occurs[id] = true;
  double smallest = 1e300, largest = 0.;
  for (std::size_t phase = 0; phase < stiffness.size(); ++phase)
    if (occurs[phase])
      for (unsigned int m = 0; m < 6; ++m)
        {
          smallest = std::min(smallest, stiffness[phase](m, m));
          largest  = std::max(largest, stiffness[phase](m, m));
        }
  return largest / smallest;
}

Multigrid::Options options_for(const double ratio)
{
  if (ratio < strong_ratio)
    return {{2, 1. / 10.}, 2, 8};
  return {{4, 1. / 20.}, 4, 32};
}
} // namespace

Solver::Solver(const PhaseMap<3> &map,
               const std::vector<VoigtMatrix<3>> &the_stiffness,
               const Sides sides)
  : stiffness(the_stiffness)
{
  if (map.id.size() != map.grid.n_cells() || map.id.empty())
    throw std::invalid_argument("The map has another number of phases than of cells.");
  const unsigned int last = *std::max_element(map.id.begin(), map.id.end());
  if (last >= stiffness.size() || last >= outside)
    throw std::invalid_argument("A cell has a phase without a stiffness.");
  modulus = length = 0.;
  n_coefficients   = n_isotropic;
  for (unsigned int phase = 0; phase <= last; ++phase)
    {
      modulus = std::max(modulus, stiffness[phase].cwiseAbs().maxCoeff());
      if (!is_isotropic(stiffness[phase]))
        n_coefficients = n_general;
    }
  for (const std::uint8_t id : map.id)
    mean_stiffness += stiffness[id] / modulus;
  mean_stiffness /= static_cast<double>(map.id.size());
  length       = map.grid.spacing[1];
  voxels.cells = map.grid.cells;
  voxels.sides = sides;
  for (unsigned int d = 0; d < 3; ++d)
    voxels.spacing[d] = map.grid.spacing[d] / length;
  for (unsigned int d = 0; d < 3; ++d)
    if (voxels.n_nodes(d) == 0)
      return; // no unknowns
  set_phases(map);
  build_multigrid(map);
}

/** Fields by phase and the table for the residual in double precision. */
void Solver::set_phases(const PhaseMap<3> &map)
{
  const std::size_t stride = voxels.stride();
  phases.assign(voxels.n_cell_rows() * stride, outside);
  const auto row = [&](const std::size_t j, const std::size_t k) {
    return phases.data() + (k * (voxels.n_nodes(1) + 1) + j) * stride;
  };
  // Numbers of cells in a field, ghosts included, and of those in the map.
  const auto cell = [&](const std::size_t number, const unsigned int axis) {
    const std::size_t n = voxels.cells[axis];
    return voxels.sides == Sides::periodic ? (number + n - 1) % n
                                           : number - voxels.first();
  };
  for (std::size_t k = 0; k <= voxels.n_nodes(2); ++k)
    for (std::size_t j = 0; j <= voxels.n_nodes(1); ++j)
      for (std::size_t i = 0; i <= voxels.n_nodes(0); ++i)
        {
          const std::array<unsigned int, 3> &n = voxels.cells;
          const std::array<std::size_t, 3> at  = {{cell(i, 0), cell(j, 1), cell(k, 2)}};
          if (at[0] < n[0] && at[1] < n[1] && at[2] < n[2])
            row(j, k)[i] = map.id[(at[2] * n[1] + at[1]) * n[0] + at[0]];
        }
  table.assign(std::size_t{256} * (n_coefficients + 1), 0.);
  for (unsigned int phase = 0; phase < std::min<std::size_t>(stiffness.size(), outside);
       ++phase)
    {
      const std::vector<double> c = coefficients_of(stiffness[phase], n_coefficients);
      for (unsigned int m = 0; m < n_coefficients; ++m)
        table[m * 256 + phase] = c[m] / modulus * voxels.factor();
      table[n_coefficients * 256 + phase] = 1.;
    }
}

void Solver::build_multigrid(const PhaseMap<3> &map)
{
  const std::size_t stride = voxels.stride();
  CellStiffness cells;
  cells.n_coefficients = n_coefficients;
  cells.numbers.resize(voxels.n_cell_rows() * n_coefficients * stride);
  for (std::size_t row = 0; row < voxels.n_cell_rows(); ++row)
    for (unsigned int m = 0; m < n_coefficients; ++m)
      for (std::size_t i = 0; i < stride; ++i)
        cells.numbers[(row * n_coefficients + m) * stride + i] =
          static_cast<float>(table[m * 256 + phases[row * stride + i]]);
  multigrid = std::make_unique<Multigrid>(voxels, std::move(cells),
                                          options_for(stiffness_ratio(map, stiffness)));
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
  return kernels().outer[n_coefficients == n_general](a);
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
  while (norm > tolerance * reference || !std::isfinite(norm))
    {
      if (!std::isfinite(norm))
        fail("met numbers that are not finite", NotConverged::Reason::not_finite);
      if (report.iterations == limit)
        fail("did not converge", NotConverged::Reason::iterations);
      multigrid->vmult(z, r);
      double dots[2];
      kernels().two_dots(r.size(), r.data(), q.data(), z.data(), dots);
      const double beta = alpha == 0. ? 0. : -alpha * dots[1] / rz;
      rz                = dots[0];
      kernels().combine(p.size(), 1.F, z.data(), static_cast<float>(beta), p.data());
      const double pq = multigrid->finest().product(p, q);
      if (!(pq > 0.) || !(rz > 0.))
        fail("broke down", NotConverged::Reason::broke_down);
      alpha = rz / pq;
      norm  = std::sqrt(kernels().step(r.size(), static_cast<float>(alpha), p.data(),
                                       q.data(), u[k].data(), r.data()));
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
      corrections(l, k) = kernels().mixed_dot(r.size(), r.data(), u[l].data());
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
          (kernels().double_dot(force.size(), force.data(), u[l].data()) +
           corrections(k, l)) /
          volume;
    }
  if (voxels.sides == Sides::free)
    return work_of_loads.inverse() * modulus;
  return (mean_stiffness - work_of_loads) * modulus;
}

double Solver::fluctuation(const unsigned int k,
                           const unsigned int c,
                           const std::array<unsigned int, 3> &node) const
{
  if (!multigrid)
    return 0.;
  const unsigned int first = voxels.first();
  const double unit        = voxels.sides == Sides::free ? length / modulus : length;
  return u[k].row(c, node[1] + first, node[2] + first)[node[0] + first] * unit;
}

VoigtVector<3> Solver::cell_strain(const unsigned int k,
                                   const std::array<unsigned int, 3> &cell) const
{
  VoigtVector<3> strain = VoigtVector<3>::Zero();
  for (unsigned int corner = 0; corner < 8; ++corner)
    for (unsigned int c = 0; c < 3; ++c)
      {
        const double value =
          fluctuation(k, c,
                      {{cell[0] + (corner & 1U), cell[1] + (corner >> 1 & 1U),
                        cell[2] + (corner >> 2)}});
        for (unsigned int d = 0; d < 3; ++d)
          strain[voigt_index<3>(c, d)] += ((corner >> d & 1U) != 0 ? value : -value) /
                                          (4. * voxels.spacing[d] * length);
      }
  if (voxels.sides != Sides::free)
    strain[k] += 1.;
  return strain;
}
} // namespace mesoslip::voxel
