// Fields that are divided among the ranks against whole ones: products, modes under a platen
// and static contact. Runs on any number of ranks.

#include "../mesh_sliding/mesh_sliding.h"
#include "base/exchange.h"
#include "body/mesh/mesh_body.h"
#include "contact/static_contact_solver.h"
#include "divided_body.h"
#include "eigenvalues/vibration_modes.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

using namespace mesoslip;

namespace
{
/** A bar whose two ends are of two phases. Standing, its contact is far from its top; lying, it
 * may be periodic from one end to the other. On two ranks and more some have no contact
 * node, or no cell of a phase, or one of two points that move together. */
MeshBodyInput<3> bar(const bool standing, const bool simplices)
{
  const std::array<unsigned int, 3> cells = standing
                                              ? std::array<unsigned int, 3>{{2, 3, 10}}
                                              : std::array<unsigned int, 3>{{10, 3, 2}};
  const unsigned int axis                 = standing ? 2 : 0;
  verification::MeshCase<3> c;
  c.mesh =
    verification::brick<3>(cells, {{0.25 * cells[0], 0.3 * cells[1], 0.25 * cells[2]}},
                           {simplices, simplices ? 0.05 : 0.2});
  c.mesh.phases = {"one", "other"};
  for (auto &cell : c.mesh.cells)
    {
      dealii::Point<3> middle;
      for (const unsigned int v : cell.vertices)
        middle += c.mesh.points[v] / static_cast<double>(cell.vertices.size());
      cell.material_id = middle[axis] < 1. ? 0 : 1;
    }
  if (!standing)
    c.join(0);
  MeshBodyInput<3> body;
  body.mesh        = c.mesh;
  body.phases      = {{isotropic_stiffness<3>(2., 0.3), 1.5},
                      {isotropic_stiffness<3>(20., 0.2), 3.}};
  body.periodicity = {!standing, false};
  return body;
}

/** Largest difference from the field @p whole of the body @p all, over the largest value. */
double difference(const ElasticBody<3> &body,
                  const NodalField<double> &field,
                  const MeshBody<3> &all,
                  const NodalField<double> &whole)
{
  double most = 0., largest = 0.;
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    for (unsigned int c = 0; c < 3; ++c)
      {
        const NodeIndex node = *all.find(static_cast<unsigned int>(body.number({i, 0})));
        most    = std::max(most, std::fabs(field(c, {i, 0}) - whole(c, node)));
        largest = std::max(largest, std::fabs(whole(c, node)));
      }
  return dealii::Utilities::MPI::max(most, MPI_COMM_WORLD) /
         dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD);
}

NodalField<double> some_field(const ElasticBody<3> &body)
{
  NodalField<double> u = body.zero_field();
  for (unsigned int i = 0; i < body.n_columns(); ++i)
    {
      const auto p = body.point({i, 0});
      for (unsigned int c = 0; c < 3; ++c)
        u.row(c, 0)[i] = std::sin(p[0] + 2. * p[1] + c) + p[2] * p[2];
    }
  body.update_copies(u);
  return u;
}

/** Pressed by a top that is lowered, on a flat that is not everywhere as high. */
StaticContactSolution pressed_bar(const ElasticBody<3> &body, const int sliding)
{
  const SurfaceNodes<3> &bottom = body.surface(ElasticBody<3>::bottom);
  StaticContactProblem problem;
  problem.constrained  = verification::held_at_top(body);
  problem.displacement = body.zero_field();
  problem.force        = body.zero_field();
  for (const NodeIndex &node : body.surface(ElasticBody<3>::top).nodes)
    problem.displacement(2, node) = -0.02;
  for (std::size_t k = 0; k < bottom.normal_area.size(); ++k)
    problem.gap.push_back(0.004 * static_cast<double>(k % 4));
  // On a flat at rest all nodes that touch it stick.
  problem.friction_coefficient.assign(bottom.normal_area.size(),
                                      sliding == 0 ? 50. : 0.2);
  problem.sliding = sliding;
  StaticContactOptions options;
  options.tolerance = 1e-11;
  return solve_static_contact<3>(body, problem, options);
}
} // namespace

TEST(DividedBody, IsThatOfWholeFields)
{
  for (const bool standing : {true, false})
    for (const bool simplices : {false, true})
      {
        SCOPED_TRACE(std::string(standing ? "standing" : "lying") +
                     (simplices ? ", tetrahedra" : ", hexahedra"));
        const MeshBodyInput<3> input = bar(standing, simplices);
        const MeshBody<3> all(input, MPI_COMM_SELF);
        const auto owner        = verification::divided(input);
        const MeshBody<3> &body = *owner;
        EXPECT_EQ(body.n_cells(), all.n_cells());
        EXPECT_NEAR(body.total_mass(), all.total_mass(), 1e-12 * all.total_mass());

        // What a rank has, it has as those that count it.
        NodalField<double> Ku = body.zero_field(), whole = all.zero_field();
        const NodalField<double> u = some_field(body), of_all = some_field(all);
        EXPECT_LT(difference(body, u, all, of_all), 1e-14);
        body.vmult(Ku, u);
        all.vmult(whole, of_all);
        EXPECT_LT(difference(body, Ku, all, whole), 1e-13);
        std::vector<double> mass(1, 0.);
        const std::vector<double> masses = body.lumped_mass();
        for (unsigned int i = 0; i < body.n_columns(); ++i)
          mass[0] += body.is_counted({i, 0}) ? masses[i] : 0.;
        sum_over_ranks(mass, body.communicator());
        EXPECT_NEAR(mass[0], body.total_mass(), 1e-12 * body.total_mass());

        VibrationModesOptions options;
        options.n_modes = 3;
        options.platens = {verification::platen_on_top(body, 0.7)};
        const auto modes =
          vibration_modes<3>(body, verification::held_at_top(body), options);
        options.platens = {verification::platen_on_top(all, 0.7)};
        const auto expected =
          vibration_modes<3>(all, verification::held_at_top(all), options);
        EXPECT_EQ(modes.n_rigid_motions, expected.n_rigid_motions);
        for (std::size_t k = 0; k < expected.modes.size(); ++k)
          {
            const VibrationMode<3> &one = modes.modes[k], &other = expected.modes[k];
            EXPECT_NEAR(one.frequency, other.frequency, 1e-9 * other.frequency);
            EXPECT_NEAR(one.modal_mass, other.modal_mass, 1e-6 * other.modal_mass);
            for (unsigned int c = 0; c < 3; ++c)
              EXPECT_NEAR(one.effective_mass[c], other.effective_mass[c], 1e-7);
            EXPECT_LT(difference(body, one.shape, all, other.shape), 1e-6) << k;
          }

        for (const int sliding : {0, 1})
          {
            const auto found = pressed_bar(body, sliding),
                       same  = pressed_bar(all, sliding);
            EXPECT_EQ(found.state, same.state);
            EXPECT_LT(difference(body, found.displacement, all, same.displacement), 1e-8);
            const double force =
              *std::max_element(same.normal_force.begin(), same.normal_force.end());
            EXPECT_GT(force, 0.);
            for (std::size_t k = 0; k < same.normal_force.size(); ++k)
              EXPECT_NEAR(found.normal_force[k], same.normal_force[k], 1e-8 * force);
            for (std::size_t k = 0; k < same.tangential_force.size(); ++k)
              EXPECT_NEAR(found.tangential_force[k], same.tangential_force[k],
                          1e-8 * force);
          }
      }
}
