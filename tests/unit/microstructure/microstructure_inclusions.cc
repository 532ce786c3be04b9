// Random inclusions in 3D: fractions, distances, rasterization, orientations.
#include "microstructure_testing.h"

#include "morphology/random_inclusions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
/** Cells that are no cubes, so that every mix-up of axes shows. */
const UniformGrid<3> oblong_box = {{{30, 40, 25}}, {{1e-4, 0.7e-4, 1.3e-4}}, {}};

InclusionPlacement rules_of(const InclusionShape shape, const InclusionSides sides)
{
  InclusionPlacement rules;
  rules.shape        = shape;
  rules.sides        = sides;
  rules.seed         = 4711;
  rules.min_diameter = 0.4e-3;
  rules.max_diameter = 0.8e-3;
  rules.axis         = 1;
  if (rules.has_length())
    {
      rules.min_length = 0.5e-3;
      rules.max_length = 1.5e-3;
    }
  if (shape == InclusionShape::ellipsoid)
    rules.axis_ratios = {{1.5, 0.5, 1.}};
  rules.turned = shape == InclusionShape::ellipsoid;
  return rules;
}

const std::vector<InclusionShape> all_shapes = {
  InclusionShape::sphere, InclusionShape::ellipsoid, InclusionShape::cylinder,
  InclusionShape::bar};

/** Offsets (m) of the periodic images; only the box itself where it is not periodic. */
std::vector<Vector3> images_of(const UniformGrid<3> &grid, const InclusionSides sides)
{
  std::vector<Vector3> offsets;
  const int n = sides == InclusionSides::periodic ? 1 : 0;
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      for (int z = -n; z <= n; ++z)
        offsets.push_back({{x * grid.extent(0), y * grid.extent(1), z * grid.extent(2)}});
  return offsets;
}

Vector3 difference(const Vector3 &a, const Vector3 &b)
{
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}

double length(const Vector3 &d)
{
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/** Points of the surface of an ellipsoid (@p n of a Fibonacci lattice), from its centre. */
std::vector<Vector3> surface_points(const Inclusion &e, const unsigned int n)
{
  std::vector<Vector3> points;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double z = 1. - (2. * i + 1.) / n, r = std::sqrt(1. - z * z);
      const double turn  = i * M_PI * (3. - std::sqrt(5.));
      const Vector3 unit = {{r * std::cos(turn), r * std::sin(turn), z}};
      Vector3 point      = {};
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int c = 0; c < 3; ++c)
          point[c] += unit[k] * e.half[k] * e.axes[k][c];
      points.push_back(point);
    }
  return points;
}

/** Whether a point of the surface of one lies in the other; @p d is from a to b. */
bool surfaces_enter(const Inclusion &a,
                    const Inclusion &b,
                    const Vector3 &d,
                    const unsigned int n)
{
  for (const Vector3 &point : surface_points(a, n))
    if (b.contains(difference(point, d)))
      return true;
  for (const Vector3 &point : surface_points(b, n))
    if (a.contains({{point[0] + d[0], point[1] + d[1], point[2] + d[2]}}))
      return true;
  return false;
}

/** Free distance (m) of two spheres, cylinders or bars along @p axis, as in the manual. */
double free_distance(const Inclusion &a,
                     const Inclusion &b,
                     const Vector3 &d,
                     const unsigned int axis)
{
  const auto along = [&](const unsigned int c) {
    return std::fabs(d[c]) - a.half[c] - b.half[c];
  };
  if (a.shape == InclusionShape::sphere)
    return length(d) - a.half[0] - b.half[0];
  if (a.shape == InclusionShape::bar)
    return std::max({along(0), along(1), along(2)});
  Vector3 across           = d;
  across[axis]             = 0.;
  const unsigned int other = (axis + 1) % 3;
  return std::max(along(axis), length(across) - a.half[other] - b.half[other]);
}
} // namespace

TEST(RandomInclusions, OverlappingSpheresFollowPoisson)
{
  // A cell is covered by a sphere with the probability V / |box|, so it is free with
  // (1 - V / |box|)^n, which is exp(-n V / |box|) for many spheres.
  const UniformGrid<3> grid = {{{48, 48, 48}}, {{1e-4, 1e-4, 1e-4}}, {}};
  InclusionPlacement rules;
  rules.allow_overlap   = true;
  rules.fraction_rule   = FractionRule::nominal;
  rules.volume_fraction = 0.7;
  rules.min_diameter = rules.max_diameter = 0.8e-3;
  const double share             = M_PI / 6. * std::pow(0.8e-3, 3) / std::pow(4.8e-3, 3);
  constexpr unsigned int n_seeds = 40;
  double mean = 0., square = 0.;
  for (unsigned int seed = 1; seed <= n_seeds; ++seed)
    {
      rules.seed        = seed;
      const auto placed = place_random_inclusions(grid, rules, 1);
      const double n    = placed.inclusions.size();
      EXPECT_NEAR(placed.nominal_fraction, 0.7, 0.5 * share * 1.1);
      EXPECT_NEAR(n * share, 0.7, 0.01) << "cells by centre keep the volume";
      const double free  = 1. - placed.actual_fraction;
      const double error = free - std::pow(1. - share, n);
      EXPECT_NEAR(std::pow(1. - share, n), std::exp(-n * share), 1e-3);
      mean += error / n_seeds;
      square += error * error / n_seeds;
    }
  const double deviation = std::sqrt((square - mean * mean) / n_seeds);
  EXPECT_LT(deviation, 2e-3);
  EXPECT_LT(std::fabs(mean), 4. * deviation) << "deviation of the mean " << deviation;
}

TEST(RandomInclusions, CellsAreThoseWithTheirCentreInside)
{
  for (const InclusionSides sides :
       {InclusionSides::periodic, InclusionSides::cut, InclusionSides::inside})
    for (const InclusionShape shape : all_shapes)
      for (const bool through : {false, true})
        {
          InclusionPlacement rules = rules_of(shape, sides);
          if (through && !rules.has_length())
            continue;
          if (through)
            rules.min_length = rules.max_length = 0.;
          rules.allow_overlap = true;
          rules.check(oblong_box);
          const auto placed = place_random_inclusions(oblong_box, rules, 3);
          EXPECT_TRUE(placed.target_reached);
          std::size_t wrong = 0, all = 0;
          for (unsigned int k = 0; k < 25; ++k)
            for (unsigned int j = 0; j < 40; ++j)
              for (unsigned int i = 0; i < 30; ++i)
                {
                  const Vector3 at = {
                    {(i + 0.5) * 1e-4, (j + 0.5) * 0.7e-4, (k + 0.5) * 1.3e-4}};
                  bool inside = false;
                  for (const Inclusion &inclusion : placed.inclusions)
                    for (const Vector3 &offset : images_of(oblong_box, sides))
                      inside = inside || inclusion.contains(difference(
                                           difference(at, inclusion.centre), offset));
                  all += inside ? 1 : 0;
                  wrong +=
                    placed.map.id[(k * 40 + j) * 30 + i] == (inside ? 3 : 0) ? 0 : 1;
                }
          EXPECT_EQ(wrong, 0u) << "shape " << static_cast<int>(shape) << ", sides "
                               << static_cast<int>(sides);
          EXPECT_EQ(placed.actual_fraction, all / 30000.);
        }
}

TEST(RandomInclusions, KeepTheirDistance)
{
  for (const InclusionSides sides :
       {InclusionSides::periodic, InclusionSides::cut, InclusionSides::inside})
    for (const InclusionShape shape : all_shapes)
      {
        InclusionPlacement rules = rules_of(shape, sides);
        rules.max_diameter       = 0.5e-3;
        rules.volume_fraction    = 0.2;
        rules.minimum_gap        = shape == InclusionShape::ellipsoid ? 0. : 0.05e-3;
        const auto placed        = place_random_inclusions(oblong_box, rules, 1);
        ASSERT_TRUE(placed.target_reached) << placed.actual_fraction;
        EXPECT_EQ(placed.actual_fraction, placed.nominal_fraction) << "a cell of two";
        EXPECT_NEAR(placed.actual_fraction, 0.2, 0.02);
        const auto &all = placed.inclusions;
        EXPECT_GT(all.size(), 10u);
        for (std::size_t a = 0; a < all.size(); ++a)
          for (std::size_t b = 0; b < a; ++b)
            for (const Vector3 &offset : images_of(oblong_box, sides))
              {
                Vector3 d = difference(all[b].centre, all[a].centre);
                for (unsigned int c = 0; c < 3; ++c)
                  d[c] += offset[c];
                const bool ellipsoids = shape == InclusionShape::ellipsoid;
                // No diameter is longer.
                if (ellipsoids && length(d) < 0.8e-3)
                  {
                    EXPECT_FALSE(surfaces_enter(all[a], all[b], d, 500));
                  }
                if (!ellipsoids)
                  {
                    EXPECT_GE(free_distance(all[a], all[b], d, 1),
                              rules.minimum_gap * (1. - 1e-9));
                  }
              }
        for (const Inclusion &inclusion : all)
          for (unsigned int c = 0; c < 3 && sides == InclusionSides::inside; ++c)
            {
              EXPECT_GE(inclusion.centre[c] - inclusion.reach()[c], -1e-12);
              EXPECT_LE(inclusion.centre[c] + inclusion.reach()[c],
                        oblong_box.extent(c) + 1e-12);
            }
      }
}

TEST(RandomInclusions, EllipsoidsOverlapWhereTheirSurfacesEnter)
{
  RandomNumbers random(4711);
  InclusionPlacement rules =
    rules_of(InclusionShape::ellipsoid, InclusionSides::periodic);
  rules.allow_overlap   = true;
  rules.volume_fraction = 0.9;
  const auto placed     = place_random_inclusions(oblong_box, rules, 1).inclusions;
  ASSERT_GT(placed.size(), 40u);
  unsigned int n_apart = 0, n_overlap = 0;
  for (unsigned int trial = 0; trial < 1000; ++trial)
    {
      Inclusion a = placed[random.whole(0, 39)], b = placed[random.whole(0, 39)];
      const Vector3 d   = {{random.between(-1e-3, 1e-3), random.between(-1e-3, 1e-3),
                            random.between(-1e-3, 1e-3)}};
      const bool enters = surfaces_enter(a, b, d, 4000);
      const bool found  = too_close(a, b, d, 0.);
      EXPECT_TRUE(found || !enters);
      // Between the points there is a little room.
      for (unsigned int k = 0; k < 3; ++k)
        {
          a.half[k] *= 1.02;
          b.half[k] *= 1.02;
        }
      EXPECT_TRUE(!found || surfaces_enter(a, b, d, 4000));
      (found ? n_overlap : n_apart) += 1;
    }
  EXPECT_GT(n_apart, 100u);
  EXPECT_GT(n_overlap, 100u);
}

TEST(RandomInclusions, OrientationsAreUniform)
{
  InclusionPlacement rules = rules_of(InclusionShape::ellipsoid, InclusionSides::cut);
  rules.allow_overlap      = true;
  rules.fraction_rule      = FractionRule::nominal;
  rules.min_diameter = rules.max_diameter = 0.2e-3;
  rules.volume_fraction                   = 0.9;
  const auto placed = place_random_inclusions(oblong_box, rules, 1).inclusions;
  const double n    = placed.size();
  ASSERT_GT(n, 3000.);
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int c = 0; c < 3; ++c)
      {
        double first = 0., second = 0.;
        for (const Inclusion &inclusion : placed)
          {
            first += inclusion.axes[k][c] / n;
            second += std::pow(inclusion.axes[k][c], 2) / n;
          }
        // A component is uniform in [-1, 1]: variances 1/3 and 4/45.
        EXPECT_LT(std::fabs(first), 4.5 * std::sqrt(1. / 3. / n));
        EXPECT_LT(std::fabs(second - 1. / 3.), 4.5 * std::sqrt(4. / 45. / n));
      }
  const auto &axes = placed.front().axes;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      EXPECT_NEAR(axes[a][0] * axes[b][0] + axes[a][1] * axes[b][1] +
                    axes[a][2] * axes[b][2],
                  a == b ? 1. : 0., 1e-14);
}

TEST(RandomInclusions, SeedsAndLimits)
{
  InclusionPlacement rules = rules_of(InclusionShape::sphere, InclusionSides::periodic);
  const auto first         = place_random_inclusions(oblong_box, rules, 1).map.id;
  EXPECT_EQ(first, place_random_inclusions(oblong_box, rules, 1).map.id);
  rules.seed += 1;
  EXPECT_NE(first, place_random_inclusions(oblong_box, rules, 1).map.id);
  // Random sequential addition of equal spheres jams at 0.384 (Torquato 2006).
  const UniformGrid<3> cubes = {{{60, 60, 60}}, {{1e-4, 1e-4, 1e-4}}, {}};
  rules.min_diameter = rules.max_diameter = 0.8e-3;
  rules.volume_fraction                   = 0.5;
  const auto jammed                       = place_random_inclusions(cubes, rules, 1);
  EXPECT_FALSE(jammed.target_reached);
  EXPECT_NEAR(jammed.actual_fraction, 0.384, 0.03);
}
