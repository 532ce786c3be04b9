#include "elasticity/uniform_material.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace mesoslip
{
namespace
{
/** Padding of phase rows: kernels read a whole vector of phases beyond the last cell. */
constexpr std::size_t phase_padding = 64;

void check(const ElasticPhase<2> &phase, const unsigned int k)
{
  const std::string name  = "phase " + std::to_string(k);
  const VoigtMatrix<2> &D = phase.stiffness;
  const double largest    = D.cwiseAbs().maxCoeff();
  if (!(phase.density > 0.) || !std::isfinite(phase.density))
    throw std::invalid_argument(name + ": the density must be positive, not " +
                                std::to_string(phase.density));
  if (!D.allFinite() || !((D - D.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * largest))
    throw std::invalid_argument(name + ": the stiffness must be finite and symmetric");
  if (Eigen::LLT<VoigtMatrix<2>>(D).info() != Eigen::Success)
    throw std::invalid_argument(name + ": the stiffness must be positive definite");
}
} // namespace

Eigen::Matrix2d hourglass_stiffness(const ElasticPhase<2> &phase,
                                    const std::array<double, 2> &h)
{
  const VoigtMatrix<2> D = phase.stiffness_about_mean();
  const double xx = h[0] * h[0], yy = h[1] * h[1], mixed = D(0, 2) / xx + D(1, 2) / yy;
  Eigen::Matrix2d H;
  H << D(0, 0) / xx + D(2, 2) / yy, mixed, mixed, D(1, 1) / yy + D(2, 2) / xx;
  return H;
}

Eigen::Matrix<double, 8, 8> cell_stiffness(const ElasticPhase<2> &phase,
                                           const std::array<double, 2> &h)
{
  Eigen::Matrix<double, 3, 8> B = Eigen::Matrix<double, 3, 8>::Zero();
  Eigen::Matrix<double, 2, 8> G = Eigen::Matrix<double, 2, 8>::Zero();
  for (Eigen::Index n = 0; n < 4; ++n)
    {
      const double x = n % 2 ? 1. : -1., y = n / 2 ? 1. : -1.;
      B(0, 2 * n) = B(2, 2 * n + 1) = x / (2. * h[0]);
      B(1, 2 * n + 1) = B(2, 2 * n) = y / (2. * h[1]);
      G(0, 2 * n) = G(1, 2 * n + 1) = x * y;
    }
  return h[0] * h[1] *
         (B.transpose() * phase.stiffness * B +
          G.transpose() * hourglass_stiffness(phase, h) * G / 12.);
}

UniformMaterial::UniformMaterial(const UniformGrid<2> &grid,
                                 const std::vector<ElasticPhase<2>> &phases,
                                 const std::vector<std::uint8_t> &phase_id,
                                 const Periodicity periodicity)
  : the_grid(grid)
  , the_phases(phases)
  , periodic(periodicity)
{
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  if (nx == 0 || ny == 0 || !(grid.spacing[0] > 0.) || !(grid.spacing[1] > 0.))
    throw std::invalid_argument("a uniform grid needs cells of positive size");
  if (!phase_id.empty() && phase_id.size() != grid.n_cells())
    throw std::invalid_argument("the grid has " + std::to_string(grid.n_cells()) +
                                " cells but " + std::to_string(phase_id.size()) +
                                " phases were given");
  std::set<unsigned int> used(phase_id.begin(), phase_id.end());
  if (used.empty())
    used = {0};
  occurring.assign(used.begin(), used.end());
  if (occurring.back() >= phases.size())
    throw std::invalid_argument("a cell is of phase " + std::to_string(occurring.back()) +
                                " but only " + std::to_string(phases.size()) +
                                " phases are defined");
  for (const unsigned int k : occurring)
    check(phases[k], k);
  if (occurring.size() > 1)
    {
      id_stride = nx + phase_padding;
      ids.assign(id_stride * ny, 0);
      for (unsigned int j = 0; j < ny; ++j)
        std::copy_n(phase_id.begin() + std::size_t(j) * nx, nx,
                    ids.begin() + j * id_stride);
    }
}

UniformMaterial
UniformMaterial::with_phases(const std::vector<ElasticPhase<2>> &phases) const
{
  assert(phases.size() == the_phases.size());
  UniformMaterial other = *this;
  other.the_phases      = phases;
  return other;
}

UniformMaterial UniformMaterial::with(const Periodicity periodicity) const
{
  UniformMaterial other = *this;
  other.periodic        = periodicity;
  return other;
}

bool UniformMaterial::is_orthotropic() const
{
  return std::none_of(occurring.begin(), occurring.end(), [this](const unsigned int k) {
    const VoigtMatrix<2> &D = the_phases[k].stiffness;
    return std::max(std::abs(D(0, 2)), std::abs(D(1, 2))) >
           1e-14 * D.cwiseAbs().maxCoeff();
  });
}

bool UniformMaterial::has_uniform_density() const
{
  return std::all_of(occurring.begin(), occurring.end(), [this](const unsigned int k) {
    return the_phases[k].density == the_phases[occurring[0]].density;
  });
}

void UniformMaterial::mass_row(const unsigned int j, double *mass) const
{
  const unsigned int nx = the_grid.cells[0], ny = the_grid.cells[1];
  const double quarter = the_grid.cell_measure() / 4.;
  std::fill_n(mass, nx + 1, 0.);
  const auto add_cells = [&](const unsigned int cell_row) {
    for (unsigned int i = 0; i < nx; ++i)
      {
        const double m = quarter * the_phases[phase_of(i, cell_row)].density;
        mass[i] += m;
        mass[i + 1] += m;
      }
  };
  if (j > 0 || periodic.y)
    add_cells((j + ny - 1) % ny);
  if (j < ny || periodic.y)
    add_cells(j % ny);
  if (periodic.x)
    mass[0] = mass[nx] = mass[0] + mass[nx];
}

double UniformMaterial::total_mass() const
{
  if (has_uniform_density())
    return the_phases[occurring[0]].density * the_grid.extent(0) * the_grid.extent(1);
  double sum = 0.;
  for (unsigned int j = 0; j < the_grid.cells[1]; ++j)
    for (unsigned int i = 0; i < the_grid.cells[0]; ++i)
      sum += the_phases[phase_of(i, j)].density;
  return sum * the_grid.cell_measure();
}
} // namespace mesoslip
