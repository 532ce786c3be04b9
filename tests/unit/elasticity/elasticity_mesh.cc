// Bodies on a mesh of deal.II against those on a grid.

#include "base/errors.h"
#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"
#include "elasticity_testing.h"

#include <gtest/gtest.h>
#include <mpi.h>

#include <numeric>

using namespace elasticity_testing;

namespace
{
/** Whatever an ElasticBody is asked for, but solves. */
void expect_equal(const ElasticBody<2> &mesh, const ElasticBody<2> &grid, Random &random)
{
  NodalField<double> u = grid.zero_field(), f = u, g = u;
  random.fill(u);
  grid.update_copies(u);
  grid.vmult(f, u);
  mesh.vmult(g, u);
  EXPECT_LT(largest_difference(f, g), 1e-13);
  EXPECT_NEAR(mesh.total_mass(), grid.total_mass(), 1e-12 * grid.total_mass());
  EXPECT_NEAR(mesh.volume(), grid.volume(), 1e-12 * grid.volume());
  const auto m = mesh.lumped_mass(), n = grid.lumped_mass();
  for (std::size_t k = 0; k < n.size(); ++k)
    ASSERT_NEAR(m[k], n[k], 1e-14);
  for (unsigned int side = 0; side < 4; ++side)
    for (std::size_t k = 0; k < grid.surface(side).nodes.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
        ASSERT_NEAR(mesh.surface(side).normal_area.at(k)[d],
                    grid.surface(side).normal_area[k][d], 1e-13);

  ElasticBody<2>::Cells all, some;
  for (std::size_t group = 0; group < mesh.n_cell_groups(); ++group)
    {
      mesh.evaluate(u, group, some);
      all.phase.insert(all.phase.end(), some.phase.begin(), some.phase.end());
      all.strain.insert(all.strain.end(), some.strain.begin(), some.strain.end());
    }
  std::size_t k = 0;
  for (std::size_t group = 0; group < grid.n_cell_groups(); ++group)
    {
      grid.evaluate(u, group, some);
      for (std::size_t i = 0; i < some.phase.size(); ++i, ++k)
        {
          ASSERT_EQ(all.phase.at(k), some.phase[i]);
          // Displacements of one in cells of about a tenth: strains of ten.
          ASSERT_LT((all.strain[k] - some.strain[i]).norm(), 4e-13);
        }
    }
}
} // namespace

TEST(MeshBody, EqualsGridBody)
{
  Random random;
  SCOPED_TRACE(seed);
  for (const auto &cells : shapes())
    for (const bool anisotropic : {false, true})
      for (const Periodicity periodicity : {Periodicity{}, {true, false}, {true, true}})
        {
          SCOPED_TRACE(std::to_string(cells[0]) + " x " + std::to_string(cells[1]));
          const UniformMaterial material =
            random_material(random, cells, 3, anisotropic, false, periodicity);
          expect_equal(MeshBody<2>(mesh_of_grid(material), MPI_COMM_WORLD),
                       GridBody<2>(material), random);
        }
}

// Linear displacements are exact on any mesh: the forces are those of a uniform stress.
TEST(MeshBody, TrianglesPassThePatchTest)
{
  Random random;
  SCOPED_TRACE(seed);
  const UniformMaterial material = random_material(random, {{7, 5}}, 1, true, true);
  MeshBodyInput<2> input         = mesh_of_grid(material);
  input.mesh                     = cut_into_triangles(input.mesh);
  for (auto &p : input.mesh.points)
    if (p[0] > 0.1 && p[0] < 4.8 && p[1] > 0.1 && p[1] < 4.4)
      for (unsigned int d = 0; d < 2; ++d)
        p[d] += random(-0.1, 0.1);
  const MeshBody<2> body(input, MPI_COMM_WORLD);
  const VoigtVector<2> strain(0.3, -0.2, 0.5);
  const VoigtVector<2> stress = body.phases()[0].stiffness * strain;
  NodalField<double> u = body.zero_field(), f = u, expected = u;
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    for (unsigned int i = 0; i < u.n_columns(); ++i)
      {
        const auto [x, y] = body.point({i, j});
        u.row(0, j)[i]    = strain[0] * x + 0.5 * strain[2] * y;
        u.row(1, j)[i]    = strain[1] * y + 0.5 * strain[2] * x;
      }
  for (unsigned int side = 0; side < 4; ++side)
    for (std::size_t k = 0; k < body.surface(side).nodes.size(); ++k)
      {
        const auto [nx, ny] = body.surface(side).normal_area[k];
        expected(0, body.surface(side).nodes[k]) += stress[0] * nx + stress[2] * ny;
        expected(1, body.surface(side).nodes[k]) += stress[2] * nx + stress[1] * ny;
      }
  body.vmult(f, u);
  EXPECT_LT(largest_difference(f, expected), 1e-13);
  const auto mass = body.lumped_mass();
  EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.), body.total_mass(), 1e-12);
  ElasticBody<2>::Cells cells;
  body.evaluate(u, 0, cells);
  for (const VoigtVector<2> &found : cells.strain)
    EXPECT_LT((found - strain).norm(), 1e-13);
}

TEST(MeshBody, RefusesSidesThatDoNotMatch)
{
  Random random;
  MeshBodyInput<2> input =
    mesh_of_grid(random_material(random, {{4, 3}}, 1, false, true));
  input.periodicity = {true, false};
  input.mesh.points[5][1] += 1e-3;
  EXPECT_THROW(MeshBody<2>(input, MPI_COMM_WORLD), UserError);
  input.mesh.points[5][1] = -5.;
  EXPECT_THROW(MeshBody<2>(input, MPI_COMM_WORLD), UserError);
}

TEST(MeshBody, RefusesToSolveOnMoreRanksThanCells)
{
  int n_ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  Random random;
  const MeshBody<2> body(mesh_of_grid(random_material(random, {{1, 1}}, 1, false, true)),
                         MPI_COMM_WORLD);
  if (n_ranks > 1)
    {
      EXPECT_THROW(body.make_solver(), UserError);
    }
}
