// The body on a box of bricks against that on a mesh of the same cells: products, masses, sides,
// strains, matrices and solutions with components of any nodes held, with springs or with nothing
// that holds it. Runs on any number of ranks.

#include "base/exchange.h"
#include "body/brick_body.h"
#include "body/mesh/mesh_body.h"
#include "divided_body.h"
#include "exchange/mesh_datasets.h"
#include "material/stiffness.h"
#include "mesh/boundary.h"
#include "mesh/periodic_points.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

using namespace mesoslip;

namespace
{
/** A stiffness without symmetries. */
VoigtMatrix<3> any_stiffness(std::mt19937 &generator)
{
  std::uniform_real_distribution<> random(-1., 1.);
  Eigen::Matrix<double, 6, 6> A;
  for (int k = 0; k < 36; ++k)
    A.data()[k] = random(generator);
  return A * A.transpose() + 2. * VoigtMatrix<3>::Identity();
}

/** A box of random cells, as bricks and as a mesh. */
struct RandomBox
{
  RandomBox(const std::array<unsigned int, 3> &cells,
            const std::array<bool, 2> &periodic,
            const bool isotropic)
    : box{{cells, {{0.3, 0.25, 0.4}}, {{1., -2., 0.5}}}, periodic}
  {
    std::mt19937 generator(7);
    const unsigned int n = 4;
    for (unsigned int p = 0; p < n; ++p)
      phases.push_back({isotropic ? isotropic_stiffness<3>(1. + 4. * p, 0.1 + 0.1 * p)
                                  : any_stiffness(generator),
                        1.5 + p});
    std::vector<std::uint8_t> id(box.grid.n_cells());
    for (std::uint8_t &phase : id)
      phase = generator() % n;
    reader     = reader_of(box.grid, id);
    input.mesh = mesh_of_cells(box.grid);
    for (std::size_t k = 0; k < id.size(); ++k)
      input.mesh.cells[k].material_id = id[k];
    for (unsigned int p = 0; p < n; ++p)
      input.mesh.phases.push_back(std::to_string(p));
    input.phases      = phases;
    input.periodicity = {periodic[0], periodic[1]};
    for (unsigned int axis = 0; axis < 2; ++axis)
      if (periodic[axis])
        {
          const auto faces = faces_of_box(input.mesh, boundary_faces(input.mesh));
          join_sides(input.mesh, faces[2 * axis], faces[2 * axis + 1], axis, 1e-6);
        }
    numbers.resize(box.grid.n_nodes());
    std::iota(numbers.begin(), numbers.end(), 0U);
  }

  BrickBox box;
  std::vector<ElasticPhase<3>> phases;
  CellReader reader;
  MeshBodyInput<3> input;
  std::vector<unsigned int> numbers; ///< of all points
};

/** A number from -1 to 1 that belongs to a component of a point. */
double hashed(const std::uint64_t point, const unsigned int c, const unsigned int salt)
{
  std::mt19937 generator(static_cast<unsigned int>(7919 * point + 31 * c + 1031 * salt));
  generator.discard(3);
  return std::uniform_real_distribution<>(-1., 1.)(generator);
}

NodalField<double> random_field(const ElasticBody<3> &body, const unsigned int salt)
{
  NodalField<double> u = body.zero_field();
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      u.row(c, 0)[i] = hashed(body.number({i, 0}), c, salt);
  body.update_copies(u);
  return u;
}

void expect_near(const std::vector<double> &a,
                 const std::vector<double> &b,
                 const double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  double largest = 0., difference = 0.;
  for (std::size_t k = 0; k < a.size(); ++k)
    {
      largest    = std::max(largest, std::fabs(b[k]));
      difference = std::max(difference, std::fabs(a[k] - b[k]));
      ASSERT_FALSE(std::isnan(a[k]));
    }
  EXPECT_LE(difference, tolerance * largest);
}

/** Calls @p action with both bodies for boxes of all kinds. */
template <typename Action>
void for_each_box(const Action &action)
{
  for (const std::array<unsigned int, 3> &cells : {std::array<unsigned int, 3>{{4, 3, 5}},
                                                   {{1, 1, 4}},
                                                   {{7, 6, 9}},
                                                   {{5, 4, 3}},
                                                   {{1, 1, 1}}})
    for (const std::array<bool, 2> &periodic :
         {std::array<bool, 2>{{false, false}}, {{true, false}}, {{true, true}}})
      for (const bool isotropic : {true, false})
        {
          const bool is_cell = cells[2] == 1; // of which a mesh is not divided
          if ((cells[0] == 1 && periodic[0]) ||
              (is_cell && mpi::n_mpi_processes(MPI_COMM_WORLD) > 1))
            continue;
          SCOPED_TRACE(testing::Message()
                       << cells[0] << " x " << cells[1] << " x " << cells[2]
                       << (periodic[0] ? ", periodic along x" : "")
                       << (periodic[1] ? " and y" : "")
                       << (isotropic ? "" : ", anisotropic"));
          const RandomBox box(cells, periodic, isotropic);
          const GridBody<3> bricks(box.box, box.reader, box.phases, MPI_COMM_WORLD);
          const auto mesh = verification::divided(box.input);
          action(box, bricks, *mesh);
        }
}

/** The same components of the same points for both bodies: none, all at the top, or random ones
 * anywhere or at the bottom. */
DofMask mask_of(const PointBody<3> &body, const RandomBox &box, const unsigned int kind)
{
  const double height = box.box.grid.extent(2);
  DofMask mask(body.n_columns(), 1);
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      if ((kind == 1 && body.point({i, 0})[2] > height - 1e-9) ||
          (kind == 2 &&
           hashed(box.input.mesh.master(body.number({i, 0})), c, 99) > 0.8) ||
          (kind == 3 && body.point({i, 0})[2] < 1e-9 &&
           hashed(box.input.mesh.master(body.number({i, 0})), c, 98) > 0.3))
        mask.constrain(c, {i, 0});
  body.update_copies(mask);
  return mask;
}
} // namespace

TEST(BrickStatics, ProductsMassesAndSidesAreThoseOfTheMesh)
{
  for_each_box([](const RandomBox &box, const GridBody<3> &bricks,
                  const MeshBody<3> &mesh) {
    EXPECT_NEAR(bricks.volume(), mesh.volume(), 1e-12 * mesh.volume());
    EXPECT_NEAR(bricks.total_mass(), mesh.total_mass(), 1e-12 * mesh.total_mass());
    NodalField<double> f = bricks.zero_field(), g = mesh.zero_field();
    bricks.vmult(f, random_field(bricks, 1));
    mesh.vmult(g, random_field(mesh, 1));
    expect_near(bricks.values_at(box.numbers, f), mesh.values_at(box.numbers, g), 1e-13);
    const std::vector<double> m = bricks.lumped_mass(), n = mesh.lumped_mass();
    std::copy(m.begin(), m.end(), f.row(0, 0));
    std::copy(n.begin(), n.end(), g.row(0, 0));
    expect_near(bricks.values_at(box.numbers, f), mesh.values_at(box.numbers, g), 1e-13);
    for (const unsigned int id : {ElasticBody<3>::bottom, ElasticBody<3>::top})
      {
        double area[2] = {0., 0.};
        for (const auto &normal : bricks.surface(id).normal_area)
          area[0] += normal[2];
        for (const auto &normal : mesh.surface(id).normal_area)
          area[1] += normal[2];
        EXPECT_EQ(bricks.surface(id).normal_area.size(),
                  mesh.surface(id).normal_area.size());
        EXPECT_NEAR(area[0], area[1], 1e-13);
      }
    // Contact nodes by their numbers, with the displacement there.
    std::array<std::map<unsigned int, std::vector<double>>, 2> contact;
    const auto take = [](const PointBody<3> &body, auto &of_body) {
      const auto values =
        body.surface_values(ElasticBody<3>::bottom, random_field(body, 2));
      const auto &areas = body.surface(ElasticBody<3>::bottom).normal_area;
      for (std::size_t k = 0; k < body.contact_points().size(); ++k)
        of_body[body.contact_points()[k]] = {values[3 * k], values[3 * k + 1],
                                             values[3 * k + 2], areas.at(k)[2]};
    };
    take(bricks, contact[0]);
    take(mesh, contact[1]);
    ASSERT_EQ(contact[0].size(), contact[1].size());
    for (const auto &[point, values] : contact[0])
      expect_near(values, contact[1].at(point), 1e-13);
  });
}

TEST(BrickStatics, StrainsAreThoseOfTheMesh)
{
  for_each_box(
    [](const RandomBox &box, const GridBody<3> &bricks, const MeshBody<3> &mesh) {
      const auto moments = [&](const ElasticBody<3> &body) {
        std::vector<double> sums(4 * 13, 0.);
        ElasticBody<3>::Cells cells;
        const NodalField<double> u = random_field(body, 3);
        for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
          {
            body.evaluate(u, group, cells);
            for (std::size_t k = 0; k < cells.phase.size(); ++k)
              for (unsigned int m = 0; m < 13; ++m)
                sums[13 * cells.phase[k] + m] +=
                  cells.volume[k] * (m == 12 ? 1.
                                     : m < 6
                                       ? cells.strain[k][m]
                                       : cells.strain[k][m - 6] * cells.strain[k][m - 6]);
          }
        sum_over_ranks(sums, body.communicator());
        return sums;
      };
      EXPECT_EQ(bricks.n_cells(), box.box.grid.n_cells());
      expect_near(moments(bricks), moments(mesh), 1e-12);
    });
}

TEST(BrickStatics, EntriesAreThoseOfTheProduct)
{
  for_each_box([](const RandomBox &box, const GridBody<3> &, const MeshBody<3> &) {
    const GridBody<3> body(box.box, box.reader, box.phases, MPI_COMM_WORLD, true);
    ASSERT_EQ(body.n_columns(), box.numbers.size());
    const NodalField<double> u = random_field(body, 4);
    NodalField<double> Ku = body.zero_field(), sum = Ku;
    body.vmult(Ku, u);
    for (const MatrixEntry &entry : body.stiffness_entries())
      sum.row(entry.row % 3, 0)[entry.row / 3] +=
        entry.value * u.row(entry.column % 3, 0)[entry.column / 3];
    body.add_copies(sum);
    expect_near(body.values_at(box.numbers, sum), body.values_at(box.numbers, Ku), 1e-13);
  });
}

TEST(BrickStatics, SolutionsAreThoseOfTheMesh)
{
  for_each_box(
    [](const RandomBox &box, const GridBody<3> &bricks, const MeshBody<3> &mesh) {
      for (const unsigned int kind : {0, 1, 2, 3})
        {
          SCOPED_TRACE(kind);
          const auto solve = [&](const PointBody<3> &body) {
            const auto solver  = body.make_solver();
            const DofMask mask = mask_of(body, box, kind);
            solver->set_constrained(mask);
            // A guess that is far off.
            NodalField<double> u = random_field(body, 5), force = random_field(body, 6);
            const SolverReport report = solver->solve(u, force, 1e-12);
            EXPECT_LE(report.residual, 1e-12);
            EXPECT_LE(report.iterations, 80U);
            // Up to rigid motions: the forces.
            NodalField<double> Ku = body.zero_field();
            body.vmult(Ku, u);
            auto values = body.values_at(box.numbers, kind == 0 ? Ku : u);
            return values;
          };
          expect_near(solve(bricks), solve(mesh), 1e-9);
        }
    });
}

TEST(BrickStatics, SpringsHoldIt)
{
  for_each_box(
    [](const RandomBox &box, const GridBody<3> &bricks, const MeshBody<3> &mesh) {
      for (const double stiffness : {1e-3, 1., 1e2})
        {
          const auto solve = [&](const PointBody<3> &body) {
            const auto &side = body.surface(ElasticBody<3>::bottom);
            DofMask mask(body.n_columns(), 1);
            std::vector<SpringEntry> springs;
            for (const NodeIndex &node : side.nodes)
              {
                mask.constrain(2, node);
                const double x                = hashed(body.number(node), 0, 7),
                             y                = hashed(body.number(node), 1, 7);
                const std::array<double, 2> n = {{x, y}};
                for (unsigned int c = 0; c < 2; ++c)
                  for (unsigned int d = 0; d < 2; ++d)
                    springs.push_back(
                      {node, c, d, stiffness * (n[c] * n[d] + (c == d ? 0.1 : 0.)), 0.});
              }
            const auto solver = body.make_solver();
            solver->set_constrained_on_springs(mask, springs);
            NodalField<double> u      = body.zero_field();
            const SolverReport report = solver->solve(u, random_field(body, 8), 1e-12);
            EXPECT_LE(report.iterations, 100U) << stiffness;
            return body.values_at(box.numbers, u);
          };
          expect_near(solve(bricks), solve(mesh), 1e-8);
        }
    });
}

// A bar of 200 widths bends with so little energy that single precision does not do.
TEST(BrickStatics, GoesOnInDoublePrecision)
{
  const BrickBox box{{{{3, 3, 60}}, {{0.1, 0.1, 1.}}, {}}, {}};
  const std::vector<ElasticPhase<3>> phases = {{isotropic_stiffness<3>(2., 0.3), 1.5}};
  const GridBody<3> body(
    box,
    [](const CellBlock<3> &block) { return std::vector<std::uint16_t>(block.n_cells()); },
    phases, MPI_COMM_WORLD);
  DofMask held(body.n_columns(), 1);
  for (const NodeIndex &node : body.surface(ElasticBody<3>::bottom).nodes)
    for (unsigned int c = 0; c < 3; ++c)
      held.constrain(c, node);
  NodalField<double> force = body.zero_field(), u = force, Ku = force;
  const auto &top = body.surface(ElasticBody<3>::top);
  for (std::size_t k = 0; k < top.nodes.size(); ++k)
    force(0, top.nodes[k]) = top.normal_area[top.place(k)][2];
  const auto solver = body.make_solver();
  solver->set_constrained(held);
  const SolverReport report = solver->solve(u, force, 1e-10);
  EXPECT_TRUE(report.single_iterations.has_value());
  body.vmult(Ku, u);
  // What is left is round-off of such displacements.
  double left = 0., size = 0.;
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      {
        size += u(c, {i, 0}) * u(c, {i, 0});
        if (!held.is_constrained(c, {i, 0}) && body.is_counted({i, 0}))
          left = std::max(left, std::fabs(Ku(c, {i, 0}) - force(c, {i, 0})));
      }
  EXPECT_GT(size, 1e6);
  EXPECT_LT(left, 1e-14 * body.unit_stiffness() * std::sqrt(size));
}
