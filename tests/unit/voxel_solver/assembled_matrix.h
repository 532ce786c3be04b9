#ifndef mesoslip_tests_unit_assembled_matrix_h
#define mesoslip_tests_unit_assembled_matrix_h

#include "material/stiffness.h"
#include "statics/voxel/solver.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <cmath>
#include <random>

namespace voxel_testing
{
using namespace mesoslip;
using voxel::Sides;

/** Random phases on cells with three different edges (m). */
inline PhaseMap<3> random_map(const std::array<unsigned int, 3> cells,
                              const unsigned int n_phases)
{
  PhaseMap<3> map{{cells, {{1.3e-3, 1e-3, 0.6e-3}}, {}}, {}};
  std::mt19937 generator(3);
  std::uniform_int_distribution<int> phase(0, static_cast<int>(n_phases) - 1);
  for (std::size_t i = 0; i < map.grid.n_cells(); ++i)
    map.id.push_back(static_cast<std::uint8_t>(phase(generator)));
  return map;
}

/** Isotropic ones, the first of which may have mean dilatation, and one that couples everything if
 * asked for. */
inline std::vector<ElasticPhase<3>> phases_of(const bool general,
                                              const bool mean_dilatation = false)
{
  std::vector<ElasticPhase<3>> result = {
    {isotropic_stiffness<3>(3e9, mean_dilatation ? 0.48 : 0.35), 0., mean_dilatation},
    {isotropic_stiffness<3>(24e9, 0.2), 0.}};
  if (general)
    {
      VoigtMatrix<3> A;
      for (unsigned int i = 0; i < 36; ++i)
        A(i / 6, i % 6) = std::sin(1. + 7. * i);
      result.push_back({5e9 * (VoigtMatrix<3>::Identity() + 0.3 * A * A.transpose()), 0.,
                        mean_dilatation});
    }
  return result;
}

/** The same body with a dense matrix; unit lengths are metres. */
class Assembled
{
public:
  Assembled(const PhaseMap<3> &map,
            const std::vector<ElasticPhase<3>> &phases,
            const Sides sides)
    : map(map)
    , phases(phases)
    , sides(sides)
  {
    for (unsigned int d = 0; d < 3; ++d)
      n[d] = map.grid.cells[d] + (sides == Sides::free) - (sides == Sides::held);
    const auto size = static_cast<Eigen::Index>(3) * n[0] * n[1] * n[2];
    K.setZero(size, size);
    load.setZero(size, 6);
    for_each_point([&](const std::array<long, 24> &index, const auto &B,
                       const VoigtMatrix<3> &C, const double weight) {
      const Eigen::Matrix<double, 24, 24> k = weight * B.transpose() * C * B;
      const Eigen::Matrix<double, 24, 6> f =
        sides == Sides::free ? Eigen::Matrix<double, 24, 6>(weight * B.transpose())
                             : Eigen::Matrix<double, 24, 6>(-weight * B.transpose() * C);
      for (unsigned int r = 0; r < 24; ++r)
        if (index[r] >= 0)
          {
            load.row(index[r]) += f.row(r);
            for (unsigned int c = 0; c < 24; ++c)
              if (index[c] >= 0)
                K(index[r], index[c]) += k(r, c);
          }
    });
  }

  /** Number of an unknown, -1 if there is none, of a node counted from 0. */
  long unknown(const std::array<unsigned int, 3> &node, const unsigned int c) const
  {
    long number = 0;
    for (unsigned int d = 3; d-- > 0;)
      {
        long i = node[d];
        if (sides == Sides::held)
          i -= 1;
        if (sides == Sides::periodic)
          i %= n[d];
        if (i < 0 || i >= static_cast<long>(n[d]))
          return -1;
        number = number * n[d] + i;
      }
    return 3 * number + c;
  }

  /** Solutions of all cases, one a column; minimal rigid motion. */
  Eigen::MatrixXd solve() const
  {
    return K.completeOrthogonalDecomposition().solve(load);
  }

  /** Mean strain of a cell. */
  VoigtVector<3> strain(const Eigen::MatrixXd &u,
                        const unsigned int load,
                        const std::array<unsigned int, 3> &cell) const
  {
    VoigtVector<3> result = VoigtVector<3>::Zero();
    if (sides != Sides::free)
      result[load] = 1.;
    for (unsigned int corner = 0; corner < 8; ++corner)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const long index =
            unknown({{cell[0] + (corner & 1U), cell[1] + (corner >> 1 & 1U),
                      cell[2] + (corner >> 2)}},
                    c);
          for (unsigned int d = 0; d < 3 && index >= 0; ++d)
            result[voigt_index<3>(c, d)] += ((corner >> d & 1U) != 0 ? 1. : -1.) *
                                            u(index, load) / (4. * map.grid.spacing[d]);
        }
    return result;
  }

  /** Effective stiffness (Pa) from mean strains and stresses. */
  VoigtMatrix<3> effective(const Eigen::MatrixXd &u) const
  {
    VoigtMatrix<3> strain = VoigtMatrix<3>::Zero(), stress = strain;
    double volume = 0.;
    for_each_point([&](const std::array<long, 24> &index, const auto &B,
                       const VoigtMatrix<3> &C, const double weight) {
      Eigen::Matrix<double, 24, 6> v = Eigen::Matrix<double, 24, 6>::Zero();
      for (unsigned int r = 0; r < 24; ++r)
        if (index[r] >= 0)
          v.row(r) = u.row(index[r]);
      VoigtMatrix<3> e = B * v;
      if (sides != Sides::free)
        e += VoigtMatrix<3>::Identity();
      strain += weight * e;
      stress += weight * C * e;
      volume += weight;
    });
    return sides == Sides::free ? VoigtMatrix<3>(strain.inverse() * volume)
                                : VoigtMatrix<3>(stress / volume);
  }

  Eigen::MatrixXd K, load;

private:
  /** function(unknowns, strains of the corners, stiffness, weight) */
  template <typename Function>
  void for_each_point(const Function &function) const
  {
    const std::array<double, 3> at = {{-std::sqrt(0.6), 0., std::sqrt(0.6)}},
                                w  = {{5. / 9., 8. / 9., 5. / 9.}};
    const auto &h                  = map.grid.spacing;
    for (unsigned int cell = 0; cell < map.id.size(); ++cell)
      {
        const auto &m                             = map.grid.cells;
        const std::array<unsigned int, 3> corner0 = {
          {cell % m[0], cell / m[0] % m[1], cell / m[0] / m[1]}};
        std::array<long, 24> index;
        for (unsigned int r = 0; r < 24; ++r)
          index[r] = unknown({{corner0[0] + (r / 3 & 1U), corner0[1] + (r / 6 & 1U),
                               corner0[2] + (r / 12)}},
                             r % 3);
        for (unsigned int q = 0; q < 27; ++q)
          {
            const std::array<unsigned int, 3> p = {{q % 3, q / 3 % 3, q / 9}};
            Eigen::Matrix<double, 6, 24> B      = Eigen::Matrix<double, 6, 24>::Zero();
            for (unsigned int r = 0; r < 8; ++r)
              {
                std::array<double, 3> value, slope;
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    const double end = (r >> d & 1U) != 0 ? 1. : -1.;
                    value[d]         = 0.5 * (1. + end * at[p[d]]);
                    slope[d]         = end / h[d];
                  }
                const double gx = slope[0] * value[1] * value[2],
                             gy = value[0] * slope[1] * value[2],
                             gz = value[0] * value[1] * slope[2];
                Eigen::Matrix<double, 6, 3> b;
                b << gx, 0, 0, 0, gy, 0, 0, 0, gz, 0, gz, gy, gz, 0, gx, gy, gx, 0;
                B.middleCols<3>(3 * r) = b;
              }
            const ElasticPhase<3> &phase = phases[map.id[cell]];
            if (phase.mean_dilatation)
              for (unsigned int r = 0; r < 24; ++r)
                {
                  // A brick has its mean change of volume in the middle.
                  const double middle =
                    ((r / 3 >> r % 3 & 1U) != 0 ? 1. : -1.) / (4. * h[r % 3]);
                  B.col(r).head<3>().array() += (middle - B(r % 3, r)) / 3.;
                }
            function(index, B, phase.stiffness,
                     w[p[0]] * w[p[1]] * w[p[2]] / 8. * h[0] * h[1] * h[2]);
          }
      }
  }

  const PhaseMap<3> map;
  const std::vector<ElasticPhase<3>> phases;
  const Sides sides;
  std::array<unsigned int, 3> n = {};
};
} // namespace voxel_testing

#endif
