#ifndef mesoslip_tests_verification_independent_statics_h
#define mesoslip_tests_verification_independent_statics_h

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
using Real       = long double;
using Vector     = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using CellMatrix = Eigen::Matrix<Real, 8, 8>;

/** Corners (0,0), (1,0), (0,1), (1,1), two components each. */
inline CellMatrix cell_matrix(const VoigtMatrix<2> &C, const Real hx, const Real hy)
{
  CellMatrix K   = CellMatrix::Zero();
  const Real g   = 0.5L / std::sqrt(3.L);
  const Real s[] = {0.5 - g, 0.5 + g};
  for (const Real x : s)
    for (const Real y : s)
      {
        const Real dx[]             = {-(1. - y) / hx, (1. - y) / hx, -y / hx, y / hx},
                   dy[]             = {-(1. - x) / hy, -x / hy, (1. - x) / hy, x / hy};
        Eigen::Matrix<Real, 3, 8> B = Eigen::Matrix<Real, 3, 8>::Zero();
        for (int n = 0; n < 4; ++n)
          {
            B(0, 2 * n) = B(2, 2 * n + 1) = dx[n];
            B(1, 2 * n + 1) = B(2, 2 * n) = dy[n];
          }
        K += B.transpose() * C.cast<Real>() * B * (0.25L * hx * hy);
      }
  return K;
}

class Solver
{
public:
  Solver(const Volume &the_volume, const BoundaryCondition the_condition)
    : volume(the_volume)
    , condition(the_condition)
    , nx(volume.grid.cells[0])
    , ny(volume.grid.cells[1])
    , hx(volume.grid.spacing[0])
    , hy(volume.grid.spacing[1])
  {
    for (const VoigtMatrix<2> &C : volume.stiffness)
      cells.push_back(cell_matrix(C, hx, hy));
    number_unknowns();
    factorize();
  }

  VoigtMatrix<2> stiffness() const
  {
    const bool stresses = condition == BoundaryCondition::SUBC;
    std::array<Vector, 3> u, f;
    for (int k = 0; k < 3; ++k)
      {
        f[k]         = stresses ? tractions(k) : Vector(nodal_zero());
        Vector known = stresses ? nodal_zero() : affine(k);
        u[k]         = solve(known, f[k]);
      }
    Eigen::Matrix<Real, 3, 3> products;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        products(k, l) = stresses ? f[k].dot(u[l]) : energy(u[k], u[l]);
    products /= nx * hx * ny * hy;
    if (stresses)
      products = products.inverse().eval();
    return products.cast<double>();
  }

private:
  Vector nodal_zero() const
  {
    return Vector::Zero(2 * (nx + 1) * (ny + 1));
  }

  int dof(const int i, const int j, const int c) const
  {
    return 2 * (j * (nx + 1) + i) + c;
  }

  std::array<int, 8> dofs_of(const int i, const int j) const
  {
    std::array<int, 8> dofs{};
    for (int k = 0; k < 8; ++k)
      dofs[k] = dof(i + k / 2 % 2, j + k / 4, k % 2);
    return dofs;
  }

  // -1: held.
  void number_unknowns()
  {
    unknown.assign(2 * (nx + 1) * (ny + 1), -1);
    const bool periodic = condition == BoundaryCondition::PBC;
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        for (int c = 0; c < 2; ++c)
          {
            const bool border = i == 0 || j == 0 || i == nx || j == ny;
            if (condition == BoundaryCondition::KUBC && border)
              continue;
            if (periodic && (i == nx || j == ny))
              unknown[dof(i, j, c)] = unknown[dof(i % nx, j % ny, c)];
            else if (!(i == 0 && j == 0) && !(condition == BoundaryCondition::SUBC &&
                                              i == nx && j == 0 && c == 1))
              unknown[dof(i, j, c)] = n_unknowns++;
          }
  }

  template <typename Function>
  void for_each_cell(const Function &function) const
  {
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        function(cells[volume.id[j * nx + i]], dofs_of(i, j));
  }

  void factorize()
  {
    std::vector<Eigen::Triplet<Real>> entries;
    for_each_cell([&](const CellMatrix &K, const std::array<int, 8> &dofs) {
      for (int r = 0; r < 8; ++r)
        for (int c = 0; c < 8; ++c)
          if (unknown[dofs[r]] >= 0 && unknown[dofs[c]] >= 0)
            entries.emplace_back(unknown[dofs[r]], unknown[dofs[c]], K(r, c));
    });
    Eigen::SparseMatrix<Real> matrix(n_unknowns, n_unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (n_unknowns > 0)
      factors.compute(matrix);
  }

  Vector residual(const Vector &u, const Vector &f) const
  {
    Vector r = Vector::Zero(n_unknowns);
    for (int k = 0; k < u.size(); ++k)
      if (unknown[k] >= 0)
        r[unknown[k]] += f[k];
    for_each_cell([&](const CellMatrix &K, const std::array<int, 8> &dofs) {
      Eigen::Matrix<Real, 8, 1> v;
      for (int k = 0; k < 8; ++k)
        v[k] = u[dofs[k]];
      v = K * v;
      for (int k = 0; k < 8; ++k)
        if (unknown[dofs[k]] >= 0)
          r[unknown[dofs[k]]] -= v[k];
    });
    return r;
  }

  Vector solve(Vector u, const Vector &f) const
  {
    for (int step = 0; step < 4 && n_unknowns > 0; ++step)
      {
        const Vector correction = factors.solve(residual(u, f));
        for (int k = 0; k < u.size(); ++k)
          if (unknown[k] >= 0)
            u[k] += correction[unknown[k]];
      }
    return u;
  }

  Real energy(const Vector &a, const Vector &b) const
  {
    Real sum = 0;
    for_each_cell([&](const CellMatrix &K, const std::array<int, 8> &dofs) {
      Eigen::Matrix<Real, 8, 1> v, w;
      for (int k = 0; k < 8; ++k)
        {
          v[k] = a[dofs[k]];
          w[k] = b[dofs[k]];
        }
      sum += v.dot(K * w);
    });
    return sum;
  }

  Vector affine(const int k) const
  {
    Vector u = nodal_zero();
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        {
          u[dof(i, j, 0)] = k == 0 ? i * hx : k == 2 ? 0.5 * j * hy : 0.;
          u[dof(i, j, 1)] = k == 1 ? j * hy : k == 2 ? 0.5 * i * hx : 0.;
        }
    return u;
  }

  Vector tractions(const int k) const
  {
    const double sxx = k == 0, syy = k == 1, sxy = k == 2;
    Vector f = nodal_zero();
    for (int j = 0; j < ny; ++j)
      for (const int end : {j, j + 1})
        for (const int side : {-1, 1})
          {
            const int i = side < 0 ? 0 : nx;
            f[dof(i, end, 0)] += side * 0.5 * hy * sxx;
            f[dof(i, end, 1)] += side * 0.5 * hy * sxy;
          }
    for (int i = 0; i < nx; ++i)
      for (const int end : {i, i + 1})
        for (const int side : {-1, 1})
          {
            const int j = side < 0 ? 0 : ny;
            f[dof(end, j, 0)] += side * 0.5 * hx * sxy;
            f[dof(end, j, 1)] += side * 0.5 * hx * syy;
          }
    return f;
  }

  const Volume &volume;
  BoundaryCondition condition;
  int nx, ny;
  Real hx, hy;
  std::vector<CellMatrix> cells;
  std::vector<int> unknown;
  int n_unknowns = 0;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<Real>> factors;
};

} // namespace independent_statics

#endif
