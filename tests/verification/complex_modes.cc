// Complex eigenvalues of steady sliding: the exact dispersion relation of a layer, neutral and
// multiple eigenvalues, the balance of energy. The bodies are whole on each rank.

#include "eigenvalues/complex/complex_modes.h"
#include "body/grid_body.h"
#include "body/mesh/mesh_body.h"
#include "eigenvalues/complex/still_vibrations.h"
#include "eigenvalues/free_dofs.h"
#include "sliding/sliding_layer.h"

#include "../measured.h"
#include "turns.h"

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

/** Top u_x = 0 and free in y, as layer_setup() has it, unless it stands on something; the contact on the flat. */
SlidingPencil layer_pencil(const ElasticBody<2> &body,
                           const Layer &layer,
                           const FrictionSlopes &slopes = {},
                           const double state_time      = 0.)
{
  DofMask held(body.n_columns(), body.n_rows());
  if (body.foundation().springs.empty())
    held.constrain_row(0, body.n_rows() - 1);
  const bool rigid = std::isinf(layer.springs);
  if (rigid)
    held.constrain_row(1, 0);
  SlidingNodesAtRest contact;
  for (const NodeIndex &node : body.surface(2).nodes)
    if (node.i + 1 < body.n_columns())
      {
        contact.nodes.push_back(node);
        contact.friction.push_back(layer.mu);
        contact.normal_force.push_back(10. * P * body.extent(0) / (body.n_columns() - 1));
        contact.slopes.push_back(slopes);
        if (!rigid)
          contact.stiffness.push_back(layer.springs * body.extent(0) /
                                      (body.n_columns() - 1));
      }
  const FreeDofs<2> dofs(body, held, {});
  return make_sliding_pencil<2>(body, whole_stiffness(body, MPI_COMM_WORLD), dofs,
                                contact,
                                {layer.delta, layer.beta, state_time, layer.alpha});
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
  if (has_turn(0))
    expect_order_two({1.15, 0.25, 0., 0.}, "Coulomb");
}

TEST(ComplexModes, OfTheLayerOnSprings)
{
  if (!has_turn(2))
    return;
  Layer layer   = {1.15, 0.25, 0., 0.};
  layer.springs = 1e13 * Layer::G / 12.5e9;
  EXPECT_NEAR(layer.fastest().real(), 28061.032, 2e-3);
  expect_order_two(layer, "on springs");
  layer         = {1., 0.25, 1.5e-6, 4.4e-9};
  layer.springs = 3e13;
  layer.alpha   = 1e4;
  expect_order_two(layer, "on springs, regularized and damped");
}

TEST(ComplexModes, OfTheRegularizedAndDampedLayer)
{
  if (has_turn(1))
    expect_order_two({1., 0.25, 1.5e-6, 4.4e-9}, "regularized and damped");
}

namespace
{
/** What a layer hangs on: springs, dashpots and mass for the area, along x and y. */
struct Hanger
{
  std::array<double, 2> stiffness, dashpot; ///< Pa/m, Pa s/m
  double mass;                              ///< kg/m^2
};

/** The determinant of the conditions at the flat and at the top for the potentials of both waves,
 * phi = A cosh a y + B sinh a y and psi likewise, u = (i k phi + psi', phi' - i k psi). */
Complex hanging_layer(const Layer &layer, const Hanger &top, const Complex s)
{
  const double k  = layer.k();
  const Complex a = layer.decay(s, layer.c_L()), b = layer.decay(s, c_T),
                G = Layer::G * layer.softening(s), q = b * b + k * k,
                mu = layer.friction(s);
  std::array<Complex, 2> on;
  for (unsigned int c = 0; c < 2; ++c)
    on[c] = top.stiffness[c] + s * top.dashpot[c] + s * (s + layer.alpha) * top.mass;
  Eigen::Matrix4cd conditions;
  for (int n = 0; n < 4; ++n)
    {
      // Potential n, its derivative and, of psi, the second one at a height.
      const auto of_top = [&](const double y, const bool shear) {
        const Complex r = shear ? b : a;
        const bool even = n % 2 == 0, other = shear != (n > 1);
        const Complex c = std::cosh(r * y), d = std::sinh(r * y);
        return std::array<Complex, 2>{{other  ? 0.
                                       : even ? c
                                              : d,
                                       other ? 0. : r * (even ? d : c)}};
      };
      for (const bool top_side : {false, true})
        {
          const auto phi   = of_top(top_side ? H : 0., false),
                     psi   = of_top(top_side ? H : 0., true);
          const Complex ux = I * k * phi[0] + psi[1], uy = phi[1] - I * k * psi[0],
                        xy = G * (2. * I * k * phi[1] + q * psi[0]),
                        yy = G * (q * phi[0] - 2. * I * k * psi[1]);
          conditions(top_side ? 2 : 0, n) =
            top_side ? xy + on[0] * ux : Layer::G / H * uy;
          conditions(top_side ? 3 : 1, n) = top_side ? yy + on[1] * uy : xy - mu * yy;
        }
      conditions.col(n) /= std::cosh((n < 2 ? a : b) * H);
    }
  return conditions.determinant() / std::pow(Layer::G / H, 4);
}

/** The top of the @p body, which is periodic, on it. */
void hang(GridBody<2> &body, const Hanger &top)
{
  const unsigned int columns = body.n_columns() - 1;
  const double area          = body.extent(0) / columns;
  Foundation foundation;
  for (unsigned int i = 0; i < columns; ++i)
    {
      const NodeIndex node = {i, body.n_rows() - 1};
      for (unsigned int c = 0; c < 2; ++c)
        {
          foundation.springs.push_back({node, c, c, area * top.stiffness[c]});
          foundation.dashpots.push_back({node, c, c, area * top.dashpot[c]});
        }
      foundation.masses.emplace_back(node, area * top.mass);
    }
  body.stand_on(foundation);
}

/** From @p s to the root of @p relation near it or, of waves the other way, near its conjugate; relative. */
template <typename Relation>
double distance_to_root(const Relation &relation, const Complex s)
{
  double least = 1.;
  for (const Complex start : {s, std::conj(s)})
    {
      Complex root = start;
      for (unsigned int k = 0; k < 50; ++k)
        {
          const double step = 1e-6 * std::abs(root);
          root -=
            relation(root) * 2. * step / (relation(root + step) - relation(root - step));
        }
      least = std::min(least, std::abs(root - start) / std::abs(start));
    }
  return least;
}
} // namespace

// Springs, dashpots and mass of the top: of the wave that is as long as the layer one direction grows and one decays.
TEST(ComplexModes, OfTheLayerThatHangsOnSprings)
{
  if (!has_turn(1))
    return;
  const Hanger top = {{{3e12, 5e12}}, {{2e6, 1e6}}, 6.};
  Layer layer      = {1.15, 0.25, 1.5e-6, 4.4e-9};
  layer.alpha      = 2e3;
  std::array<std::vector<double>, 2> errors;
  for (const unsigned int n : {10, 20})
    {
      const UniformMaterial material = layer_material(layer, n);
      GridBody<2> body(material);
      hang(body, top);
      ComplexModesOptions options;
      options.highest_frequency  = 60e3;
      options.least_growth       = -4e4;
      const SlidingPencil pencil = layer_pencil(body, layer);
      const ComplexModes found =
        find_complex_modes(pencil, friction_radius(pencil), options);
      EXPECT_EQ(found.n_missing, 0);
      unsigned int seen = 0;
      for (const ComplexMode &mode : found.modes)
        {
          EXPECT_NEAR(mode.growth_by_friction.sum() + mode.growth_by_damping,
                      mode.s.real(), 1e-6 * std::abs(mode.s));
          const double error = distance_to_root(
            [&](const Complex s) { return hanging_layer(layer, top, s); }, mode.s);
          std::printf("hanging layer, H/%u: s = %g + %g i, error %.3g\n", n,
                      mode.s.real(), mode.s.imag(), error);
          if (error > 0.02 || seen == 2)
            continue;
          errors[seen++].push_back(error);
          measured::error(seen == 1 ? "hanging layer, fast" : "hanging layer, slow", n,
                          error);
        }
      EXPECT_EQ(seen, 2U) << n;
    }
  for (const auto &of_mode : errors)
    {
      ASSERT_EQ(of_mode.size(), 2U);
      EXPECT_LT(of_mode.back(), 1e-3);
      // 2.1 on 20 and 40 cells.
      for (const double order : orders(of_mode))
        EXPECT_NEAR(order, 2., 0.35);
    }
}

// Power of friction by node and of damping over twice the energy sum up to the growth rate.
TEST(ComplexModes, GrowthIsThePowerOfFrictionLessDamping)
{
  Layer layer{1., 0.25, 1.5e-6, 4.4e-9};
  layer.alpha                    = 2e3;
  layer.springs                  = 1e14;
  const UniformMaterial material = layer_material(layer, 10);
  const ComplexModes found = modes_of(layer_pencil(GridBody<2>(material), layer), 200e3);
  ASSERT_GT(found.modes.size(), 2U);
  for (const ComplexMode &mode : found.modes)
    {
      EXPECT_LT(mode.growth_by_damping, 0.);
      EXPECT_NEAR(mode.growth_by_friction.sum() + mode.growth_by_damping, mode.s.real(),
                  1e-6 * std::abs(mode.s));
    }
}

// The periodic layer has each frequency twice.
TEST(ComplexModes, VibrationsWithoutFrictionAreThoseOfTheSymmetricProblem)
{
  if (!has_turn(0))
    return;
  const Layer layer{1., 0.25, 1.5e-6, 4.4e-9};
  const UniformMaterial material = layer_material(layer, 8);
  const SlidingPencil still =
    without_friction(layer_pencil(GridBody<2>(material), layer));
  const Eigen::MatrixXd K = still.stiffness, M = still.mass;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(
    K, M, Eigen::EigenvaluesOnly);
  const CountedRange range = {2e5, 6e6, 1e99, 0., 0.3};
  std::vector<double> expected, found;
  for (const double x : dense.eigenvalues())
    if (const double decay = 0.5 * layer.beta * x, w = std::sqrt(x - decay * decay);
        w > range.low && w < range.top && decay < range.steep * w)
      expected.push_back(w);
  for (const Complex s : find_still(still, range, 1e-10))
    found.push_back(s.imag());
  EXPECT_GT(expected.size(), 30U); // more than one part
  EXPECT_EQ(static_cast<int>(expected.size()), count_still(still, range));
  ASSERT_EQ(found.size(), expected.size());
  std::sort(found.begin(), found.end());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], 1e-8 * expected[k]);
}

// Drag that takes energy leaves the bound alone; one that feeds it widens it, and modes keep to it.
TEST(ComplexModes, KeepToTheBoundWhereFrictionFeeds)
{
  if (!has_turn(1))
    return;
  const Layer layer{1., 0.02, 1.5e-7, 4.4e-9};
  const UniformMaterial material = layer_material(layer, 10);
  const GridBody<2> body(material);
  const FeedingDrag taking = feeding_drag(layer_pencil(body, layer, {0., 0.02, 0.}));
  EXPECT_EQ(taking.at_once, 0.);
  EXPECT_EQ(taking.late, 0.);
  struct Slopes
  {
    FrictionSlopes slopes;
    double state_time;
  };
  for (const Slopes &given :
       {Slopes{{0., -0.02, 0.}, 0.}, Slopes{{0., 0.01, -0.04}, 2e-6}})
    {
      const SlidingPencil pencil =
        layer_pencil(body, layer, given.slopes, given.state_time);
      const FeedingDrag drag = feeding_drag(pencil);
      const double of_node   = 10. * P / (0.5 * resin().density * H / 10);
      EXPECT_NEAR(drag.at_once, std::fabs(given.slopes.rate) * of_node, 1e-9 * of_node);
      EXPECT_NEAR(drag.late, std::fabs(given.slopes.state) * of_node, 1e-9 * of_node);
      const double radius = friction_radius(pencil);
      const GrowthRegion region(pencil.law, radius, drag), of_coulomb(pencil.law, radius);
      const ComplexModes found = modes_of(pencil, 90e3);
      ASSERT_GT(found.modes.size(), 0U);
      EXPECT_EQ(found.n_missing, 0);
      EXPECT_LT(of_coulomb.highest_frequency(), region.highest_frequency());
      bool is_beyond = false;
      for (const ComplexMode &mode : found.modes)
        {
          const double w = mode.s.imag();
          EXPECT_LT(mode.s.real(), region.width(w, w));
          is_beyond = is_beyond || mode.s.real() > of_coulomb.width(w, w);
          EXPECT_NEAR(mode.growth_by_friction.sum() + mode.growth_by_damping,
                      mode.s.real(), 1e-6 * std::abs(mode.s));
        }
      EXPECT_TRUE(is_beyond); // of the bound for Coulomb's friction
    }
}
