// Boxes of bricks: operator and stepper against the mesh of the same cells, on any number of
// ranks.
#include "dynamics/brick_stepper.h"
#include "dynamics/critical_time_step.h"
#include "dynamics/mesh_stepper.h"
#include "exchange/mesh_datasets.h"
#include "material/stiffness.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <random>

using namespace mesoslip;

namespace
{
struct Case
{
  std::array<unsigned int, 3> cells;
  std::array<double, 3> edges; ///< of a cell (m)
  enum
  {
    isotropic,
    orthotropic,
    any,
    many ///< materials, more than a byte can number
  } symmetry;
  std::array<bool, 2> periodic;
  bool mean_dilatation = false; ///< of all phases but the second
};

std::vector<ElasticPhase<3>> phases_of_case(const Case &c)
{
  std::vector<ElasticPhase<3>> phases = {{isotropic_stiffness<3>(30e9, 0.2), 1900.},
                                         {isotropic_stiffness<3>(240e9, 0.35), 2600.},
                                         {isotropic_stiffness<3>(3e9, 0.45), 1100.}};
  if (c.symmetry == Case::orthotropic)
    phases[1].stiffness.diagonal() +=
      (VoigtVector<3>() << 1e10, 3e10, 5e10, 2e10, 4e10, 6e10).finished();
  if (c.symmetry == Case::any || c.symmetry == Case::many)
    {
      std::mt19937 generator(5);
      std::uniform_real_distribution<double> uniform(-1., 1.);
      VoigtMatrix<3> A;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          A(i, j) = uniform(generator);
      phases[1].stiffness += 2e10 * (A * A.transpose());
    }
  for (unsigned int k = 3; c.symmetry == Case::many && k < 300; ++k)
    {
      phases.push_back(phases[1]);
      phases.back().stiffness =
        turn_stiffness(phases[1].stiffness, bunge_rotation(k, 2. * k, 3. * k));
      phases.back().density += k;
    }
  for (std::size_t k = 0; k < phases.size(); ++k)
    phases[k].mean_dilatation = c.mean_dilatation && k != 1;
  return phases;
}

/** The box, its mesh, and a brick operator of the given ranks. */
struct Box
{
  Box(const Case &c, const MPI_Comm communicator)
    : phases(phases_of_case(c))
    , box{{c.cells, c.edges, {}}, c.periodic}
    , mesh(mesh_of_cells(box.grid))
    , op(divide_box(box,
                    reader_of(box.grid, random_phases()),
                    static_cast<unsigned int>(phases.size()),
                    communicator),
         phases,
         communicator)
  {
    mesh.masters.resize(mesh.points.size());
    for (unsigned int p = 0; p < mesh.points.size(); ++p)
      mesh.masters[p] = master(p);
    const auto id = random_phases();
    for (std::size_t k = 0; k < id.size(); ++k)
      mesh.cells[k].material_id = id[k];
  }

  std::vector<std::uint16_t> random_phases() const
  {
    std::mt19937 generator(7);
    std::vector<std::uint16_t> id(box.grid.n_cells());
    for (auto &one : id)
      one = static_cast<std::uint16_t>(generator() % phases.size());
    return id;
  }

  unsigned int master(const unsigned int p) const
  {
    const auto &n        = box.grid.cells;
    const unsigned int i = p % (n[0] + 1), j = p / (n[0] + 1) % (n[1] + 1),
                       k = p / (n[0] + 1) / (n[1] + 1);
    return (k * (n[1] + 1) + (box.periodic[1] && j == n[1] ? 0 : j)) * (n[0] + 1) +
           (box.periodic[0] && i == n[0] ? 0 : i);
  }

  /** Points of a plane across z. */
  std::vector<unsigned int> plane(const unsigned int k) const
  {
    std::vector<unsigned int> points;
    const unsigned int size = (box.grid.cells[0] + 1) * (box.grid.cells[1] + 1);
    for (unsigned int p = k * size; p < (k + 1) * size; ++p)
      if (master(p) == p)
        points.push_back(p);
    return points;
  }

  const std::vector<ElasticPhase<3>> phases;
  const BrickBox box;
  Mesh<3> mesh;
  const BrickOperator op;
};

/** The same numbers at a point of the mesh whatever the part; points that move together are
 * equal. */
void set_random(const MeshPart<3> &part, NodalField<double> &field, const double scale)
{
  for (unsigned int p = 0; p < part.points.size(); ++p)
    {
      std::mt19937 generator(part.master_in_mesh[p] + 1);
      std::uniform_real_distribution<double> uniform(-scale, scale);
      generator.discard(3);
      for (unsigned int c = 0; c < 3; ++c)
        field.row(c, 0)[p] = uniform(generator);
    }
}

/** [point of the mesh][component] of the points that this rank has; NaN of others. */
std::vector<double>
in_mesh(const Mesh<3> &mesh, const MeshPart<3> &part, const NodalField<double> &field)
{
  std::vector<double> values(3 * mesh.points.size(), std::nan(""));
  for (unsigned int p = 0; p < part.points.size(); ++p)
    for (unsigned int c = 0; c < 3; ++c)
      values[3 * std::size_t{part.point_in_mesh[p]} + c] = field.row(c, 0)[p];
  return values;
}

/** Largest difference where @p a has numbers, over the largest number of b. */
double difference(const std::vector<double> &a, const std::vector<double> &b)
{
  double largest = 0., scale = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    {
      scale = std::max(scale, std::abs(b[i]));
      if (!std::isnan(a[i]))
        largest = std::max(largest, std::abs(a[i] - b[i]));
    }
  return largest / scale;
}

std::vector<Case> cases()
{
  const std::array<double, 3> cube  = {{1e-3, 1e-3, 1e-3}},
                              brick = {{1e-3, 0.7e-3, 1.3e-3}};
  return {{{{9, 6, 5}}, cube, Case::isotropic, {{false, false}}},
          {{{9, 6, 5}}, brick, Case::isotropic, {{true, false}}},
          {{{8, 5, 40}}, brick, Case::any, {{false, true}}},
          {{{75, 3, 2}}, cube, Case::isotropic, {{false, false}}},
          {{{15, 7, 3}}, cube, Case::isotropic, {{true, true}}},
          {{{1, 3, 1}}, cube, Case::any, {{false, false}}},
          {{{10, 6, 4}}, brick, Case::orthotropic, {{false, true}}},
          {{{6, 5, 9}}, cube, Case::orthotropic, {{true, false}}},
          {{{7, 4, 1}}, brick, Case::any, {{true, true}}},
          {{{9, 6, 8}}, brick, Case::many, {{false, false}}},
          {{{17, 5, 4}}, cube, Case::many, {{true, true}}},
          {{{9, 6, 5}}, cube, Case::isotropic, {{false, false}}, true},
          {{{9, 6, 5}}, brick, Case::isotropic, {{true, false}}, true},
          {{{10, 6, 4}}, brick, Case::orthotropic, {{false, true}}, true},
          {{{8, 5, 40}}, brick, Case::any, {{false, true}}, true},
          {{{9, 6, 8}}, brick, Case::many, {{false, false}}, true}};
}

/** What is compared after some steps with surfaces and held components. */
template <typename Stepper, typename Operator>
std::array<std::vector<double>, 2>
advanced(const Box &box, const Operator &op, const MeshPart<3> &part)
{
  StepParameters parameters;
  parameters.dt    = 0.5 * critical_time_step(largest_frequency(box.op).upper, 0.6, 2e-8);
  parameters.beta2 = 0.6;
  parameters.beta  = 2e-8;
  parameters.acceleration = {{3., -4., 9.81}};
  std::vector<HeldComponent> held;
  const unsigned int row = box.box.grid.cells[0] + 1;
  for (unsigned int p = 0; p < box.mesh.points.size(); ++p)
    if (!box.box.periodic[0] && p % row == 0)
      held.push_back({p, 0});
    else if (!box.box.periodic[1] && p / row % (box.box.grid.cells[1] + 1) == 0)
      held.push_back({p, 1});
  NodalField<double> u(static_cast<unsigned int>(part.points.size()), 1, 3), w = u;
  set_random(part, u, 1e-6);
  set_random(part, w, 1e-1);
  Stepper stepper(op, held, parameters, u, w);
  FreeSurface<3> bottom(parameters), top(parameters);
  stepper.add_surface(SharedNodes(box.plane(0), part), bottom);
  stepper.add_surface(SharedNodes(box.plane(box.box.grid.cells[2]), part), top);
  stepper.advance(20);
  stepper.advance(11);
  return {{in_mesh(box.mesh, part, u), in_mesh(box.mesh, part, w)}};
}

MeshPart<3> whole(const Mesh<3> &mesh)
{
  return distribute(mesh, std::vector<unsigned int>(mesh.cells.size(), 0), MPI_COMM_SELF);
}
} // namespace

TEST(Brick, ProductEqualsThatOfTheMesh)
{
  for (const Case &c : cases())
    {
      const Box box(c, MPI_COMM_WORLD);
      const MeshPart<3> part = whole(box.mesh);
      const MeshOperator<3> reference(part, box.phases, MPI_COMM_SELF);
      const MeshPart<3> &own = box.op.slab().part;
      NodalField<double> x(static_cast<unsigned int>(own.points.size()), 1, 3),
        f = x, y(static_cast<unsigned int>(part.points.size()), 1, 3), g = y;
      set_random(own, x, 1e-6);
      set_random(part, y, 1e-6);
      box.op.multiply(f, x);
      LineVector<double> in = reference.zero_field(), out = in;
      for (unsigned int p = 0; p < part.points.size(); ++p)
        for (unsigned int d = 0; d < 3; ++d)
          in[4 * p + d] = y.row(d, 0)[p];
      reference.add_product(out.data(), in.data());
      for (unsigned int p = 0; p < part.points.size(); ++p)
        for (unsigned int d = 0; d < 3; ++d)
          g.row(d, 0)[p] = out[4 * p + d];
      EXPECT_LT(difference(in_mesh(box.mesh, own, f), in_mesh(box.mesh, part, g)), 2e-14);
      std::vector<double> mass(box.mesh.points.size());
      for (unsigned int p = 0; p < part.points.size(); ++p)
        mass[part.point_in_mesh[p]] = reference.lumped_mass()[p];
      for (unsigned int p = 0; p < own.points.size(); ++p)
        EXPECT_NEAR(box.op.lumped_mass()[p], mass[own.point_in_mesh[p]],
                    1e-14 * mass[own.point_in_mesh[p]]);
    }
}

TEST(Brick, StepsEqualThoseOfTheMesh)
{
  for (const Case &c : cases())
    {
      const Box box(c, MPI_COMM_WORLD);
      const MeshPart<3> part = whole(box.mesh);
      const MeshOperator<3> reference(part, box.phases, MPI_COMM_SELF);
      const auto a = advanced<BrickStepper>(box, box.op, box.op.slab().part);
      const auto b = advanced<MeshStepper<3>>(box, reference, part);
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_LT(difference(a[k], b[k]), 1e-13);
    }
}

TEST(Brick, HasTheSameBitsOnAllRanks)
{
  for (const Case &c : cases())
    {
      const Box box(c, MPI_COMM_WORLD), alone(c, MPI_COMM_SELF);
      const auto a = advanced<BrickStepper>(box, box.op, box.op.slab().part);
      const auto b = advanced<BrickStepper>(box, alone.op, alone.op.slab().part);
      for (unsigned int k = 0; k < 2; ++k)
        EXPECT_EQ(difference(a[k], b[k]), 0.);
    }
}

TEST(Brick, DeformationIsThatOfTheMesh)
{
  for (const Case &c : cases())
    {
      const Box box(c, MPI_COMM_WORLD);
      const MeshPart<3> part = whole(box.mesh), &own = box.op.slab().part;
      NodalField<double> x(static_cast<unsigned int>(own.points.size()), 1, 3),
        y(static_cast<unsigned int>(part.points.size()), 1, 3);
      set_random(own, x, 5e-4);
      set_random(part, y, 5e-4);
      const Deformation a = largest_deformation(box.op.slab(), x, MPI_COMM_WORLD),
                        b = largest_deformation(part.points, part.cells,
                                                part.cell_in_mesh, y, MPI_COMM_SELF);
      const std::array<std::array<CellExtreme, 2>, 3> pairs = {
        {{{a.strain, b.strain}}, {{a.rotation, b.rotation}}, {{a.jacobian, b.jacobian}}}};
      for (const auto &[found, wanted] : pairs)
        {
          EXPECT_NEAR(found.value, wanted.value, 1e-12 * std::abs(wanted.value));
          EXPECT_EQ(found.cell, wanted.cell);
          for (unsigned int d = 0; d < 3; ++d)
            EXPECT_NEAR(found.middle[d], wanted.middle[d], 1e-14);
        }
    }
}

// The largest eigenvalue of a mesh by Lanczos from below; the bound of a cell above it.
TEST(Brick, LargestFrequencyIsThatOfTheMesh)
{
  const Box box(cases()[0], MPI_COMM_WORLD);
  const MeshPart<3> part = whole(box.mesh);
  const MeshOperator<3> reference(part, box.phases, MPI_COMM_SELF);
  const FrequencyEstimate a = largest_frequency(box.op), b = largest_frequency(reference);
  EXPECT_NEAR(a.lower, b.lower, 2e-3 * b.lower);
  EXPECT_LE(a.lower, box.op.frequency_bound());
  EXPECT_LE(a.upper, box.op.frequency_bound());
}

// Closed form of omega^2 rho h^2 of one cell with eighths of its mass at the corners: rigid
// motions, constant strains, and those in which the strain of the middle vanishes.
TEST(Brick, EigenvaluesOfTheCube)
{
  const double lambda = 1.7, mu = 0.9, rho = 2.1, h = 0.3;
  const double E                           = mu * (3. * lambda + 2. * mu) / (lambda + mu),
               nu                          = 0.5 * lambda / (lambda + mu);
  const BrickBox box                       = {{{{1, 1, 1}}, {{h, h, h}}, {}}, {}};
  const std::vector<std::uint8_t> one_cell = {0};
  const BrickOperator op(divide_box(box, reader_of(box.grid, one_cell), 1, MPI_COMM_SELF),
                         {{isotropic_stiffness<3>(E, nu), rho}}, MPI_COMM_SELF);
  Eigen::Matrix<double, 24, 24> matrix;
  NodalField<double> u(8, 1, 3), f(8, 1, 3);
  for (int k = 0; k < 24; ++k)
    {
      u.set_zero();
      u.row(k / 8, 0)[k % 8] = 1.;
      op.multiply(f, u);
      for (int l = 0; l < 24; ++l)
        matrix(l, k) = f.row(l / 8, 0)[l % 8];
    }
  const Eigen::VectorXd found =
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues() * 8. / h;
  std::vector<double> expected;
  const auto add = [&](const int times, const double value) {
    expected.insert(expected.end(), times, value);
  };
  add(6, 0.);
  add(2, 4. * mu / 3.);
  add(3, 4. * (lambda + 4. * mu) / 9.);
  add(3, 4. * mu);
  add(1, 16. * mu / 3.);
  add(5, 8. * mu);
  add(3, 4. * (2. * lambda + 3. * mu) / 3.);
  add(1, 4. * (3. * lambda + 2. * mu));
  std::sort(expected.begin(), expected.end());
  for (int k = 0; k < 24; ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-13 * expected.back()) << k;
}

// 4 (3 lambda + 2 mu) / (rho h^2) is the largest eigenvalue of a cube that is one cell.
TEST(Brick, BoundOfACubeIsExact)
{
  const double E = 2.1e11, nu = 0.3, rho = 7850., h = 0.01;
  const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
  const BrickBox box                       = {{{{1, 1, 1}}, {{h, h, h}}, {}}, {}};
  const std::vector<std::uint8_t> one_cell = {0};
  const BrickOperator op(divide_box(box, reader_of(box.grid, one_cell), 1, MPI_COMM_SELF),
                         {{isotropic_stiffness<3>(E, nu), rho}}, MPI_COMM_SELF);
  const double exact = std::sqrt(4. * (3. * lambda + 2. * mu) / (rho * h * h));
  EXPECT_NEAR(op.frequency_bound(), exact, 1e-12 * exact);
}
