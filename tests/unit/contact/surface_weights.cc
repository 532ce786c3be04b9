#include "contact/pair/mortar_weights.h"
#include "contact/pair/tensor_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace mesoslip;

namespace
{
/** Nodes of n x m cells on a rectangle, of which those inside are moved by up to @p shift of a cell. */
std::vector<SurfaceFacet::Place> places(const unsigned int n,
                                        const unsigned int m,
                                        const SurfaceFacet::Place &lower,
                                        const SurfaceFacet::Place &size,
                                        const double shift)
{
  std::mt19937 random(n + 100 * m);
  std::uniform_real_distribution<double> some(-shift, shift);
  std::vector<SurfaceFacet::Place> all;
  for (unsigned int i = 0; i <= n; ++i)
    for (unsigned int j = 0; j <= m; ++j)
      {
        const double in_x = i % n == 0 ? 0. : some(random),
                     in_y = j % m == 0 ? 0. : some(random);
        all.push_back(
          {{lower[0] + (i + in_x) * size[0] / n, lower[1] + (j + in_y) * size[1] / m}});
      }
  return all;
}

/** Quadrilaterals between these places, or triangles. */
ContactFacets facets(const unsigned int n,
                     const unsigned int m,
                     const std::vector<SurfaceFacet::Place> &place,
                     const bool triangles)
{
  ContactFacets contact{(n + 1) * (m + 1), {}};
  const auto add = [&](const std::vector<unsigned int> &nodes) {
    SurfaceFacet facet;
    facet.n = static_cast<unsigned int>(nodes.size());
    for (unsigned int v = 0; v < facet.n; ++v)
      {
        facet.node[v]  = nodes[v];
        facet.place[v] = place[nodes[v]];
      }
    contact.facets.push_back(facet);
  };
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < m; ++j)
      {
        const unsigned int a = i * (m + 1) + j, b = a + m + 1, c = b + 1, d = a + 1;
        if (triangles)
          {
            add({a, b, c});
            add({a, c, d});
          }
        else
          add({a, b, c, d});
      }
  return contact;
}

/** Integrals of the shape functions. */
std::vector<double> areas(const ContactFacets &contact)
{
  std::vector<double> area(contact.n_nodes);
  std::vector<WeightedPlace> points;
  for (const SurfaceFacet &facet : contact.facets)
    {
      quadrature_of_overlap(facet, facet, points);
      for (const auto &[at, weight] : points)
        for (unsigned int v = 0; v < facet.n; ++v)
          area[facet.node[v]] += weight * facet.shapes(at)[v];
    }
  return area;
}

/** Weights reproduce what is linear below, and a constant pressure above is one below. */
void expect_patches(const std::array<unsigned int, 4> &cells,
                    const double shift,
                    const bool triangles,
                    const double tolerance)
{
  const auto [n, m, k, l]      = cells;
  const auto upper             = places(n, m, {{0., 0.}}, {{3., 2.}}, shift),
             lower             = places(k, l, {{0., 0.}}, {{3., 2.}}, shift);
  const ContactFacets above    = facets(n, m, upper, triangles),
                      below    = facets(k, l, lower, triangles);
  const SurfaceWeights weights = MortarWeights(above, below, {}).at({});
  const auto linear            = [](const SurfaceFacet::Place &at) {
    return 2. - 0.7 * at[0] + 1.3 * at[1];
  };
  std::vector<double> values;
  for (const SurfaceFacet::Place &at : lower)
    values.push_back(linear(at));
  for (unsigned int i = 0; i < above.n_nodes; ++i)
    EXPECT_NEAR(weights.of(values.data(), i), linear(upper[i]), tolerance);
  const std::vector<double> own = areas(above), other = areas(below);
  std::vector<double> pressed(below.n_nodes);
  weights.spread<1>(own, pressed);
  for (unsigned int j = 0; j < below.n_nodes; ++j)
    EXPECT_NEAR(pressed[j], other[j], tolerance);
}
} // namespace

TEST(MortarWeights, ReproduceLinearFieldsAndConstantPressures)
{
  expect_patches({{4, 3, 5, 7}}, 0., false, 1e-13);
  expect_patches({{6, 5, 2, 3}}, 0., false, 1e-13);
  expect_patches({{4, 3, 5, 7}}, 0.3, true, 1e-13);
  expect_patches({{7, 6, 3, 2}}, 0.3, true, 1e-13);
}

// The shape functions of a quadrilateral that is no parallelogram are no polynomials, so that a quadrature of degree five leaves an
// error, which falls with the cells.
TEST(MortarWeights, AreNearlySoOnDistortedQuadrilaterals)
{
  expect_patches({{4, 3, 5, 7}}, 0.1, false, 3e-4);
  expect_patches({{16, 12, 20, 28}}, 0.1, false, 3e-5);
}

TEST(TensorWeights, AreThoseOfTheFacets)
{
  const ContactFacets above =
                        facets(4, 3, places(4, 3, {{0., 0.}}, {{3., 2.}}, 0.), false),
                      below =
                        facets(5, 7, places(5, 7, {{-1., 0.}}, {{5., 2.}}, 0.), false);
  ASSERT_TRUE(grid_of(above) && grid_of(below));
  const MortarWeights mortar(above, below, {});
  const TensorWeights tensor(*grid_of(above), *grid_of(below), {});
  for (const double way : {0., 0.123, -0.9, 0.5})
    {
      const SurfaceWeights one = mortar.at({{way, 0.}}), other = tensor.at({{way, 0.}});
      for (unsigned int j = 0; j < below.n_nodes; ++j)
        {
          std::vector<double> unit(below.n_nodes);
          unit[j] = 1.;
          for (unsigned int k = 0; k < above.n_nodes; ++k)
            EXPECT_NEAR(one.of(unit.data(), k), other.of(unit.data(), k), 1e-13);
        }
    }
}

TEST(TensorWeights, KnowWhatIsNoGrid)
{
  EXPECT_FALSE(grid_of(facets(4, 3, places(4, 3, {{0., 0.}}, {{3., 2.}}, 0.1), false)));
  EXPECT_FALSE(grid_of(facets(4, 3, places(4, 3, {{0., 0.}}, {{3., 2.}}, 0.), true)));
  ContactFacets with_hole = facets(4, 3, places(4, 3, {{0., 0.}}, {{3., 2.}}, 0.), false);
  with_hole.facets.erase(with_hole.facets.begin() + 5);
  EXPECT_FALSE(grid_of(with_hole));
}

// Once continuously differentiable: central differences around the moment when nodes pass each other agree from both sides.
TEST(MortarWeights, ChangeSmoothlyWhereNodesPass)
{
  const ContactFacets above =
                        facets(4, 1, places(4, 1, {{0., 0.}}, {{3., 1.}}, 0.), false),
                      below =
                        facets(6, 1, places(6, 1, {{-1., 0.}}, {{5., 1.}}, 0.), false);
  const MortarWeights mortar(above, below, {});
  const double passes = 0.25,
               h = 1e-5; // of the upper node at 0.75 and the lower one at 2/3, and others
  const auto at  = [&](const double way, const unsigned int k, const unsigned int j) {
    std::vector<double> unit(below.n_nodes);
    unit[j] = 1.;
    return mortar.at({{way, 0.}}).of(unit.data(), k);
  };
  for (const double way : {passes, 0.5 - 1. / 3. * 0.25, 1. / 12., 2. / 3.})
    for (unsigned int k = 0; k < above.n_nodes; ++k)
      for (unsigned int j = 0; j < below.n_nodes; ++j)
        {
          const double before = (at(way, k, j) - at(way - h, k, j)) / h,
                       after  = (at(way + h, k, j) - at(way, k, j)) / h;
          EXPECT_NEAR(before, after, 50. * h);
        }
}

TEST(MortarWeights, SayWhereTheSurfaceBelowEnds)
{
  const ContactFacets above =
                        facets(4, 1, places(4, 1, {{0., 0.}}, {{3., 1.}}, 0.), false),
                      below =
                        facets(6, 1, places(6, 1, {{-1., 0.}}, {{5., 1.}}, 0.), false);
  const MortarWeights mortar(above, below, {}), endless(above, below, {{5., 0.}});
  EXPECT_NO_THROW(mortar.at({{-1., 0.}}));
  EXPECT_ANY_THROW(mortar.at({{1.01, 0.}}));
  EXPECT_ANY_THROW(mortar.at({{-1.01, 0.}}));
  const SurfaceWeights one   = endless.at({{0.3, 0.}}),
                       later = endless.at({{0.3 - 35., 0.}});
  for (std::size_t e = 0; e < one.rows.entries.size(); ++e)
    EXPECT_NEAR(one.rows.entries[e].weight, later.rows.entries[e].weight, 1e-12);
}
