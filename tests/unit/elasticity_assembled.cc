#include "elasticity/assembled_operator.h"
#include "elasticity/uniform_grid_operator.h"
#include "elasticity_testing.h"

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/trilinos_vector.h>

#include <gtest/gtest.h>
#include <mpi.h>

using namespace elasticity_testing;
using dealii::TrilinosWrappers::MPI::Vector;

namespace
{
/** The cells of a uniform grid with their classes as material ids. */
void make_triangulation(dealii::Triangulation<2> &triangulation,
                        const UniformMaterial &material)
{
  const UniformGrid<2> &grid = material.grid();
  dealii::GridGenerator::subdivided_hyper_rectangle(
    triangulation, {grid.cells[0], grid.cells[1]}, dealii::Point<2>(0., 0.),
    dealii::Point<2>(grid.extent(0), grid.extent(1)));
  for (const auto &cell : triangulation.active_cell_iterators())
    cell->set_material_id(
      material.class_of(static_cast<unsigned int>(cell->center()[0] / grid.spacing[0]),
                        static_cast<unsigned int>(cell->center()[1] / grid.spacing[1])));
}

/** Calls visit(degree of freedom, component, row, column) for those owned here. */
template <typename Visit>
void for_owned(const AssembledOperator<2> &K,
               const UniformGrid<2> &grid,
               const Visit &visit)
{
  std::vector<dealii::types::global_dof_index> dofs(8);
  for (const auto &cell : K.dof_handler().active_cell_iterators())
    if (!cell->is_artificial())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < 8; ++k)
          if (K.dof_handler().locally_owned_dofs().is_element(dofs[k]))
            visit(dofs[k], k % 2, std::lround(cell->vertex(k / 2)[1] / grid.spacing[1]),
                  std::lround(cell->vertex(k / 2)[0] / grid.spacing[0]));
      }
}

void compare(const UniformMaterial &material, Random &random)
{
  dealii::parallel::shared::Triangulation<2> triangulation(
    MPI_COMM_WORLD, dealii::Triangulation<2>::none, false,
    dealii::parallel::shared::Triangulation<2>::partition_metis);
  make_triangulation(triangulation, material);
  std::vector<VoigtMatrix<2>> stiffness;
  std::vector<double> density;
  for (const ElasticClass &c : material.classes())
    {
      stiffness.push_back(c.stiffness);
      density.push_back(c.density);
    }
  const AssembledOperator<2> assembled(triangulation, stiffness, density);
  const UniformGridOperator uniform(material);

  NodalField<double> u(material.n_columns(), material.n_rows()), f(u), diagonal(u);
  random.fill(u);
  uniform.vmult(f, u);
  uniform.diagonal(diagonal);
  Vector x, y, d;
  assembled.initialize_vector(x);
  assembled.initialize_vector(y);
  for_owned(assembled, material.grid(),
            [&](auto dof, auto c, auto j, auto i) { x[dof] = u.row(c, j)[i]; });
  x.compress(dealii::VectorOperation::insert);
  assembled.vmult(y, x);
  assembled.diagonal(d);
  std::vector<double> mass(material.n_columns());
  for_owned(assembled, material.grid(), [&](auto dof, auto c, auto j, auto i) {
    material.mass_row(j, mass.data());
    ASSERT_NEAR(y[dof], f.row(c, j)[i], 4e-14);
    ASSERT_NEAR(d[dof], diagonal.row(c, j)[i], 4e-14);
    ASSERT_NEAR(assembled.lumped_mass()[dof], mass[i], 1e-14);
  });
  const double energy = uniform.elastic_energy(u);
  EXPECT_NEAR(assembled.elastic_energy(x), energy, 1e-12 * energy);
}
} // namespace

TEST(AssembledOperator, EqualsUniformGridOperator)
{
  Random random;
  SCOPED_TRACE(seed);
  for (const auto &cells : {std::array<unsigned int, 2>{{37, 13}}, {{2, 7}}, {{8, 3}}})
    for (const bool anisotropic : {false, true})
      for (const unsigned int n_classes : {1, 2, 12})
        compare(random_material(random, cells, n_classes, anisotropic, false), random);
}

TEST(AssembledOperator, EqualsUniformGridOperatorOnRandomGrids)
{
  Random random;
  SCOPED_TRACE(seed);
  for (unsigned int member = 0; member < 30; ++member)
    {
      UniformGrid<2> grid;
      grid.cells         = {{2 + random.integer(30), 2 + random.integer(30)}};
      grid.spacing       = {{random(0.2, 2.), random(0.2, 2.)}};
      const double lower = std::min(grid.spacing[0], grid.spacing[1]),
                   upper = std::max(grid.spacing[0], grid.spacing[1]);
      std::vector<ElasticClass> classes(1 + random.integer(6));
      for (ElasticClass &c : classes) // forces of order one whatever the shape
        c = {random.stiffness(true) * lower / upper, random(0.1, 1.)};
      std::vector<std::uint8_t> ids;
      for (std::size_t i = 0; i < grid.n_cells(); ++i)
        ids.push_back(random.integer(classes.size()));
      SCOPED_TRACE(std::to_string(grid.cells[0]) + " x " + std::to_string(grid.cells[1]));
      compare(UniformMaterial(grid, classes, ids), random);
    }
}

TEST(AssembledOperator, ConstantStrainInThreeDimensions)
{
  // Every component of strain: the energy shows Voigt order and engineering shear.
  dealii::parallel::shared::Triangulation<3> triangulation(
    MPI_COMM_WORLD, dealii::Triangulation<3>::none, false,
    dealii::parallel::shared::Triangulation<3>::partition_metis);
  dealii::GridGenerator::subdivided_hyper_rectangle(
    triangulation, {3, 2, 2}, dealii::Point<3>(), dealii::Point<3>(1.5, 1., 2.));
  Random random;
  VoigtMatrix<3> A;
  for (int i = 0; i < 36; ++i)
    A(i / 6, i % 6) = random();
  const VoigtMatrix<3> D = A * A.transpose();
  const AssembledOperator<3> K(triangulation, {D}, {2.});
  Eigen::Matrix3d g;
  for (int i = 0; i < 9; ++i)
    g(i / 3, i % 3) = random();
  VoigtVector<3> strain;
  strain << g(0, 0), g(1, 1), g(2, 2), g(1, 2) + g(2, 1), g(0, 2) + g(2, 0),
    g(0, 1) + g(1, 0);

  Vector u;
  K.initialize_vector(u);
  std::vector<dealii::types::global_dof_index> dofs(24);
  for (const auto &cell : K.dof_handler().active_cell_iterators())
    if (!cell->is_artificial())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int k = 0; k < 24; ++k)
          if (K.dof_handler().locally_owned_dofs().is_element(dofs[k]))
            {
              const dealii::Point<3> &x = cell->vertex(k / 3);
              u[dofs[k]] = g(k % 3, 0) * x[0] + g(k % 3, 1) * x[1] + g(k % 3, 2) * x[2];
            }
      }
  u.compress(dealii::VectorOperation::insert);
  EXPECT_NEAR(K.elastic_energy(u), 0.5 * strain.dot(D * strain) * 3., 1e-12);
  EXPECT_NEAR(K.lumped_mass().mean_value() * K.lumped_mass().size(), 3. * 2. * 3., 1e-12);
}
