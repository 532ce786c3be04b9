// Statics and modes of bodies on meshes in three dimensions. Runs on any number of ranks.

#include "body/mesh/mesh_body.h"
#include "body/rigid_motions.h"
#include "divided_body.h"
#include "eigenvalues/vibration_modes.h"
#include "material/stiffness.h"
#include "mesh_of_triangulation.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include <random>

using namespace mesoslip;

namespace
{
constexpr double density = 2.5;

/** A brick of cubes, or of tetrahedra cut out of them, whose inner points are moved. */
MeshBodyInput<3> brick(const std::vector<unsigned int> &cells,
                       const dealii::Point<3> &size,
                       const bool simplices,
                       const double shift)
{
  dealii::Triangulation<3> cubes, tetrahedra;
  dealii::GridGenerator::subdivided_hyper_rectangle(cubes, cells, {}, size);
  if (simplices)
    dealii::GridGenerator::convert_hypercube_to_simplex_mesh(cubes, tetrahedra);
  MeshBodyInput<3> body;
  take_cells(body.mesh, simplices ? tetrahedra : cubes);
  body.mesh.phases = {"solid"};
  for (auto &cell : body.mesh.cells)
    cell.material_id = 0;
  std::mt19937 generator(5);
  std::uniform_real_distribution<> random(-shift, shift);
  for (auto &p : body.mesh.points)
    {
      bool inside = true;
      for (unsigned int d = 0; d < 3; ++d)
        inside = inside && p[d] > 1e-9 && p[d] < size[d] - 1e-9;
      for (unsigned int d = 0; d < 3 && inside; ++d)
        p[d] += random(generator);
    }
  body.phases = {{isotropic_stiffness<3>(2., 0.3), density}};
  return body;
}

/** The displacement of a uniform displacement gradient. */
NodalField<double> affine(const ElasticBody<3> &body, const Eigen::Matrix3d &gradient)
{
  NodalField<double> u = body.zero_field();
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    {
      const auto p            = body.point({i, 0});
      const Eigen::Vector3d v = gradient * Eigen::Vector3d(p[0], p[1], p[2]);
      for (unsigned int c = 0; c < 3; ++c)
        u.row(c, 0)[i] = v[c];
    }
  return u;
}

double largest_difference(const NodalField<double> &a, const NodalField<double> &b)
{
  double largest = 0.;
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int i = 0; i < a.n_columns(); ++i)
      largest = std::max(largest, std::fabs(a.row(c, 0)[i] - b.row(c, 0)[i]));
  return largest;
}

Eigen::Matrix3d some_gradient()
{
  Eigen::Matrix3d gradient;
  gradient << 0.3, 0.1, -0.2, 0.4, -0.2, 0.15, 0.05, 0.25, 0.1;
  return gradient;
}

/** Forces on the surface of the brick that balance a uniform stress. */
NodalField<double> tractions(const ElasticBody<3> &body, const Eigen::Matrix3d &gradient)
{
  VoigtVector<3> strain = VoigtVector<3>::Zero();
  for (unsigned int c = 0; c < 3; ++c)
    for (unsigned int d = 0; d < 3; ++d)
      strain(voigt_index<3>(c, d)) += gradient(c, d);
  const VoigtVector<3> stress = body.phases()[0].stiffness * strain;
  NodalField<double> force    = body.zero_field();
  for (unsigned int id = 0; id < 6; ++id)
    {
      const SurfaceNodes<3> &side = body.surface(id);
      for (std::size_t k = 0; k < side.nodes.size(); ++k)
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 3; ++d)
            force(c, side.nodes[k]) +=
              stress(voigt_index<3>(c, d)) * side.normal_area[side.place(k)][d];
    }
  return force;
}
} // namespace

// Linear displacements are exact on any mesh, under prescribed displacements of the
// surface and, up to a rigid motion, under its tractions.
TEST(MeshStatics, PatchTest)
{
  for (const bool simplices : {false, true})
    {
      SCOPED_TRACE(simplices ? "tetrahedra" : "hexahedra");
      const auto owner = verification::divided(
        brick({3, 4, 3}, {3., 4., 3.}, simplices, simplices ? 0.08 : 0.2));
      const MeshBody<3> &body = *owner;
      EXPECT_NEAR(body.volume(), 36., 1e-12);
      EXPECT_NEAR(body.total_mass(), 36. * density, 1e-10);
      const NodalField<double> exact = affine(body, some_gradient());
      const NodalField<double> force = tractions(body, some_gradient());
      NodalField<double> Ku          = body.zero_field();
      body.vmult(Ku, exact);
      EXPECT_LT(largest_difference(Ku, force), 1e-12);

      DofMask surface(body.n_columns(), 1);
      for (unsigned int side = 0; side < 6; ++side)
        for (const NodeIndex &node : body.surface(side).nodes)
          for (unsigned int c = 0; c < 3; ++c)
            surface.constrain(c, node);
      NodalField<double> u = body.zero_field();
      for (unsigned int i = 0; i < body.n_columns(); ++i)
        for (unsigned int c = 0; c < 3 && surface.is_constrained(0, {i, 0}); ++c)
          u.row(c, 0)[i] = exact.row(c, 0)[i];
      const auto solver = body.make_solver();
      solver->set_constrained(surface);
      solver->solve(u, body.zero_field(), 1e-13);
      EXPECT_LT(largest_difference(u, exact), 1e-11);
      ElasticBody<3>::Cells cells;
      body.evaluate(u, 0, cells);
      for (const VoigtVector<3> &strain : cells.strain)
        EXPECT_NEAR(strain(3), some_gradient()(1, 2) + some_gradient()(2, 1), 1e-11);

      // Floating, the strain alone is known.
      solver->set_constrained(DofMask(body.n_columns(), 1));
      u.set_zero();
      solver->solve(u, force, 1e-13);
      body.evaluate(u, 0, cells);
      for (const VoigtVector<3> &strain : cells.strain)
        {
          EXPECT_NEAR(strain(0), some_gradient()(0, 0), 1e-10);
          EXPECT_NEAR(strain(5), some_gradient()(0, 1) + some_gradient()(1, 0), 1e-10);
        }
    }
}

TEST(MeshStatics, SixRigidMotions)
{
  const auto owner = verification::divided(brick({2, 2, 2}, {1., 2., 1.5}, true, 0.));
  const MeshBody<3> &body = *owner;
  DofMask mask(body.n_columns(), 1);
  const auto motions = free_rigid_motions<3>(body, mask);
  ASSERT_EQ(motions.size(), 6);
  NodalField<double> Ku = body.zero_field();
  for (const NodalField<double> &motion : motions)
    {
      body.vmult(Ku, motion);
      EXPECT_LT(largest_difference(Ku, body.zero_field()), 1e-13);
    }
  const SurfaceNodes<3> &bottom = body.surface(4);
  for (std::size_t k = 0; k < bottom.nodes.size(); ++k)
    for (unsigned int c = 0; c < 3 && bottom.place(k) == 0; ++c)
      mask.constrain(c, bottom.nodes[k]);
  EXPECT_EQ(free_rigid_motions<3>(body, mask).size(), 3);
  for (const NodeIndex &node : bottom.nodes)
    mask.constrain(2, node);
  EXPECT_EQ(free_rigid_motions<3>(body, mask).size(), 1);
}

// A prism that can only move along z is a chain of masses and springs: with c^2 = C33 / rho
// the angular frequencies of n cells of height h are 2 c / h sin (k pi / 2 n).
TEST(MeshStatics, ModesOfAPrismAreThoseOfAChain)
{
  constexpr unsigned int n = 12;
  const double h           = 0.25;
  const auto owner = verification::divided(brick({2, 3, n}, {1., 1., n * h}, false, 0.));
  const MeshBody<3> &body = *owner;
  DofMask mask(body.n_columns(), 1);
  mask.constrain_row(0, 0);
  mask.constrain_row(1, 0);
  VibrationModesOptions options;
  options.n_modes  = 2;
  const auto found = vibration_modes<3>(body, mask, options);
  EXPECT_EQ(found.n_rigid_motions, 1);
  const double c = std::sqrt(body.phases()[0].stiffness(2, 2) / density);
  // Shear waves along x and y are slower; the first ones are longer than the prism is wide.
  const double expected = c / (M_PI * h) * std::sin(M_PI / (2. * n));
  EXPECT_NEAR(found.modes[0].frequency, expected, 1e-9 * expected);
  EXPECT_LT(found.modes[0].residual, 1e-8);
}

// Groups of faces stand for contact and top.
TEST(MeshStatics, NamedBoundaries)
{
  MeshBodyInput<3> input = brick({2, 2, 2}, {1., 1., 1.}, false, 0.);
  input.mesh.boundaries  = {"slope"};
  input.contact_boundary = "slope";
  EXPECT_ANY_THROW(MeshBody<3>(input, MPI_COMM_WORLD));
  const MeshBody<3> whole(brick({2, 2, 2}, {1., 1., 1.}, false, 0.), MPI_COMM_SELF);
  // One of the four faces of the lower side.
  for (const auto &cell : input.mesh.cells)
    {
      std::vector<unsigned int> face;
      for (const unsigned int v : cell.vertices)
        if (input.mesh.points[v][2] == 0. && input.mesh.points[v][0] < 0.6 &&
            input.mesh.points[v][1] < 0.6)
          face.push_back(v);
      if (face.size() == 4)
        {
          input.mesh.faces.emplace_back(4);
          input.mesh.faces.back().vertices    = face;
          input.mesh.faces.back().boundary_id = 0;
        }
    }
  const MeshBody<3> part(input, MPI_COMM_WORLD);
  ASSERT_EQ(part.surface(4).nodes.size(), 4);
  EXPECT_EQ(whole.surface(4).nodes.size(), 9);
  double area = 0.;
  for (const auto &normal : part.surface(4).normal_area)
    area += normal[2];
  EXPECT_NEAR(area, -0.25, 1e-14);
}
