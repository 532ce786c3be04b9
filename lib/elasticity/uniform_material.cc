#include "elasticity/uniform_material.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mesoslip
{
namespace
{
/** Kernels read a whole vector of classes beyond the last cell. */
constexpr std::size_t class_padding = 64;

void check(const ElasticClass &material, const unsigned int c)
{
  const std::string name  = "class " + std::to_string(c);
  const VoigtMatrix<2> &D = material.stiffness;
  const double largest    = D.cwiseAbs().maxCoeff();
  if (!(material.density > 0.) || !std::isfinite(material.density))
    throw std::invalid_argument(name + ": the density must be positive, not " +
                                std::to_string(material.density));
  if (!D.allFinite() || !((D - D.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * largest))
    throw std::invalid_argument(name + ": the stiffness must be finite and symmetric");
  if (Eigen::LLT<VoigtMatrix<2>>(D).info() != Eigen::Success)
    throw std::invalid_argument(name + ": the stiffness must be positive definite");
}

bool couples_shear(const VoigtMatrix<2> &D)
{
  return std::max(std::abs(D(0, 2)), std::abs(D(1, 2))) > 1e-14 * D.cwiseAbs().maxCoeff();
}
} // namespace

UniformMaterial::UniformMaterial(const UniformGrid<2> &grid,
                                 const std::vector<ElasticClass> &classes,
                                 const std::vector<std::uint8_t> &class_id,
                                 const Periodicity periodicity)
  : the_grid(grid)
  , the_classes(classes)
  , periodic(periodicity)
{
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  if (nx == 0 || ny == 0 || !(grid.spacing[0] > 0.) || !(grid.spacing[1] > 0.))
    throw std::invalid_argument("a uniform grid needs cells of positive size");
  if (!class_id.empty() && class_id.size() != grid.n_cells())
    throw std::invalid_argument("the grid has " + std::to_string(grid.n_cells()) +
                                " cells but " + std::to_string(class_id.size()) +
                                " classes were given");

  std::vector<bool> used(256, false);
  if (class_id.empty())
    used[0] = true;
  for (const std::uint8_t c : class_id)
    used[c] = true;
  unsigned int n_used = 0;
  for (unsigned int c = 0; c < used.size(); ++c)
    if (used[c])
      {
        if (c >= classes.size())
          throw std::invalid_argument("a cell is of class " + std::to_string(c) +
                                      " but only " + std::to_string(classes.size()) +
                                      " classes are defined");
        check(classes[c], c);
        orthotropic = orthotropic && !couples_shear(classes[c].stiffness);
        uniform_density =
          uniform_density &&
          (n_used == 0 || classes[c].density == classes[only_class].density);
        if (n_used == 0)
          only_class = c;
        number_of_classes = c + 1;
        ++n_used;
      }

  if (n_used > 1)
    {
      id_stride = nx + class_padding;
      ids.assign(id_stride * ny, 0);
      for (unsigned int j = 0; j < ny; ++j)
        std::copy_n(class_id.begin() + std::size_t(j) * nx, nx,
                    ids.begin() + j * id_stride);
    }
}

void UniformMaterial::mass_row(const unsigned int j, double *mass) const
{
  const unsigned int nx = the_grid.cells[0], ny = the_grid.cells[1];
  const double quarter = the_grid.cell_measure() / 4.;
  std::fill_n(mass, nx + 1, 0.);
  const auto add_cells = [&](const unsigned int cell_row) {
    for (unsigned int i = 0; i < nx; ++i)
      {
        const double m = quarter * the_classes[class_of(i, cell_row)].density;
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
  if (uniform_density)
    return the_classes[only_class].density * the_grid.extent(0) * the_grid.extent(1);
  double sum = 0.;
  for (unsigned int j = 0; j < the_grid.cells[1]; ++j)
    for (unsigned int i = 0; i < the_grid.cells[0]; ++i)
      sum += the_classes[class_of(i, j)].density;
  return sum * the_grid.cell_measure();
}
} // namespace mesoslip
