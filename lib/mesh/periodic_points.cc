#include "mesh/periodic_points.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/boost_adaptors/point.h>

#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace mesoslip
{
namespace
{
/** Throws unless the point @p pairs map faces of @p upper to faces of @p lower. */
template <int dim>
void require_equal_faces(const Mesh<dim> &mesh,
                         const std::vector<BoundaryFace<dim>> &lower,
                         const std::vector<BoundaryFace<dim>> &upper,
                         const std::vector<std::array<unsigned int, 2>> &pairs,
                         const std::string &sides)
{
  const auto corners = [](const BoundaryFace<dim> &face, const auto &renamed) {
    std::vector<unsigned int> points;
    for (unsigned int v = 0; v < face.n_points; ++v)
      points.push_back(renamed(face.points[v]));
    std::sort(points.begin(), points.end());
    return points;
  };
  std::map<unsigned int, unsigned int> opposite;
  for (const auto &[p, q] : pairs)
    opposite[p] = q;
  std::set<std::vector<unsigned int>> known;
  for (const BoundaryFace<dim> &face : lower)
    known.insert(corners(face, [](const unsigned int p) { return p; }));
  for (const BoundaryFace<dim> &face : upper)
    if (known.erase(corners(face, [&](const unsigned int p) { return opposite[p]; })) ==
        0)
      throw UserError(sides + " have opposite points, but other " +
                      (dim == 2 ? "edges" : "faces") + " at " + place_of(mesh, face) +
                      "; mesh both alike (in Gmsh: setPeriodic)");
}
} // namespace

template <int dim>
OppositePoints<dim> opposite_points(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &lower_faces,
                                    const std::vector<BoundaryFace<dim>> &upper_faces,
                                    const unsigned int axis,
                                    const double cell_size)
{
  const auto lower = boundary_points(mesh, lower_faces).points,
             upper = boundary_points(mesh, upper_faces).points;
  const std::string sides =
    std::string("Mesh/File: the sides at both ends of ") + "xyz"[axis];
  if (lower.size() != upper.size())
    throw UserError(sides + " have " + std::to_string(lower.size()) + " and " +
                    std::to_string(upper.size()) +
                    " points; a periodic mesh has equal ones (in Gmsh: setPeriodic)");
  const auto in_plane = [&](const unsigned int p) {
    dealii::Point<dim> point = mesh.points[p];
    point[axis]              = 0.;
    return point;
  };
  namespace index = boost::geometry::index;
  using Place     = std::pair<dealii::Point<dim>, unsigned int>;
  std::vector<Place> places;
  for (const unsigned int p : lower)
    places.emplace_back(in_plane(p), p);
  const index::rtree<Place, index::linear<16>> tree(places);
  OppositePoints<dim> result;
  for (const unsigned int p : upper)
    {
      const dealii::Point<dim> place = in_plane(p);
      const Place nearest            = *tree.qbegin(index::nearest(place, 1));
      result.largest_mismatch =
        std::max(result.largest_mismatch, place.distance(nearest.first));
      result.pairs.push_back({{p, nearest.second}});
    }
  const double most = mesh.tolerance * cell_size;
  if (!(result.largest_mismatch <= most))
    throw UserError(sides + " have points that are not opposite, up to " +
                    to_text(result.largest_mismatch) + " m apart, more than " +
                    to_text(most) + " m (Mesh/Tolerance = " + to_text(mesh.tolerance) +
                    "); mesh both alike (in Gmsh: setPeriodic)");
  require_equal_faces(mesh, lower_faces, upper_faces, result.pairs, sides);
  return result;
}

template <int dim>
OppositePoints<dim> join_sides(Mesh<dim> &mesh,
                               const std::vector<BoundaryFace<dim>> &lower,
                               const std::vector<BoundaryFace<dim>> &upper,
                               const unsigned int axis,
                               const double cell_size)
{
  const auto joined = opposite_points(mesh, lower, upper, axis, cell_size);
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.;
  for (const auto &[p, opposite] : joined.pairs)
    {
      const double length = mesh.points[p][axis] - mesh.points[opposite][axis];
      shortest            = std::min(shortest, length);
      longest             = std::max(longest, length);
    }
  if (!(shortest > 0. && longest - shortest <= mesh.tolerance * cell_size))
    throw UserError(
      std::string("Mesh/Periodic in ") + "xyz"[axis] +
      ": points of the second group lie between " + to_text(shortest) + " and " +
      to_text(longest) +
      " m behind those opposite; the one has to be the other, shifted along "
      "this axis");
  std::vector<unsigned int> &masters = mesh.masters;
  if (masters.empty())
    {
      masters.resize(mesh.points.size());
      std::iota(masters.begin(), masters.end(), 0U);
    }
  const auto root = [&masters](unsigned int p) {
    while (masters[p] != p)
      p = masters[p];
    return p;
  };
  for (const auto &[p, opposite] : joined.pairs)
    masters[root(p)] = root(opposite);
  for (unsigned int &p : masters)
    p = root(p);
  return joined;
}

template OppositePoints<2> opposite_points(const Mesh<2> &,
                                           const std::vector<BoundaryFace<2>> &,
                                           const std::vector<BoundaryFace<2>> &,
                                           const unsigned int,
                                           const double);
template OppositePoints<3> opposite_points(const Mesh<3> &,
                                           const std::vector<BoundaryFace<3>> &,
                                           const std::vector<BoundaryFace<3>> &,
                                           const unsigned int,
                                           const double);
template OppositePoints<2> join_sides(Mesh<2> &,
                                      const std::vector<BoundaryFace<2>> &,
                                      const std::vector<BoundaryFace<2>> &,
                                      const unsigned int,
                                      const double);
template OppositePoints<3> join_sides(Mesh<3> &,
                                      const std::vector<BoundaryFace<3>> &,
                                      const std::vector<BoundaryFace<3>> &,
                                      const unsigned int,
                                      const double);
} // namespace mesoslip
