#ifndef mesoslip_tests_verification_independent_statics_h
#define mesoslip_tests_verification_independent_statics_h

#include "../../unit/elasticity/elasticity_testing.h"
#include "homogenization_testing.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

/**
 * Effective stiffnesses by a code of its own: cell matrices from four Gauss points, one
 * sparse matrix, its Cholesky factors with steps of refinement. It shares the volume with
 * the library, and nothing else.
 */
namespace independent_statics
{
using namespace homogenization_testing;
using Real   = long double;
using Fields = Eigen::Matrix<Real, Eigen::Dynamic, 3>; ///< of the three load cases
using Sparse = Eigen::SparseMatrix<Real>;

/** Stiffness matrix of all nodes, two components each. */
inline Sparse assemble(const Volume &volume)
{
  const int nx = volume.grid.cells[0], ny = volume.grid.cells[1];
  std::vector<elasticity_testing::CellMatrix<Real>> cells;
  for (const VoigtMatrix<2> &C : volume.stiffness)
    cells.push_back(elasticity_testing::element_matrix<Real>(C, volume.grid.spacing[0],
                                                             volume.grid.spacing[1]));
  std::vector<Eigen::Triplet<Real>> entries;
  const auto dof = [&](const int cell, const int k) {
    return 2 * ((cell / nx + k / 4) * (nx + 1) + cell % nx + k / 2 % 2) + k % 2;
  };
  for (int cell = 0; cell < nx * ny; ++cell)
    for (int r = 0; r < 8; ++r)
      for (int c = 0; c < 8; ++c)
        entries.emplace_back(dof(cell, r), dof(cell, c), cells[volume.id[cell]](r, c));
  Sparse K(2 * (nx + 1) * (ny + 1), 2 * (nx + 1) * (ny + 1));
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

/** From the unknowns to the displacements of the nodes that they move. */
inline Sparse unknowns(const int nx, const int ny, const BoundaryCondition condition)
{
  std::vector<Eigen::Triplet<Real>> entries;
  std::vector<int> column(2 * (nx + 1) * (ny + 1), -1);
  int n = 0;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      for (int c = 0; c < 2; ++c)
        {
          const int k = 2 * (j * (nx + 1) + i) + c;
          if (condition == BoundaryCondition::KUBC)
            column[k] = i % nx == 0 || j % ny == 0 ? -1 : n++;
          else if (condition == BoundaryCondition::PBC && (i == nx || j == ny))
            column[k] = column[2 * (j % ny * (nx + 1) + i % nx) + c];
          else if (i + j > 0 && !(condition == BoundaryCondition::SUBC && i == nx &&
                                  j == 0 && c == 1)) // against rigid motions
            column[k] = n++;
          if (column[k] >= 0)
            entries.emplace_back(k, column[k], 1.);
        }
  Sparse T(column.size(), n);
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

inline VoigtMatrix<2> stiffness(const Volume &volume, const BoundaryCondition condition)
{
  const int nx = volume.grid.cells[0], ny = volume.grid.cells[1];
  const Real hx = volume.grid.spacing[0], hy = volume.grid.spacing[1];
  const Sparse K = assemble(volume), T = unknowns(nx, ny, condition);
  // Of the strains and of the stresses 1 in one component; normals times lengths.
  Fields u = Fields::Zero(K.rows(), 3), f = u;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      {
        const int k   = 2 * (j * (nx + 1) + i);
        const Real tx = ((i == nx) - (i == 0)) * hy * (j % ny == 0 ? 0.5L : 1.L),
                   ty = ((j == ny) - (j == 0)) * hx * (i % nx == 0 ? 0.5L : 1.L);
        u.row(k) << i * hx, 0, 0.5L * j * hy;
        u.row(k + 1) << 0, j * hy, 0.5L * i * hx;
        f.row(k) << tx, 0, ty;
        f.row(k + 1) << 0, ty, tx;
      }
  const bool stresses = condition == BoundaryCondition::SUBC;
  (stresses ? u : f).setZero();
  if (T.cols() > 0)
    {
      const Sparse transposed = T.transpose();
      const Eigen::SimplicialLDLT<Sparse> factors(transposed * K * T);
      for (int step = 0; step < 4; ++step)
        u += T * factors.solve(transposed * (f - K * u));
    }
  // Twice the energies: loads times displacements, or strains times forces.
  const Fields forces                      = stresses ? f : Fields(K * u);
  const Eigen::Matrix<Real, 3, 3> products = forces.transpose() * u / (nx * hx * ny * hy);
  return (stresses ? products.inverse().eval() : products).cast<double>();
}
} // namespace independent_statics

#endif
