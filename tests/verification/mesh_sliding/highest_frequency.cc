// The largest frequency of meshes, which the critical time step follows from. On one rank.

#include "mesh_sliding.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace verification;

namespace
{
/** Two materials in four triangles, 3 mm wide and 4 mm high, numbered as @p order has its points. */
Mesh<2> triangles(const std::array<unsigned int, 6> &order)
{
  const std::array<dealii::Point<2>, 6> points             = {{{0., 3e-7},
                                                               {1.7e-3, 0.},
                                                               {3.4e-3, 3e-7},
                                                               {0., 4.5e-3},
                                                               {1.7e-3, 4.5e-3},
                                                               {3.4e-3, 4.5e-3}}};
  const std::array<std::array<unsigned int, 3>, 4> corners = {
    {{{0, 1, 4}}, {{0, 4, 3}}, {{1, 2, 5}}, {{1, 5, 4}}}};
  Mesh<2> mesh;
  mesh.points.resize(points.size());
  for (unsigned int k = 0; k < points.size(); ++k)
    mesh.points[order[k]] = points[k];
  for (const auto &cell : corners)
    {
      Cell &added = mesh.cells.emplace_back(3);
      for (unsigned int v = 0; v < 3; ++v)
        added.vertices[v] = order[cell[v]];
      added.material_id = mesh.cells.size() == 4;
    }
  return mesh;
}

/** From all eigenvalues of M^-1/2 K M^-1/2. */
double exact_frequency(const MeshOperator<2> &op)
{
  constexpr unsigned int stride  = kernels::node_stride<2>;
  const unsigned int n           = 2 * op.part.n_distinct;
  const std::vector<double> mass = op.lumped_mass();
  Eigen::MatrixXd A(n, n);
  for (unsigned int column = 0; column < n; ++column)
    {
      LineVector<double> x = op.zero_field(), Kx = x;
      x[column / 2 * stride + column % 2] = 1.;
      op.add_product(Kx.data(), x.data());
      for (unsigned int row = 0; row < n; ++row)
        A(row, column) =
          Kx[row / 2 * stride + row % 2] / std::sqrt(mass[row / 2] * mass[column / 2]);
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues()[n - 1]);
}
} // namespace

// 4 (3 lambda + 2 mu) / (rho h^2) is the largest eigenvalue of a cube that is one cell.
TEST(HighestFrequency, OfACube)
{
  const double E = 2.1e11, nu = 0.3, rho = 7850., h = 0.01;
  const double lambda_2mu = E * (1. - nu) / ((1. + nu) * (1. - 2. * nu)),
               mu         = E / (2. * (1. + nu));
  const Mesh<3> mesh      = brick<3>({{1, 1, 1}}, {{h, h, h}});
  const MeshPart<3> part  = distribute(mesh, {0}, MPI_COMM_SELF);
  const MeshOperator<3> op(part, {{isotropic_stiffness<3>(E, nu), rho}}, MPI_COMM_SELF);
  const double exact = std::sqrt(4. * (3. * lambda_2mu - 4. * mu) / (rho * h * h));
  const FrequencyEstimate found = largest_frequency(op);
  EXPECT_NEAR(found.lower, exact, 1e-9 * exact);
  EXPECT_NEAR(found.upper, exact, 1e-9 * exact);
}

// Whatever the order of the points, which the start of the Lanczos iteration depends on.
TEST(HighestFrequency, OfTrianglesInAnyOrder)
{
  std::array<unsigned int, 6> order;
  std::iota(order.begin(), order.end(), 0U);
  double exact = 0.;
  do
    {
      const MeshPart<2> part = distribute(triangles(order), {0, 0, 0, 0}, MPI_COMM_SELF);
      const MeshOperator<2> op(part,
                               {{isotropic_stiffness<2>(3e9, 0.35), 1000.},
                                {isotropic_stiffness<2>(70e9, 0.2), 2000.}},
                               MPI_COMM_SELF);
      if (exact == 0.)
        exact = exact_frequency(op);
      const FrequencyEstimate found = largest_frequency(op);
      ASSERT_NEAR(found.lower, exact, 1e-6 * exact);
      ASSERT_NEAR(found.upper, exact, 1e-6 * exact);
    }
  while (std::next_permutation(order.begin(), order.end()));
}
