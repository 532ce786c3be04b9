#include "homogenization/volumes/mesh_volume.h"
#include "mesh/triangulation_cells.h"

#include "homogenization/response.h"
#include "homogenization/volumes/grid_volume.h"
#include "material/stiffness.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace mesoslip;

namespace
{
enum class Kind
{
  simplices, ///< triangles, tetrahedra
  cubes,     ///< quadrilaterals, hexahedra
  mixed      ///< triangles and quadrilaterals
};

bool is_root()
{
  return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

/**
 * The unit box of n cells along each axis (one along z if @p one_layer), each cut into
 * simplices along its diagonal where @p kind says so. Inner points that are not in the
 * plane x = 1/2 are moved about. On rank 0; empty on the others.
 */
template <int dim>
Mesh<dim> box(const unsigned int n,
              const Kind kind,
              const std::function<unsigned int(const dealii::Point<dim> &)> &phase,
              const bool one_layer    = false,
              const double distortion = 0.2)
{
  Mesh<dim> mesh;
  mesh.phases = {"a", "b"};
  if (!is_root())
    return mesh;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-distortion / n, distortion / n);
  std::array<unsigned int, 3> cells = {{n, n, dim == 3 && !one_layer ? n : 1}};
  const unsigned int layers         = dim == 3 ? cells[2] + 1 : 1;
  for (unsigned int k = 0; k < layers; ++k)
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          const std::array<unsigned int, 3> at = {{i, j, k}};
          dealii::Point<dim> point;
          bool inside = 2 * i != n;
          for (unsigned int d = 0; d < dim; ++d)
            {
              point[d] = static_cast<double>(at[d]) / cells[d];
              inside   = inside && at[d] > 0 && at[d] < cells[d];
            }
          for (unsigned int d = 0; d < dim && inside; ++d)
            point[d] += shift(random);
          mesh.points.push_back(point);
        }
  for (unsigned int k = 0; k < (dim == 3 ? cells[2] : 1); ++k)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          std::vector<unsigned int> corners;
          dealii::Point<dim> middle;
          for (unsigned int v = 0; v < 1U << dim; ++v)
            {
              corners.push_back(((k + (v >> 2U)) * (n + 1) + j + ((v >> 1U) & 1U)) *
                                  (n + 1) +
                                i + (v & 1U));
              middle += mesh.points[corners.back()] / (1. * (1U << dim));
            }
          const auto add = [&](const std::vector<unsigned int> &vertices) {
            mesh.cells.emplace_back(vertices.size());
            mesh.cells.back().vertices    = vertices;
            mesh.cells.back().material_id = phase(middle);
          };
          if (kind == Kind::cubes || (kind == Kind::mixed && (i + j) % 2 == 0))
            {
              add(corners);
              continue;
            }
          // A simplex for each order in which the axes lead from corner to corner.
          std::array<unsigned int, dim> axes;
          std::iota(axes.begin(), axes.end(), 0);
          do
            {
              std::vector<unsigned int> simplex = {corners[0]};
              unsigned int v                    = 0;
              for (const unsigned int d : axes)
                simplex.push_back(corners[v |= 1U << d]);
              add(simplex);
            }
          while (std::next_permutation(axes.begin(), axes.end()));
        }
  auto of_dealii = to_dealii<dim>(mesh.cells);
  dealii::GridTools::invert_cells_with_negative_measure(mesh.points, of_dealii);
  mesh.cells = from_dealii<dim>(std::move(of_dealii));
  return mesh;
}

template <int dim>
double distance(const VoigtMatrix<dim> &a, const VoigtMatrix<dim> &b)
{
  return (a - b).norm() / b.norm();
}

/** Layers of equal thickness along x: no stress on the interface and no strain in it
 * jumps. */
template <int dim>
VoigtMatrix<dim> laminate(const std::array<VoigtMatrix<dim>, 2> &layers)
{
  const std::vector<int> n =
                           dim == 2 ? std::vector<int>{0, 2} : std::vector<int>{0, 4, 5},
                         t = dim == 2 ? std::vector<int>{1} : std::vector<int>{1, 2, 3};
  Eigen::MatrixXd nn       = Eigen::MatrixXd::Zero(n.size(), n.size()),
                  nt       = Eigen::MatrixXd::Zero(n.size(), t.size()),
                  tt       = Eigen::MatrixXd::Zero(t.size(), t.size());
  for (const Eigen::MatrixXd C : layers)
    {
      const Eigen::MatrixXd inverse = Eigen::MatrixXd(C(n, n)).inverse();
      nn += 0.5 * inverse;
      nt += 0.5 * inverse * C(n, t);
      tt += 0.5 * (C(t, t) - C(t, n) * inverse * C(n, t));
    }
  const Eigen::MatrixXd C_nn = nn.inverse(), C_nt = C_nn * nt,
                        C_tt = tt + nt.transpose() * C_nt, C_tn = C_nt.transpose();
  VoigtMatrix<dim> D;
  D(n, n) = C_nn;
  D(n, t) = C_nt;
  D(t, n) = C_tn;
  D(t, t) = C_tt;
  return D;
}

constexpr std::array<BoundaryCondition, 3> all_conditions = {
  {BoundaryCondition::KUBC, BoundaryCondition::SUBC, BoundaryCondition::PBC}};

template <int dim>
HomogenizedResponse<dim> respond(MeshVolume<dim> &volume,
                                 const std::vector<ElasticPhase<dim>> &phases,
                                 const BoundaryCondition condition)
{
  return homogenize<dim>(volume.solve(condition, 1e-12), phases);
}

template <int dim>
void check_patch_and_laminate(const Kind kind)
{
  const VoigtMatrix<dim> soft = isotropic_stiffness<dim>(3e9, 0.3),
                         hard = isotropic_stiffness<dim>(70e9, 0.2);
  const Mesh<dim> mesh =
    box<dim>(4, kind, [](const dealii::Point<dim> &p) { return p[0] > 0.5 ? 1U : 0U; });
  for (const BoundaryCondition condition : all_conditions)
    {
      const std::vector<ElasticPhase<dim>> same = {{hard, 1.}, {hard, 1.}};
      MeshVolume<dim> volume(mesh, same, MPI_COMM_WORLD);
      const HomogenizedResponse<dim> r = respond<dim>(volume, same, condition);
      EXPECT_LT(distance<dim>(r.stiffness, hard), 1e-11);
      EXPECT_LT(distance<dim>(r.stiffness_from_mean, hard), 1e-11);
      EXPECT_LT(r.mean_residual, 1e-11);
    }
  const std::vector<ElasticPhase<dim>> layers = {{soft, 1.}, {hard, 1.}};
  MeshVolume<dim> volume(mesh, layers, MPI_COMM_WORLD);
  const HomogenizedResponse<dim> r = respond<dim>(volume, layers, BoundaryCondition::PBC);
  EXPECT_LT(distance<dim>(r.stiffness, laminate<dim>({{soft, hard}})), 1e-11);
  EXPECT_LT(r.two_phase_residual.value_or(0.), 1e-9);
  // Strains are uniform in each layer, which is that of its phase.
  std::uint64_t n = 0;
  volume.for_each([&](const LocalCell<dim> &cell) {
    ++n;
    EXPECT_EQ(cell.phase, cell.centre[0] > 0.5 ? 1U : 0U);
    EXPECT_LT(distance<dim>(cell.strain.template leftCols<n_voigt<dim>>(),
                            r.phase_means[cell.phase]),
              1e-10);
  });
  const std::uint64_t n_cells = dealii::Utilities::MPI::max<std::uint64_t>(
    mesh.cells.size(), MPI_COMM_WORLD); // rank 0 has them
  EXPECT_EQ(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), n_cells);
}
} // namespace

TEST(MeshVolume, PatchTestAndLaminateAreExact)
{
  check_patch_and_laminate<2>(Kind::simplices);
  check_patch_and_laminate<2>(Kind::cubes);
  check_patch_and_laminate<2>(Kind::mixed);
  check_patch_and_laminate<3>(Kind::simplices);
  check_patch_and_laminate<3>(Kind::cubes);
}

// A grid handed in as a mesh, against the grid with its multigrid.
TEST(MeshVolume, GridAsMesh)
{
  constexpr unsigned int n = 12;
  const auto phase         = [](const dealii::Point<2> &p) {
    return static_cast<unsigned int>(p[0] * n) * static_cast<unsigned int>(p[1] * n) %
                 3 ==
               1
                     ? 1U
                     : 0U;
  };
  const std::vector<ElasticPhase<2>> phases = {{isotropic_stiffness<2>(3e9, 0.3), 1.},
                                               {isotropic_stiffness<2>(70e9, 0.2), 1.}};
  UniformGrid<2> grid;
  grid.cells   = {{n, n}};
  grid.spacing = {{1. / n, 1. / n}};
  std::vector<std::uint8_t> id;
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      id.push_back(phase({(i + 0.5) / n, (j + 0.5) / n}));
  const std::vector<BoundaryCondition> conditions(all_conditions.begin(),
                                                  all_conditions.end());
  GridVolume on_grid(grid, UniformMaterial(grid, phases, id), StaticSolverKind::multigrid,
                     conditions, 1e-12, MPI_COMM_SELF, {}, nullptr);
  MeshVolume<2> volume(box<2>(n, Kind::cubes, phase, false, 0.), phases, MPI_COMM_WORLD);
  for (const BoundaryCondition condition : conditions)
    {
      const HomogenizedResponse<2> of_mesh = respond<2>(volume, phases, condition),
                                   of_grid =
                                     homogenize<2>(on_grid.solve(condition, 0.), phases);
      EXPECT_LT(distance<2>(of_mesh.stiffness, of_grid.stiffness), 1e-10);
      EXPECT_LT(distance<2>(of_mesh.stiffness_from_mean, of_grid.stiffness_from_mean),
                1e-10);
      // Strains of all cells, by their centres.
      std::vector<UnitStrains<2>> strain;
      on_grid.for_each([&](const LocalCell<2> &cell) { strain.push_back(cell.strain); });
      volume.for_each([&](const LocalCell<2> &cell) {
        const auto i = static_cast<unsigned int>(cell.centre[0] * n),
                   j = static_cast<unsigned int>(cell.centre[1] * n);
        EXPECT_LT((cell.strain - strain[j * n + i]).cwiseAbs().maxCoeff(),
                  condition == BoundaryCondition::SUBC ? 1e-18 : 1e-9);
      });
    }
}

// One layer of hexahedra that is periodic along z is plane strain.
TEST(MeshVolume, ExtrudedIsPlaneStrain)
{
  const auto round = [](const double x, const double y) {
    return (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) < 0.1 ? 1U : 0U;
  };
  const std::vector<ElasticPhase<2>> phases = {{isotropic_stiffness<2>(3e9, 0.3), 1.},
                                               {isotropic_stiffness<2>(70e9, 0.2), 1.}};
  const std::vector<ElasticPhase<3>> solids = {{isotropic_stiffness<3>(3e9, 0.3), 1.},
                                               {isotropic_stiffness<3>(70e9, 0.2), 1.}};
  MeshVolume<2> plane(box<2>(
                        8, Kind::cubes,
                        [&](const dealii::Point<2> &p) { return round(p[0], p[1]); },
                        false, 0.),
                      phases, MPI_COMM_WORLD);
  MeshVolume<3> layer(box<3>(
                        8, Kind::cubes,
                        [&](const dealii::Point<3> &p) { return round(p[0], p[1]); },
                        true, 0.),
                      solids, MPI_COMM_WORLD);
  const auto D2 = respond<2>(plane, phases, BoundaryCondition::PBC).stiffness;
  const auto D3 = respond<3>(layer, solids, BoundaryCondition::PBC).stiffness;
  const std::vector<int> in_plane = {0, 1, 5};
  EXPECT_LT(distance<2>(VoigtMatrix<2>(D3(in_plane, in_plane)), D2), 1e-10);
}
