// The solver on voxels against an assembled matrix of Q1 bricks (three Gauss points a
// direction, another path than the sums and differences of the kernel) and a direct solver.
#include "assembled_matrix.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace voxel_testing;

namespace
{
constexpr std::array<Sides, 3> all_sides = {{Sides::held, Sides::free, Sides::periodic}};

/** Calls function(component, node from 1, unknown). */
template <typename Function>
void for_each_unknown(const voxel::VoxelGrid &grid, const Function &function)
{
  long index = static_cast<long>(3) * grid.below() * grid.n_nodes(0) * grid.n_nodes(1);
  for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
    for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
      for (unsigned int i = 1; i <= grid.n_nodes(0); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          function(c, i, j, k, index++);
}

/** Kinds of phases. */
enum class Phases
{
  isotropic,
  general,
  isotropic_apart, ///< with mean dilatation in one of them
  general_apart,   ///< the same
  many_apart,      ///< the same
  many ///< the general ones, each under a hundred numbers, which a byte cannot hold
};

constexpr std::array<Phases, 6> all_phases = {
  {Phases::isotropic, Phases::general, Phases::many, Phases::isotropic_apart,
   Phases::general_apart, Phases::many_apart}};

/** The phases of a kind, each once. */
std::vector<ElasticPhase<3>> phases_of_kind(const Phases kind)
{
  return phases_of(kind != Phases::isotropic && kind != Phases::isotropic_apart,
                   kind == Phases::isotropic_apart || kind == Phases::general_apart ||
                     kind == Phases::many_apart);
}

voxel::Solver make_solver(const PhaseMap<3> &map,
                          const std::vector<ElasticPhase<3>> &phases,
                          const Phases kind,
                          const Sides sides)
{
  if (kind != Phases::many && kind != Phases::many_apart)
    return {map, phases, sides, MPI_COMM_WORLD};
  const std::size_t n = phases.size();
  std::vector<ElasticPhase<3>> materials;
  for (std::size_t k = 0; k < 100 * n; ++k)
    materials.push_back(phases[k % n]);
  std::vector<std::uint16_t> id;
  for (const std::uint8_t phase : map.id)
    id.push_back(static_cast<std::uint16_t>(phase + n * (7 * id.size() % 100)));
  return {CellPlanes::of_whole(map.grid, CellView(id), MPI_COMM_WORLD), materials, sides};
}

void compare_operator(const Phases kind, const Sides sides)
{
  const auto phases = phases_of_kind(kind);
  const PhaseMap<3> map =
    random_map({{19, 3, 7}}, static_cast<unsigned int>(phases.size()));
  voxel::Solver solver = make_solver(map, phases, kind, sides);
  const Assembled assembled(map, phases, sides);
  double modulus = 0.;
  for (const auto &phase : phases)
    modulus = std::max(modulus, phase.stiffness.cwiseAbs().maxCoeff());
  const double unit = map.grid.spacing[1] / (sides == Sides::free ? modulus : 1.);

  voxel::VoxelField<double> u(solver.grid()), out(solver.grid());
  const auto value = [](const long index) {
    return std::sin(0.3 + 1.7 * static_cast<double>(index));
  };
  Eigen::VectorXd v(assembled.K.rows());
  for (Eigen::Index index = 0; index < v.size(); ++index)
    v[index] = unit * value(index);
  for_each_unknown(solver.grid(),
                   [&](unsigned int c, unsigned int i, unsigned int j, unsigned int k,
                       long index) { u.row(c, j, k)[i] = value(index); });
  for (unsigned int load = 0; load < 6; ++load)
    {
      solver.residual(load, u, out);
      const Eigen::VectorXd expected = assembled.load.col(load) - assembled.K * v;
      const double scale             = expected.cwiseAbs().maxCoeff();
      for_each_unknown(solver.grid(), [&](unsigned int c, unsigned int i, unsigned int j,
                                          unsigned int k, long index) {
        ASSERT_NEAR(out.row(c, j, k)[i], expected[index], 1e-12 * scale)
          << "load " << load << ", node " << i << ' ' << j << ' ' << k << ", " << c;
      });
    }
}

void compare_solution(const Phases kind,
                      const Sides sides,
                      const std::array<unsigned int, 3> cells)
{
  const auto phases     = phases_of_kind(kind);
  const PhaseMap<3> map = random_map(cells, static_cast<unsigned int>(phases.size()));
  voxel::Solver solver  = make_solver(map, phases, kind, sides);
  const Assembled assembled(map, phases, sides);
  for (const SolverReport &report : solver.solve_all(1e-11))
    {
      EXPECT_LE(report.residual, 1e-11);
      EXPECT_LE(report.iterations, 80U);
    }
  const Eigen::MatrixXd u        = assembled.solve();
  const VoigtMatrix<3> expected  = assembled.effective(u),
                       effective = solver.effective_stiffness();
  EXPECT_LE((effective - expected).norm(), 1e-10 * expected.norm()) << effective << "\n\n"
                                                                    << expected;

  // Differences from the first node of a cell have no translation; strains no rotation.
  const double scale = u.cwiseAbs().maxCoeff() / (cells[0] * map.grid.spacing[0]);
  const voxel::VoxelGrid &grid = solver.grid();
  const unsigned int first     = grid.below() + grid.first_cell_plane() - grid.first();
  EXPECT_EQ(grid.is_divided()
              ? dealii::Utilities::MPI::sum(grid.n_cell_planes(), MPI_COMM_WORLD)
              : grid.n_cell_planes(),
            cells[2]);
  voxel::Solver::RowOfCells row;
  for (unsigned int k = 0; k < grid.n_cell_planes(); ++k)
    for (unsigned int j = 0; j < cells[1]; ++j)
      {
        solver.evaluate(j, k, row);
        for (unsigned int i = 0; i < cells[0]; ++i)
          {
            const std::array<unsigned int, 3> cell = {{i, j, k + first}};
            ASSERT_EQ(row.phase[i] % phases.size(),
                      map.id[(cell[2] * cells[1] + j) * cells[0] + i]);
            for (unsigned int load = 0; load < 6; ++load)
              {
                VoigtVector<3> found;
                for (unsigned int m = 0; m < 6; ++m)
                  found[m] = row.strain[load][m][i];
                const VoigtVector<3> strain = assembled.strain(u, load, cell);
                ASSERT_LE((found - strain).norm(), 1e-8 * scale + 1e-9 * strain.norm())
                  << "load " << load << ", cell " << i << ' ' << j << ' ' << cell[2]
                  << ": " << found.transpose() << ", " << strain.transpose();
              }
          }
      }
}
} // namespace

TEST(VoxelSolver, OperatorIsTheAssembledMatrix)
{
  for (const Phases kind : all_phases)
    for (const Sides sides : all_sides)
      {
        SCOPED_TRACE(static_cast<int>(sides));
        compare_operator(kind, sides);
      }
}

TEST(VoxelSolver, SolutionsAreThoseOfTheAssembledMatrix)
{
  for (const Sides sides : all_sides)
    {
      SCOPED_TRACE(static_cast<int>(sides));
      compare_solution(Phases::isotropic, sides, {{7, 5, 6}});
      compare_solution(Phases::isotropic, sides, {{4, 3, 17}});
      compare_solution(Phases::general, sides, {{5, 6, 3}});
      compare_solution(Phases::many, sides, {{5, 6, 3}});
      compare_solution(Phases::isotropic_apart, sides, {{7, 5, 6}});
      compare_solution(Phases::general_apart, sides, {{5, 6, 3}});
      compare_solution(Phases::many_apart, sides, {{5, 6, 3}});
    }
}

/** Against the numbers themselves: half a multiple of 2^-47 of the largest, ghosts too. */
TEST(VoxelSolver, PackedFieldsKeepTheirNumbers)
{
  voxel::VoxelGrid grid;
  grid.cells   = {{19, 3, 4}};
  grid.spacing = {{1., 1., 1.}};
  grid.sides   = Sides::periodic;
  voxel::VoxelField<double> field(grid);
  const voxel::PackedField zero(field);
  for_each_unknown(grid, [&](unsigned int c, unsigned int i, unsigned int j,
                             unsigned int k, long index) {
    field.row(c, j, k)[i] = 3. * std::sin(0.3 + 1.7 * static_cast<double>(index));
  });
  field.set_ghosts();
  const voxel::PackedField packed(field);
  std::vector<double> row(packed.n_in_row());
  ASSERT_EQ(row.size(), 21U);
  for (unsigned int k = 0; k <= 5; ++k)
    for (unsigned int j = 0; j <= 4; ++j)
      for (unsigned int c = 0; c < 3; ++c)
        {
          packed.read_row(c, j, k, row.data());
          for (unsigned int i = 0; i < 21; ++i)
            ASSERT_NEAR(row[i], field.row(c, j, k)[i], 3. * std::ldexp(0.51, -47));
          zero.read_row(c, j, k, row.data());
          for (const double number : row)
            ASSERT_EQ(number, 0.);
        }
  field.row(1, 2, 3)[4] = std::nan("");
  EXPECT_THROW(voxel::PackedField{field}, std::invalid_argument);
}

TEST(VoxelSolver, HomogeneousBoxesAreExact)
{
  PhaseMap<3> map = random_map({{5, 4, 8}}, 1);
  for (const Sides sides : all_sides)
    {
      voxel::Solver solver(map, phases_of(true), sides, MPI_COMM_WORLD);
      for (const SolverReport &report : solver.solve_all(1e-10))
        EXPECT_LE(report.iterations, sides == Sides::free ? 20U : 0U);
      const VoigtMatrix<3> C = phases_of(true)[0].stiffness;
      EXPECT_LE((solver.effective_stiffness() - C).norm(), 1e-12 * C.norm());
    }
}

TEST(VoxelSolver, OneLayerOfCells)
{
  for (const Sides sides : {Sides::free, Sides::periodic})
    compare_solution(Phases::isotropic, sides, {{6, 7, 1}});
  // No node is free.
  const PhaseMap<3> map = random_map({{6, 7, 1}}, 2);
  const auto phases     = phases_of(false);
  voxel::Solver held(map, phases, Sides::held);
  EXPECT_EQ(held.solve_all(1e-8)[0].iterations, 0U);
  VoigtMatrix<3> mean = VoigtMatrix<3>::Zero();
  for (const std::uint8_t id : map.id)
    mean += phases[id].stiffness / 42.;
  EXPECT_LE((held.effective_stiffness() - mean).norm(), 1e-12 * mean.norm());
}

TEST(VoxelSolver, RefusesAPhaseWithoutStiffness)
{
  const PhaseMap<3> map = random_map({{3, 3, 3}}, 3);
  EXPECT_THROW(voxel::Solver(map, phases_of(false), Sides::held), std::invalid_argument);
}

/** Odd and even sizes, contrasts, incompressible phases and flat cells converge alike. */
TEST(VoxelSolver, IterationsAreBounded)
{
  struct Case
  {
    unsigned int n;
    double contrast, nu;
    unsigned int most;
  };
  for (const Case &c :
       {Case{16, 8., 0.3, 20}, Case{27, 8., 0.3, 20}, Case{20, 1e3, 0.3, 60},
        Case{20, 1e-4, 0.3, 30}, Case{16, 8., 0.499, 70}})
    for (const Sides sides : all_sides)
      {
        PhaseMap<3> map{{{{c.n, c.n, c.n}}, {{1., 1., 1.}}, {}}, {}};
        for (std::size_t cell = 0; cell < map.grid.n_cells(); ++cell)
          {
            const std::size_t x = cell % c.n, y = cell / c.n % c.n, z = cell / c.n / c.n;
            const auto part = [&c](const std::size_t i) {
              return std::abs((static_cast<double>(i) + 0.5) / c.n - 0.5);
            };
            map.id.push_back(std::hypot(part(x), part(y), part(z)) < 0.35 ? 1 : 0);
          }
        voxel::Solver solver(map,
                             {{isotropic_stiffness<3>(1., c.nu), 0.},
                              {isotropic_stiffness<3>(c.contrast, 0.2), 0.}},
                             sides);
        for (const unsigned int load : {0U, 4U})
          EXPECT_LE(solver.solve(load, 1e-8).iterations, c.most)
            << c.n << ' ' << c.contrast << ' ' << c.nu << ' ' << static_cast<int>(sides);
      }
}
