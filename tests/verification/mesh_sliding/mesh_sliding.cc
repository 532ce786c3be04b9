// Contact dynamics on meshes. Runs on any number of ranks.

#include "mesh_sliding.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace verification;

namespace
{
constexpr double V = 2., P = 5e6;

/** Cells of a small body. */
template <int dim>
MeshCase<dim> body_of_cells(const Cells &kind)
{
  MeshCase<dim> c;
  if constexpr (dim == 2)
    c.mesh = brick<2>({{22, 9}}, {{11e-3, 3.6e-3}}, kind);
  else
    c.mesh = brick<3>({{8, 5, 4}}, {{4e-3, 3e-3, 1.6e-3}}, kind);
  return c;
}

/** A small two-phase body thrown on the moving flat: sticks, slips, bounces. */
template <int dim>
MeshCase<dim> thrown_body(MeshCase<dim> c)
{
  for (std::size_t k = 0; k < c.mesh.cells.size(); ++k)
    c.mesh.cells[k].material_id = k % 7 == 2 || k % 11 == 4;
  c.phases                      = two_phases<dim>();
  c.friction                    = 0.4;
  c.setup.contact.flat_velocity = LoadHistory(V);
  c.setup.contact.gap           = 2e-7;
  c.setup.top.pressure          = LoadHistory(P);
  c.setup.energy_interval       = 1;
  return c;
}

/** Under pressure, periodic along all axes but the normal of the flat. */
template <int dim>
MeshCase<dim> joined_body(MeshCase<dim> c)
{
  c                     = thrown_body<dim>(std::move(c));
  c.setup.top.is_platen = false;
  for (unsigned int axis = 0; axis + 1 < dim; ++axis)
    c.join(axis);
  return c;
}

/** Downwards, and in 3D turning as well. */
template <int dim>
double
thrown(const MeshCase<dim> &body, const dealii::Point<dim> &p, const unsigned int c)
{
  if (!body.mesh.masters.empty())
    {
      const double turns = p[0] / (dim == 2 ? 11e-3 : 4e-3) + (dim - 2) * p[1] / 3e-3;
      return c == dim - 1 ? -1.5 + 0.3 * std::sin(2. * M_PI * turns + 400. * p[dim - 1])
                          : 0.5 * (dim - 2);
    }
  return c == dim - 1 ? -1.5 + 0.3 * std::sin(900. * p[0] + 400. * p[dim - 1])
                      : 300. * (c == 0 ? p[1] : -p[0]) * (dim - 2);
}

template <int dim>
void expect_closed(const MeshCase<dim> &c, const std::string &what)
{
  MeshRun<dim> run(c, MPI_COMM_WORLD);
  run.set_w([&](const auto &p, const unsigned int k) {
    return c.setup.top.is_platen && p[dim - 1] > 0.99 * 1.6e-3
             ? (k == dim - 1 ? -1.5 : 0.)
             : thrown(c, p, k);
  });
  run.run(1000);
  const auto states     = run.body.contact_states(c.side(2 * (dim - 1)).points.size());
  const EnergyHistory e = run.body.energy->reduce();
  double scale = 0., slip = 0., landings = 0.;
  for (const auto *values : {&e.kinetic, &e.elastic, &e.friction, &e.external_work})
    scale = std::max(scale, largest(*values));
  for (const float n : states.at(0).slip)
    slip += n;
  for (const float n : states.at(0).landings)
    landings += n;
  slip     = dealii::Utilities::MPI::max(slip, MPI_COMM_WORLD); // rank 0 has them
  landings = dealii::Utilities::MPI::max(landings, MPI_COMM_WORLD);
  EXPECT_LT(largest(e.residual()) / scale, 1e-12) << what;
  EXPECT_GT(slip, 1000.) << what;
  EXPECT_GT(landings, 30.) << what;
  EXPECT_GT(e.friction.back(), 1e-3 * scale) << what;
}

/** Balances that have every term. */
template <int dim>
void expect_closed(const std::string &kind, const MeshCase<dim> &cells)
{
  MeshCase<dim> c       = thrown_body<dim>(cells);
  c.setup.top.is_platen = false;
  expect_closed(c, kind + ", pressure");
  c.setup.step.acceleration          = {{300., 0., 0.}};
  c.setup.step.acceleration[dim - 1] = -2e5;
  c.setup.step.beta                  = 2e-8;
  c.setup.step.beta2                 = 0.8;
  c.hold(0, 0);
  c.hold(1, dim - 1);
  expect_closed(c, kind + ", gravity, damping, beta2, held sides");
  c.setup.step.alpha                      = 2e4;
  c.setup.contact.normal_spring.stiffness = 1e14;
  expect_closed(c, kind + ", damping by the mass, springs");
  expect_closed(joined_body<dim>(cells), kind + ", periodic");
  c                        = thrown_body<dim>(cells);
  c.setup.top.platen_mass  = 0.05 * (dim == 3 ? 3e-3 : 1.);
  c.setup.contact.law.time = 0.;
  expect_closed(c, kind + ", platen with mass, Coulomb");
}

/** What SlidingBody has at the points of the mesh. */
std::vector<double> at_points(const NodalField<double> &field,
                              const UniformGrid<2> &grid,
                              const Mesh<2> &mesh)
{
  std::vector<double> values;
  for (const auto &p : mesh.points)
    for (unsigned int c = 0; c < 2; ++c)
      values.push_back(field.row(
        c, std::lround(p[1] / grid.spacing[1]))[std::lround(p[0] / grid.spacing[0])]);
  return values;
}
} // namespace

TEST(MeshSliding, EnergiesClose)
{
  expect_closed<2>("quadrilaterals", body_of_cells<2>({false, 0.2}));
  expect_closed<2>("triangles", body_of_cells<2>({true, 0.05}));
  expect_closed<3>("hexahedra", body_of_cells<3>({false, 0.2}));
  expect_closed<3>("tetrahedra", body_of_cells<3>({true, 0.05}));
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) <= 4) // layers of cells
    expect_closed<3>("bricks", box_of_bricks({{8, 5, 4}}, {{5e-4, 6e-4, 4e-4}}));
}

// The grid handed in as a mesh, with everything that a run can have.
TEST(MeshSliding, EqualsTheGrid)
{
  for (const auto &[platen, periodic] :
       {std::make_pair(true, false), std::make_pair(true, true),
        std::make_pair(false, false), std::make_pair(false, true)})
    {
      MeshCase<2> c = (periodic ? joined_body<2> : thrown_body<2>)(body_of_cells<2>({}));
      BodySetup grid;
      grid.cells                = {{22, 9}};
      grid.spacing              = {{5e-4, 4e-4}};
      grid.classes              = c.phases;
      grid.friction             = c.friction;
      c.setup.step.acceleration = {{300., -2e5}};
      c.setup.step.beta         = 2e-8;
      c.setup.step.beta2        = 0.8;
      c.setup.top.is_platen     = platen;
      c.setup.periodic          = periodic;
      if (!periodic)
        {
          c.setup.sides.left_held = {{true, false}};
          c.hold(0, 0);
        }
      grid.ids.resize(22 * 9);
      for (const auto &cell : c.mesh.cells)
        {
          const auto &p = c.mesh.points[cell.vertices[0]];
          grid.ids[std::lround(p[0] / 5e-4) + 22 * std::lround(p[1] / 4e-4)] =
            static_cast<std::uint8_t>(cell.material_id);
        }
      static_cast<SlidingSetup &>(grid) = c.setup;
      grid.choose_time_step(0.95);
      c.setup.step.dt = grid.step.dt;

      Body on_grid(grid);
      MeshRun<2> on_mesh(c, MPI_COMM_WORLD);
      const auto start = [&](const dealii::Point<2> &p, const unsigned int k) {
        return k == 0 ? 0. : platen ? -1.5 : thrown(c, p, k);
      };
      on_grid.set_w([&](const double x, const double y, const unsigned int k) {
        return start(dealii::Point<2>(x, y), k);
      });
      on_mesh.set_w(start);
      std::uint64_t done = 0;
      for (const std::uint64_t n : {10, 100, 1000})
        {
          on_grid.run(n - done);
          on_mesh.run(n - done);
          done = n;
          const double found =
            relative_difference(at_points(on_grid.u, on_grid.material.grid(), c.mesh),
                                on_mesh.whole(on_mesh.body.u));
          std::cout << "after " << n << " steps: " << found << '\n';
          EXPECT_LT(found, 1e-11) << n;
        }
      const double friction =
        dealii::Utilities::MPI::sum(on_mesh.body.contact.work().friction, MPI_COMM_WORLD);
      EXPECT_NEAR(friction, on_grid.contact.work().friction,
                  1e-10 * on_grid.contact.work().friction);
    }
}

template <int dim>
void expect_equal_on_all_ranks()
{
  for (const auto &[simplices, periodic] :
       {std::make_pair(false, false), std::make_pair(true, false),
        std::make_pair(false, true), std::make_pair(true, true)})
    {
      const Cells kind = {simplices, simplices ? 0.05 : 0.2};
      MeshCase<dim> c =
        (periodic ? joined_body<dim> : thrown_body<dim>)(body_of_cells<dim>(kind));
      c.setup.top.is_platen     = false;
      c.setup.step.acceleration = {{300., 200., 0.}};
      MeshRun<dim> alone(c, MPI_COMM_SELF), together(c, MPI_COMM_WORLD);
      EXPECT_NEAR(together.body.setup.step.dt, alone.body.setup.step.dt,
                  1e-12 * alone.body.setup.step.dt);
      for (MeshRun<dim> *run : {&alone, &together})
        {
          run->set_w(
            [&c = c](const auto &p, const unsigned int k) { return thrown(c, p, k); });
          run->run(1000);
        }
      EXPECT_LT(
        relative_difference(alone.whole(alone.body.u), together.whole(together.body.u)),
        1e-9);
      EXPECT_LT(
        relative_difference(alone.whole(alone.body.w), together.whole(together.body.w)),
        1e-9);
      const Deformation one = alone.body.stepper.deformation(),
                        all = together.body.stepper.deformation();
      EXPECT_NEAR(all.strain.value, one.strain.value, 1e-9 * one.strain.value);
      EXPECT_EQ(all.strain.cell, one.strain.cell);
      EXPECT_EQ(all.strain.middle, one.strain.middle);
    }
}

TEST(MeshSliding, IsTheSameOnAllRanks)
{
  expect_equal_on_all_ranks<2>();
  expect_equal_on_all_ranks<3>();
}

// Friction opposes the motion and knows no other direction.
TEST(MeshSliding, BlockThrownAskewStopsAfterItsDistance)
{
  const double mu = 0.3, g = 9.81, vx = 0.8, vy = -0.6;
  MeshCase<3> c;
  c.mesh                    = brick<3>({{3, 3, 2}}, {{0.03, 0.03, 0.01}});
  c.phases                  = {{isotropic_stiffness<3>(2e7, 0.2), 1000.}};
  c.friction                = mu;
  c.setup.contact.law.time  = 0.;
  c.setup.top.is_platen     = false;
  c.setup.step.acceleration = {{0., 0., -g}};
  c.setup.step.beta         = 2e-5;
  const double deceleration = mu * g, v = std::hypot(vx, vy);
  MeshRun<3> run(c, MPI_COMM_WORLD);
  run.set_w([&](const auto &, const unsigned int k) {
    return k == 0 ? vx : k == 1 ? vy : 0.;
  });
  const double dt        = run.body.setup.step.dt;
  const double stop_time = v / deceleration, distance = 0.5 * v * stop_time;
  const auto mean = [&]() {
    const std::vector<double> u = run.whole(run.body.u);
    dealii::Point<3> sum;
    for (std::size_t k = 0; k < u.size(); ++k)
      sum[k % 3] += u[k] * 3. / u.size();
    return sum;
  };
  run.run(static_cast<std::uint64_t>(0.5 * stop_time / dt));
  const dealii::Point<3> half = mean();
  EXPECT_NEAR(half[0], 0.75 * distance * vx / v, 2e-3 * distance);
  EXPECT_NEAR(half[1], 0.75 * distance * vy / v, 2e-3 * distance);
  run.run(static_cast<std::uint64_t>(stop_time / dt));
  const dealii::Point<3> end = mean();
  std::cout << "stopped after " << end << ", " << distance * vx / v << ' '
            << distance * vy / v << " m\n";
  EXPECT_NEAR(end[0], distance * vx / v, 2e-3 * distance);
  EXPECT_NEAR(end[1], distance * vy / v, 2e-3 * distance);
  EXPECT_LT(largest(run.whole(run.body.w)), 1e-3 * v);
}

// One layer of cells whose u_y is held is in plane strain, whatever happens in the plane.
TEST(MeshSliding, ExtrudedBodyEqualsThePlaneOne)
{
  const double depth = 0.7e-3;
  for (const bool platen : {true, false})
    {
      MeshCase<2> plane = thrown_body<2>(body_of_cells<2>({}));
      MeshCase<3> solid;
      solid.mesh   = brick<3>({{22, 1, 9}}, {{11e-3, depth, 3.6e-3}});
      solid.phases = two_phases<3>();
      for (std::size_t k = 0; k < solid.mesh.cells.size(); ++k)
        solid.mesh.cells[k].material_id = plane.mesh.cells[k].material_id;
      plane.setup.top.is_platen = platen;
      plane.setup.step.dt       = 5e-8;
      solid.setup               = plane.setup;
      solid.friction            = plane.friction;
      solid.hold(2, 1);
      solid.hold(3, 1);
      MeshRun<2> in_plane(plane, MPI_COMM_WORLD);
      MeshRun<3> in_space(solid, MPI_COMM_WORLD);
      const auto start = [&](const double x, const double z, const unsigned int k) {
        const dealii::Point<2> p(x, z);
        return platen ? -1.5 * k : thrown(plane, p, k);
      };
      in_plane.set_w(
        [&](const auto &p, const unsigned int k) { return start(p[0], p[1], k); });
      in_space.set_w([&](const auto &p, const unsigned int k) {
        return k == 1 ? 0. : start(p[0], p[2], k / 2);
      });
      in_plane.run(1000);
      in_space.run(1000);
      const auto u = in_plane.whole(in_plane.body.u), v = in_space.whole(in_space.body.u);
      std::vector<double> expected(v.size(), 0.);
      for (std::size_t i = 0; i < solid.mesh.points.size(); ++i)
        for (std::size_t j = 0; j < plane.mesh.points.size(); ++j)
          if (std::fabs(solid.mesh.points[i][0] - plane.mesh.points[j][0]) < 1e-9 &&
              std::fabs(solid.mesh.points[i][2] - plane.mesh.points[j][1]) < 1e-9)
            {
              expected[3 * i]     = u[2 * j];
              expected[3 * i + 2] = u[2 * j + 1];
            }
      const double found = relative_difference(expected, v);
      std::cout << "difference of plane and solid: " << found << '\n';
      EXPECT_LT(found, 1e-10);
    }
}

// A bevelled edge: where the body is higher it touches later.
TEST(MeshSliding, TheGapFollowsTheShape)
{
  MeshCase<2> c = thrown_body<2>(body_of_cells<2>({}));
  for (auto &p : c.mesh.points)
    p[1] += std::max(0., 2e-3 - p[0]) * 0.01 * (1. - p[1] / 3.6e-3);
  // The bevelled edge is on no side of a box.
  std::vector<BoundaryFace<2>> below;
  for (const auto &face : boundary_faces(c.mesh))
    if (c.mesh.points[face.points[0]][1] < 3e-5 &&
        c.mesh.points[face.points[1]][1] < 3e-5)
      below.push_back(face);
  const MeshBoundary contact = mesh_boundary(c.mesh, below);
  ASSERT_EQ(contact.points.size(), 23U);
  EXPECT_NEAR(std::accumulate(contact.area.begin(), contact.area.end(), 0.), -11e-3,
              1e-15);
  for (unsigned int i = 0; i < 23; ++i)
    EXPECT_NEAR(contact.height[i], std::max(0., 2e-3 - 5e-4 * i) * 0.01, 1e-15);

  const auto distributed = distribute_mesh(c.mesh, contact.points, c.phases,
                                           InstructionSet::automatic, MPI_COMM_SELF);
  MeshBoundary top;
  for (unsigned int p = 0; p < c.mesh.points.size(); ++p)
    if (c.mesh.points[p][1] > 3.5e-3)
      {
        top.points.push_back(p);
        top.area.push_back(1e-3);
      }
  c.setup.contact.friction_coefficient.assign(23, 0.);
  c.setup.contact.gap = -7e-6;
  c.setup.step.dt     = 1e-9;
  SlidingMesh<2> body(*distributed, contact, top, {}, c.setup);
  body.stepper.step();
  // 20, 15, 10, 5 um, then none.
  for (unsigned int i = 0; i < 23; ++i)
    EXPECT_EQ(body.contact.normal_force()[i] > 0., i > 2) << i;
}

// Between two edges of different phases, as on a grid: (A a + B b) / (A + B).
TEST(MeshSliding, FrictionOfANodeIsThatOfThePhasesBehindIt)
{
  Mesh<2> mesh              = brick<2>({{3, 1}}, {{3., 1.}});
  mesh.cells[1].material_id = 1;
  const auto faces          = faces_of_box(mesh, boundary_faces(mesh))[2];
  const auto found =
    mean_of_phases(mesh, faces, mesh_boundary(mesh, faces), {0.2, 0.8}, {5., 3.});
  const double between    = (5. * 0.2 + 3. * 0.8) / 8.,
               expected[] = {0.2, between, between, 0.2};
  ASSERT_EQ(found.size(), 4U);
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-15);
}
