#ifndef mesoslip_tests_unit_elasticity_testing_h
#define mesoslip_tests_unit_elasticity_testing_h

#include "elasticity/uniform_material.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

/** Random scenes and a reference that shares no code with the kernels. */
namespace elasticity_testing
{
using namespace mesoslip;

constexpr unsigned int seed = 20240611;

template <typename Number>
using CellMatrix    = Eigen::Matrix<Number, 8, 8>;
using ElementMatrix = CellMatrix<double>;

/** Q1 rectangle by 2x2 Gauss points; unknowns node by node, x fastest. */
template <typename Number = double>
CellMatrix<Number>
element_matrix(const VoigtMatrix<2> &D, const Number hx, const Number hy)
{
  CellMatrix<Number> K = CellMatrix<Number>::Zero();
  const Number g       = Number(0.5) / std::sqrt(Number(3));
  for (const Number X : {-g, g})
    for (const Number Y : {-g, g})
      {
        Eigen::Matrix<Number, 3, 8> B = Eigen::Matrix<Number, 3, 8>::Zero();
        for (int n = 0; n < 4; ++n)
          {
            const Number sx = n % 2 ? 1 : -1, sy = n / 2 ? 1 : -1;
            B(0, 2 * n) = B(2, 2 * n + 1) = sx * (Number(0.5) + sy * Y) / hx;
            B(1, 2 * n + 1) = B(2, 2 * n) = sy * (Number(0.5) + sx * X) / hy;
          }
        K += B.transpose() * D.cast<Number>() * B * (hx * hy / 4);
      }
  return K;
}

inline VoigtMatrix<2> plane_strain(const double lambda, const double mu)
{
  VoigtMatrix<2> D;
  D << lambda + 2 * mu, lambda, 0, lambda, lambda + 2 * mu, 0, 0, 0, mu;
  return D;
}

/** Random numbers, the same ones for a seed. */
class Random
{
public:
  explicit Random(const unsigned int seed = elasticity_testing::seed)
    : generator(seed)
  {
  }

  double operator()(const double lower = -1., const double upper = 1.)
  {
    return std::uniform_real_distribution<double>(lower, upper)(generator);
  }

  /** Uniform logarithm. */
  double scale(const double lower, const double upper)
  {
    return std::exp((*this)(std::log(lower), std::log(upper)));
  }

  /** Both ends included. */
  unsigned int integer(const unsigned int lower, const unsigned int upper)
  {
    return std::uniform_int_distribution<unsigned int>(lower, upper)(generator);
  }

  VoigtMatrix<2> stiffness(const bool anisotropic)
  {
    Eigen::Matrix3d A;
    for (int i = 0; i < 9; ++i)
      A(i / 3, i % 3) = (*this)();
    VoigtMatrix<2> D = A * A.transpose() + Eigen::Matrix3d::Identity();
    if (!anisotropic)
      D(0, 2) = D(2, 0) = D(1, 2) = D(2, 1) = 0.;
    return D;
  }

  /** Positive definite, whatever else. */
  VoigtMatrix<2> any_stiffness(const double modulus)
  {
    VoigtMatrix<2> L = VoigtMatrix<2>::Zero();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c)
        L(r, c) = r == c ? scale(0.1, 1.) : (*this)();
    return modulus * L * L.transpose();
  }

  void fill(NodalField<double> &field)
  {
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < field.n_rows(); ++j)
        for (unsigned int i = 0; i < field.n_columns(); ++i)
          field.row(c, j)[i] = (*this)();
  }

private:
  std::mt19937_64 generator;
};

/** A random material with classes 0 .. n_classes - 1. */
inline UniformMaterial random_material(Random &random,
                                       const std::array<unsigned int, 2> cells,
                                       const unsigned int n_classes,
                                       const bool anisotropic,
                                       const bool uniform_density,
                                       const Periodicity periodicity = Periodicity())
{
  const UniformGrid<2> grid{cells, {{0.7, 0.9}}};
  std::vector<ElasticPhase<2>> classes(n_classes);
  for (ElasticPhase<2> &c : classes)
    c = {random.stiffness(anisotropic), uniform_density ? 1.3 : random(1., 2.)};
  std::vector<std::uint8_t> ids;
  if (n_classes > 1)
    {
      for (std::size_t i = 0; i < grid.n_cells(); ++i)
        ids.push_back(random.integer(0, n_classes - 1));
      ids.back() = n_classes - 1;
    }
  return UniformMaterial(grid, classes, ids, periodicity);
}

/** K u cell by cell with dense element matrices. */
inline NodalField<double> reference_product(const UniformMaterial &material,
                                            const NodalField<double> &u)
{
  const UniformGrid<2> &grid = material.grid();
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  const Periodicity p = material.periodicity();
  NodalField<double> f(nx + 1, ny + 1);
  std::vector<ElementMatrix> element;
  for (const ElasticPhase<2> &c : material.phases())
    element.push_back(element_matrix(c.stiffness, grid.spacing[0], grid.spacing[1]));
  for (unsigned int j = 0; j < ny; ++j)
    for (unsigned int i = 0; i < nx; ++i)
      {
        Eigen::Matrix<double, 8, 1> z;
        for (int k = 0; k < 8; ++k)
          z(k) = u.row(k % 2, j + k / 4)[i + k / 2 % 2];
        const Eigen::Matrix<double, 8, 1> r = element[material.phase_of(i, j)] * z;
        for (int k = 0; k < 8; ++k)
          {
            const unsigned int row = j + k / 4, column = i + k / 2 % 2;
            f.row(k % 2, p.y ? row % ny : row)[p.x ? column % nx : column] += r(k);
          }
      }
  material.update_copies(f);
  return f;
}

/** Largest difference of two fields, NaN if there is one. */
template <typename Number>
double largest_difference(const NodalField<double> &a, const NodalField<Number> &b)
{
  double largest = 0.;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < a.n_rows(); ++j)
      for (unsigned int i = 0; i < a.n_columns(); ++i)
        {
          const double d = std::abs(a.row(c, j)[i] - b.row(c, j)[i]);
          if (!(d <= largest))
            largest = d;
          if (std::isnan(d))
            return d;
        }
  return largest;
}

inline bool equal_bits(const NodalField<double> &a, const NodalField<double> &b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.begin() + a.size(), b.begin());
}

/** Odd shapes: shorter than a vector, just one, just over; fewer rows than a sweep takes.
 */
inline const std::vector<std::array<unsigned int, 2>> &shapes()
{
  static const std::vector<std::array<unsigned int, 2>> s = {
    {{1, 1}}, {{2, 7}}, {{7, 2}}, {{8, 3}}, {{15, 4}}, {{16, 5}}, {{37, 13}}};
  return s;
}
} // namespace elasticity_testing

#endif
