// Complex eigenvalues of steady sliding: the exact dispersion relation of a layer, neutral and
// multiple eigenvalues, the balance of energy, meshes and ranks.

#include "eigenvalues/complex/complex_modes.h"
#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"
#include "sliding_layer.h"

#include "../measured.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
/** Cells of the layer, over one wave length. */
UniformMaterial layer_material(const Layer &layer, const unsigned int n)
{
  const BodySetup setup = layer_setup(layer, n);
  return UniformMaterial({setup.cells, setup.spacing}, setup.classes, {}, {true, false});
}

/** Top u_x = 0 and free in y, as layer_setup() has it; the contact on the flat. */
SlidingPencil layer_pencil(const ElasticBody<2> &body, const Layer &layer)
{
  DofMask held(body.n_columns(), body.n_rows());
  held.constrain_row(0, body.n_rows() - 1);
  held.constrain_row(1, 0);
  SlidingNodesAtRest contact;
  for (const NodeIndex &node : body.surface(2).nodes)
    if (node.i + 1 < body.n_columns())
      {
        contact.nodes.push_back(node);
        contact.friction.push_back(layer.mu);
      }
  const FreeDofs<2> dofs(body, held, std::nullopt);
  return make_sliding_pencil<2>(body, whole_stiffness(body, MPI_COMM_WORLD), dofs,
                                contact, {layer.delta, layer.beta});
}

ComplexModes modes_of(const SlidingPencil &pencil, const double highest_frequency)
{
  ComplexModesOptions options;
  options.highest_frequency = highest_frequency;
  return find_complex_modes(pencil, friction_radius(pencil), options);
}

/** The exact growth of the wave that is as long as the layer: order two in the cells. */
void expect_order_two(const Layer &layer, const std::string &law)
{
  const Complex exact(layer.fastest().real(), std::fabs(layer.fastest().imag()));
  std::vector<double> errors;
  for (const unsigned int n : {10, 20})
    {
      const UniformMaterial material = layer_material(layer, n);
      const ComplexModes found =
        modes_of(layer_pencil(GridBody<2>(material), layer), 70e3);
      EXPECT_EQ(found.n_missing, 0);
      double nearest = 1e99;
      for (const ComplexMode &mode : found.modes)
        nearest = std::min(nearest, std::abs(mode.s - exact));
      errors.push_back(nearest / std::abs(exact));
      std::printf("%s, H/%u: error %.3g of s; %zu modes, %u shifts, %u factorizations, "
                  "radius %.5f\n",
                  law.c_str(), n, errors.back(), found.modes.size(), found.n_shifts,
                  found.n_factorizations, found.radius);
      measured::error("complex modes, " + law, n, errors.back());
    }
  EXPECT_LT(errors.back(), 1e-3);
  for (const double order : orders(errors))
    EXPECT_NEAR(order, 2., 0.25);
}
} // namespace

TEST(ComplexModes, OfTheLayerWithCoulombFriction)
{
  expect_order_two({1.15, 0.25, 0., 0.}, "Coulomb");
}

TEST(ComplexModes, OfTheRegularizedAndDampedLayer)
{
  expect_order_two({1., 0.25, 1.5e-6, 4.4e-9}, "regularized and damped");
}

// Power of friction by node and of damping over twice the energy sum up to the growth rate.
TEST(ComplexModes, GrowthIsThePowerOfFrictionLessDamping)
{
  const Layer layer{1., 0.25, 1.5e-6, 4.4e-9};
  const UniformMaterial material = layer_material(layer, 20);
  const ComplexModes found = modes_of(layer_pencil(GridBody<2>(material), layer), 200e3);
  ASSERT_GT(found.modes.size(), 2U);
  for (const ComplexMode &mode : found.modes)
    {
      EXPECT_LT(mode.growth_by_damping, 0.);
      EXPECT_NEAR(mode.growth_by_friction.sum() + mode.growth_by_damping, mode.s.real(),
                  1e-6 * std::abs(mode.s));
    }
}
