#include "base/errors.h"
#include "elasticity/uniform_grid_operator.h"
#include "elasticity_testing.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

using namespace elasticity_testing;

TEST(NodalField, RowsBeginOnACacheLineAndAreZero)
{
  // Small ones, and large ones whose pages are asked for at once.
  for (const unsigned int n : {0u, 1u, 7u, 8191u, 8192u, 100001u, 1000000u})
    {
      // Memory that is taken again is not clean.
      NodalField<double>(n, 1).row(0, 0)[0] = 1.;
      const NodalField<double> field(n, 1);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(field.row(0, 0)) % 64, 0u) << n;
      EXPECT_EQ(std::count(field.begin(), field.begin() + field.size(), 0.),
                static_cast<long>(field.size()));
    }
}

TEST(Element, EigenvaluesOfTheSquare)
{
  // omega^2 rho h^2 of one cell with quarter masses.
  const double lambda = 1.7, mu = 0.9, rho = 2.1, h = 0.3;
  const UniformGrid<2> grid{{{1, 1}}, {{h, h}}};
  const UniformMaterial material(grid, {{plane_strain(lambda, mu), rho}});
  const UniformGridOperator K(material);
  ElementMatrix matrix;
  NodalField<double> u(2, 2), f(2, 2);
  for (int k = 0; k < 8; ++k)
    {
      u.set_zero();
      u.row(k % 2, k / 4)[k / 2 % 2] = 1.;
      K.vmult(f, u);
      for (int l = 0; l < 8; ++l)
        matrix(l, k) = f.row(l % 2, l / 4)[l / 2 % 2];
    }
  EXPECT_LT(
    (matrix - element_matrix(plane_strain(lambda, mu), h, h)).cwiseAbs().maxCoeff(),
    1e-14);
  const Eigen::VectorXd eigenvalues =
    Eigen::SelfAdjointEigenSolver<ElementMatrix>(matrix).eigenvalues() * 4.;
  std::vector<double> expected = {0.,
                                  0.,
                                  0.,
                                  4. * (lambda + 3. * mu) / 3.,
                                  4. * (lambda + 3. * mu) / 3.,
                                  8. * mu,
                                  8. * mu,
                                  8. * (lambda + mu)};
  std::sort(expected.begin(), expected.end());
  for (int k = 0; k < 8; ++k)
    EXPECT_NEAR(eigenvalues(k), expected[k], 1e-12);
}

TEST(UniformGridOperator, EqualsDenseElements)
{
  Random random;
  SCOPED_TRACE(seed);
  for (const InstructionSet isa : available_instruction_sets())
    for (const bool anisotropic : {false, true})
      for (const unsigned int n_classes : {1, 2, 5, 13, 30, 40, 256})
        for (const auto &cells : shapes())
          for (const Periodicity p : {Periodicity{false, false}, Periodicity{true, false},
                                      Periodicity{false, true}, Periodicity{true, true}})
            {
              const UniformMaterial material =
                random_material(random, cells, n_classes, anisotropic, false, p);
              NodalField<double> u(material.n_columns(), material.n_rows()), f(u);
              random.fill(u);
              material.update_copies(u);
              const NodalField<double> reference = reference_product(material, u);
              const UniformGridOperator K(material, isa);
              K.vmult(f, u);
              ASSERT_LT(largest_difference(reference, f), 4e-14)
                << to_string(isa) << " classes " << n_classes << " cells " << cells[0]
                << "x" << cells[1] << " periodic " << p.x << p.y;
              for (unsigned int i = f.n_columns(); i < f.component_stride(); ++i)
                ASSERT_EQ(f.row(0, 0)[i], 0.) << "padding must stay zero";

              NodalField<float> u_float(u.n_columns(), u.n_rows()), f_float(u_float);
              u_float.convert_from(u);
              K.vmult(f_float, u_float);
              ASSERT_LT(largest_difference(reference, f_float), 2e-5);
            }
}

TEST(UniformGridOperator, SlabsEqualTheWhole)
{
  Random random;
  const UniformMaterial material = random_material(random, {{21, 17}}, 3, true, false);
  const UniformGridOperator whole(material);
  NodalField<double> u(22, 18), f(u);
  random.fill(u);
  whole.vmult(f, u);
  for (const auto &range : {std::array<unsigned int, 2>{{0, 5}}, {{5, 6}}, {{6, 18}}})
    {
      const NodeRows rows = {18, range[0], range[1]};
      const UniformGridOperator slab(material, rows);
      NodalField<double> part(22, rows.n_local()), result(part);
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = rows.first(); j < rows.last(); ++j)
          std::copy_n(u.row(c, j), 22, part.row(c, rows.local(j)));
      slab.vmult(result, part);
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = rows.begin; j < rows.end; ++j)
          for (unsigned int i = 0; i < 22; ++i)
            ASSERT_EQ(result.row(c, rows.local(j))[i], f.row(c, j)[i]);
    }
}

TEST(UniformGridOperator, Diagonal)
{
  Random random;
  for (const Periodicity p : {Periodicity{false, false}, Periodicity{true, true}})
    {
      const UniformMaterial material =
        random_material(random, {{6, 5}}, 4, true, false, p);
      const UniformGridOperator K(material);
      NodalField<double> u(7, 6), f(u), diagonal(u);
      K.diagonal(diagonal);
      for (unsigned int j = 0; j < 6; ++j)
        for (unsigned int i = 0; i < 7; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            {
              u.set_zero();
              u.row(c, p.y ? j % 5 : j)[p.x ? i % 6 : i] = 1.;
              material.update_copies(u);
              K.vmult(f, u);
              ASSERT_NEAR(diagonal.row(c, j)[i], f.row(c, j)[i], 1e-13);
            }
    }
}

TEST(UniformGridOperator, RigidMotionAndConstantStrain)
{
  // Linear fields: no force at inner nodes of a homogeneous body, strain exact, energy
  // 1/2 eps.D.eps times area; rotation and translation: no force at all.
  Random random;
  const UniformMaterial material = random_material(random, {{11, 9}}, 1, true, false);
  const UniformGridOperator K(material);
  const double hx = 0.7, hy = 0.9;
  const double gradients[3][4] = {{0, 1, -1, 0}, {0, 0, 0, 0}, {0.3, -0.2, 0.5, 0.7}};
  for (const auto &g : gradients)
    {
      NodalField<double> u(12, 10), f(u);
      for (unsigned int j = 0; j < 10; ++j)
        for (unsigned int i = 0; i < 12; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            u.row(c, j)[i] = 0.4 + g[2 * c] * i * hx + g[2 * c + 1] * j * hy;
      K.vmult(f, u);
      const VoigtVector<2> strain(g[0], g[3], g[1] + g[2]);
      const bool rigid = strain.norm() == 0.;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < 10; ++j)
          for (unsigned int i = 0; i < 12; ++i)
            if (rigid || (i > 0 && i < 11 && j > 0 && j < 9))
              {
                ASSERT_NEAR(f.row(c, j)[i], 0., 3e-14);
              }
      const VoigtMatrix<2> &D = material.phases()[0].stiffness;
      const double area       = 11 * 9 * hx * hy;
      EXPECT_NEAR(K.elastic_energy(u), 0.5 * strain.dot(D * strain) * area, 1e-11);
      std::vector<double> exx(11), eyy(11), gxy(11);
      for (unsigned int j = 0; j < 9; ++j)
        {
          K.strain(u, j, exx.data(), eyy.data(), gxy.data());
          for (unsigned int i = 0; i < 11; ++i)
            {
              ASSERT_NEAR(exx[i], strain(0), 2e-14);
              ASSERT_NEAR(eyy[i], strain(1), 2e-14);
              ASSERT_NEAR(gxy[i], strain(2), 2e-14);
            }
        }
    }
}

TEST(UniformGridOperator, EnergyCountsCopiesOnce)
{
  Random random;
  const Periodicity p{true, true};
  const UniformMaterial material = random_material(random, {{9, 4}}, 3, false, false, p);
  const UniformGridOperator K(material);
  NodalField<double> u(10, 5);
  random.fill(u);
  material.update_copies(u);
  double energy = 0.;
  for (unsigned int j = 0; j < 4; ++j)
    for (unsigned int i = 0; i < 9; ++i)
      {
        Eigen::Matrix<double, 8, 1> z;
        for (int k = 0; k < 8; ++k)
          z(k) = u.row(k % 2, j + k / 4)[i + k / 2 % 2];
        energy +=
          0.5 * z.dot(element_matrix(material.phases()[material.phase_of(i, j)].stiffness,
                                     0.7, 0.9) *
                      z);
      }
  EXPECT_NEAR(K.elastic_energy(u), energy, 1e-12 * energy);
}

TEST(UniformMaterial, MassAndChecks)
{
  Random random;
  for (const Periodicity p : {Periodicity{false, false}, Periodicity{true, false},
                              Periodicity{false, true}, Periodicity{true, true}})
    {
      const UniformMaterial material =
        random_material(random, {{7, 4}}, 5, false, false, p);
      std::vector<double> mass(8);
      double sum = 0., cells = 0.;
      for (unsigned int j = 0; j < (p.y ? 4 : 5); ++j)
        {
          material.mass_row(j, mass.data());
          for (unsigned int i = 0; i < (p.x ? 7 : 8); ++i)
            sum += mass[i];
          if (p.x)
            {
              EXPECT_EQ(mass[0], mass[7]);
            }
        }
      for (unsigned int j = 0; j < 4; ++j)
        for (unsigned int i = 0; i < 7; ++i)
          cells += 0.7 * 0.9 * material.phases()[material.phase_of(i, j)].density;
      EXPECT_NEAR(sum, cells, 1e-13);
      EXPECT_NEAR(material.total_mass(), cells, 1e-13);
    }
  const UniformGrid<2> grid{{{2, 1}}, {{1., 1.}}};
  const ElasticPhase<2> good{plane_strain(1., 1.), 1.};
  ElasticPhase<2> no_mass = good, indefinite = good;
  no_mass.density            = 0.;
  indefinite.stiffness(2, 2) = -1.;
  EXPECT_THROW(UniformMaterial(grid, {no_mass}), std::invalid_argument);
  EXPECT_THROW(UniformMaterial(grid, {indefinite}), std::invalid_argument);
  EXPECT_THROW(UniformMaterial(grid, {good}, {0, 1}), std::invalid_argument);
  EXPECT_THROW(UniformMaterial(grid, {good}, {0}), std::invalid_argument);
  // A class that no cell uses may be anything; one class used everywhere is homogeneous.
  EXPECT_TRUE(UniformMaterial(grid, {no_mass, good}, {1, 1}).is_homogeneous());
}

TEST(InstructionSet, NamedByEnvironment)
{
  const char *const before = std::getenv("MESOSLIP_ISA");
  const std::string saved  = before ? before : "";
  setenv("MESOSLIP_ISA", "x86-64", 1);
  EXPECT_EQ(resolve(InstructionSet::automatic), InstructionSet::baseline);
  setenv("MESOSLIP_ISA", "itanium", 1);
  EXPECT_THROW(resolve(InstructionSet::automatic), UserError);
  setenv("MESOSLIP_ISA", saved.c_str(), 1);
}
