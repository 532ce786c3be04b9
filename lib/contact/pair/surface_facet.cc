#include "contact/pair/surface_facet.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
using FacetPlace = SurfaceFacet::Place;

/** A convex polygon; a cut along an edge of another facet removes at most one corner. */
struct Polygon
{
  std::array<FacetPlace, 8> corner;
  unsigned int n = 0;

  void add(const FacetPlace &place)
  {
    corner[n++] = place;
  }
};

/** Twice the signed area of a triangle, positive if counterclockwise. */
double turn(const FacetPlace &a, const FacetPlace &b, const FacetPlace &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

double signed_size(const SurfaceFacet &facet)
{
  const auto &p = facet.place;
  if (facet.n == 2)
    return p[1][0] - p[0][0];
  return 0.5 * (turn(p[0], p[1], p[2]) + (facet.n == 4 ? turn(p[0], p[2], p[3]) : 0.));
}

/**
 * The part of @p polygon to the left of the line from @p a to @p b (Sutherland and
 * Hodgman 1974).
 */
Polygon cut(const Polygon &polygon, const FacetPlace &a, const FacetPlace &b)
{
  Polygon result;
  for (unsigned int k = 0; k < polygon.n; ++k)
    {
      const FacetPlace &here = polygon.corner[k],
                       &next = polygon.corner[(k + 1) % polygon.n];
      const double of_here = turn(a, b, here), of_next = turn(a, b, next);
      if (of_here >= 0.)
        result.add(here);
      if (of_here * of_next < 0.)
        {
          const double t = of_here / (of_here - of_next);
          result.add(
            {{here[0] + t * (next[0] - here[0]), here[1] + t * (next[1] - here[1])}});
        }
    }
  return result;
}

void add_interval(const SurfaceFacet &one,
                  const SurfaceFacet &other,
                  std::vector<WeightedPlace> &points)
{
  const auto [a, b] = std::minmax({one.place[0][0], one.place[1][0]});
  const auto [c, d] = std::minmax({other.place[0][0], other.place[1][0]});
  const double from = std::max(a, c), to = std::min(b, d), half = 0.5 * (to - from),
               middle = 0.5 * (from + to), away = half / std::sqrt(3.);
  if (!(half > 0.))
    return;
  points.push_back({{{middle - away, 0.}}, half});
  points.push_back({{{middle + away, 0.}}, half});
}

/** Adds a quadrature rule with seven points of degree five (Radon 1948). */
void add_triangle(const FacetPlace &a,
                  const FacetPlace &b,
                  const FacetPlace &c,
                  std::vector<WeightedPlace> &points)
{
  static const double root = std::sqrt(15.);
  const double near[]      = {(6. - root) / 21., (6. + root) / 21.},
               share[]     = {(155. - root) / 1200., (155. + root) / 1200.},
               area        = 0.5 * std::fabs(turn(a, b, c));
  if (!(area > 0.))
    return;
  const FacetPlace middle = {{(a[0] + b[0] + c[0]) / 3., (a[1] + b[1] + c[1]) / 3.}};
  points.push_back({middle, 0.225 * area});
  for (unsigned int ring = 0; ring < 2; ++ring)
    for (const FacetPlace *corner : {&a, &b, &c})
      {
        const double own = 1. - 3. * near[ring];
        points.push_back({{{3. * near[ring] * middle[0] + own * (*corner)[0],
                            3. * near[ring] * middle[1] + own * (*corner)[1]}},
                          share[ring] * area});
      }
}

/**
 * Bilinear coordinates (0 to 1) of a position by Newton's method; one step for a
 * parallelogram.
 */
FacetPlace coordinates_in(const std::array<FacetPlace, 4> &corner, const FacetPlace &at)
{
  FacetPlace xi = {{0.5, 0.5}};
  for (unsigned int n = 0; n < 20; ++n)
    {
      const double x = xi[0], y = xi[1];
      double off[2], along[2], across[2];
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double lower = corner[1][d] - corner[0][d],
                       upper = corner[2][d] - corner[3][d],
                       left  = corner[3][d] - corner[0][d],
                       right = corner[2][d] - corner[1][d];
          along[d]           = (1. - y) * lower + y * upper;
          across[d]          = (1. - x) * left + x * right;
          off[d] = at[d] - corner[0][d] - x * lower - y * (left + x * (right - left));
        }
      const double determinant = along[0] * across[1] - along[1] * across[0],
                   dx          = (off[0] * across[1] - off[1] * across[0]) / determinant,
                   dy          = (along[0] * off[1] - along[1] * off[0]) / determinant;
      xi                       = {{x + dx, y + dy}};
      if (std::fabs(dx) + std::fabs(dy) < 1e-15)
        break;
    }
  return xi;
}
} // namespace

std::array<double, 4> SurfaceFacet::shapes(const Place &at) const
{
  if (n == 2)
    {
      const double x = (at[0] - place[0][0]) / (place[1][0] - place[0][0]);
      return {{1. - x, x, 0., 0.}};
    }
  if (n == 3)
    {
      const double all = turn(place[0], place[1], place[2]),
                   a   = turn(at, place[1], place[2]) / all,
                   b   = turn(place[0], at, place[2]) / all;
      return {{a, b, 1. - a - b, 0.}};
    }
  const auto [x, y] = coordinates_in(place, at);
  return {{(1. - x) * (1. - y), x * (1. - y), x * y, (1. - x) * y}};
}

std::array<double, 2> SurfaceFacet::range(const unsigned int axis) const
{
  std::array<double, 2> found = {{place[0][axis], place[0][axis]}};
  for (unsigned int k = 1; k < n; ++k)
    {
      found[0] = std::min(found[0], place[k][axis]);
      found[1] = std::max(found[1], place[k][axis]);
    }
  return found;
}

double SurfaceFacet::size() const
{
  return std::fabs(signed_size(*this));
}

void quadrature_of_overlap(const SurfaceFacet &one,
                           const SurfaceFacet &other,
                           std::vector<WeightedPlace> &points)
{
  points.clear();
  if (one.n == 2)
    {
      add_interval(one, other, points);
      return;
    }
  Polygon common;
  for (unsigned int k = 0; k < one.n; ++k)
    common.add(one.place[k]);
  const bool left = signed_size(other) > 0.;
  for (unsigned int k = 0; k < other.n && common.n > 0; ++k)
    {
      const FacetPlace &a = other.place[k], &b = other.place[(k + 1) % other.n];
      common = left ? cut(common, a, b) : cut(common, b, a);
    }
  for (unsigned int k = 1; k + 1 < common.n; ++k)
    add_triangle(common.corner[0], common.corner[k], common.corner[k + 1], points);
}
} // namespace mesoslip
