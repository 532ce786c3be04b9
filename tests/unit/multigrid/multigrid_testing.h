#ifndef mesoslip_tests_unit_multigrid_testing_h
#define mesoslip_tests_unit_multigrid_testing_h

#include "../elasticity/elasticity_testing.h"

#include "elasticity/dof_mask.h"
#include "elasticity/uniform_grid_operator.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "material/stiffness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

/** Scenes for the static solvers. */
namespace multigrid_testing
{
using namespace mesoslip;

constexpr unsigned int seed = 4711;

inline UniformGrid<2> make_grid(const unsigned int nx,
                                const unsigned int ny,
                                const double hx = 1e-4,
                                const double hy = 1e-4)
{
  return {{{nx, ny}}, {{hx, hy}}};
}

/** Vertical fibres one cell wide, 12 to 36 cells tall, 10 % of the area. */
inline std::vector<std::uint8_t> fibres(const unsigned int nx, const unsigned int ny)
{
  std::mt19937_64 random(seed);
  std::vector<std::uint8_t> id(static_cast<std::size_t>(nx) * ny, 0);
  for (std::size_t n = 0; n < id.size() / 10;)
    {
      const int length     = 12 + static_cast<int>(random() % 25);
      const unsigned int i = static_cast<unsigned int>(random() % nx);
      const int begin      = static_cast<int>(random() % (ny + length)) - length;
      for (int j = std::max(begin, 0); j < std::min<int>(begin + length, ny); ++j)
        {
          n += id[j * nx + i] == 0;
          id[j * nx + i] = 1;
        }
    }
  return id;
}

/** Each cell by itself. */
inline std::vector<std::uint8_t>
noise(const unsigned int nx, const unsigned int ny, const unsigned int n_classes)
{
  std::mt19937_64 random(seed);
  std::vector<std::uint8_t> id(static_cast<std::size_t>(nx) * ny);
  for (std::uint8_t &c : id)
    c = static_cast<std::uint8_t>(random() % n_classes);
  return id;
}

/** Isotropic, @p contrast times as stiff, and a turned orthotropic class. */
inline std::vector<ElasticPhase<2>> classes(const double contrast,
                                            const bool anisotropic = false)
{
  std::vector<ElasticPhase<2>> result(2);
  result[0] = {isotropic_stiffness<2>(30e9, 0.2), 1770.};
  result[1] = {isotropic_stiffness<2>(30e9 * contrast, 0.2), 1770.};
  if (anisotropic)
    result.push_back(
      {stiffness_from_coefficients<2>({80e9, 12e9, 9e9, 35e9, -4e9, 20e9}), 1770.});
  return result;
}

inline NodalField<double> nodal_field(const UniformMaterial &material)
{
  return NodalField<double>(material.n_columns(), material.n_rows());
}

/** u = E x with E = (xx, xy; xy, yy), from the lower left corner. */
inline NodalField<double>
affine(const UniformMaterial &material, const double xx, const double yy, const double xy)
{
  NodalField<double> u = nodal_field(material);
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      {
        const double x = i * material.grid().spacing[0],
                     y = j * material.grid().spacing[1];
        u.row(0, j)[i] = xx * x + xy * y;
        u.row(1, j)[i] = xy * x + yy * y;
      }
  return u;
}

/** Random nodal forces in equilibrium (resultants and moment) whatever is held. */
inline NodalField<double> balanced_forces(const UniformMaterial &material)
{
  std::mt19937_64 random(seed + 1);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  NodalField<double> u = nodal_field(material), f = nodal_field(material);
  for (unsigned int j = 0; j + material.periodicity().y < u.n_rows(); ++j)
    for (unsigned int i = 0; i + material.periodicity().x < u.n_columns(); ++i)
      for (unsigned int c = 0; c < 2; ++c)
        u.row(c, j)[i] = uniform(random);
  material.update_copies(u);
  // Forces of some displacement field are in equilibrium.
  UniformGridOperator(material).vmult(f, u);
  return f;
}

/** Largest difference over largest entry. */
inline double difference(const NodalField<double> &a, const NodalField<double> &b)
{
  const NodalField<double> zero(b.n_columns(), b.n_rows());
  return elasticity_testing::largest_difference(a, b) /
         elasticity_testing::largest_difference(b, zero);
}
} // namespace multigrid_testing

#endif
