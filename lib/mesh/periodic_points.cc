#include "mesh/periodic_points.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/boost_adaptors/point.h>

#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <limits>
#include <numeric>

namespace mesoslip
{
template <int dim>
OppositePoints<dim> opposite_points(const Mesh<dim> &mesh,
                                    const std::vector<unsigned int> &lower,
                                    const std::vector<unsigned int> &upper,
                                    const unsigned int axis,
                                    const double cell_size)
{
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
  if (!(result.largest_mismatch <= 1e-6 * cell_size))
    throw UserError(sides + " have points that are not opposite, up to " +
                    to_text(result.largest_mismatch) +
                    " m apart; mesh both alike (in Gmsh: setPeriodic)");
  return result;
}

template <int dim>
OppositePoints<dim> join_sides(Mesh<dim> &mesh,
                               const std::vector<unsigned int> &lower,
                               const std::vector<unsigned int> &upper,
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
  if (!(shortest > 0. && longest - shortest <= 1e-6 * cell_size))
    throw UserError(
      std::string("Mesh/Periodic in ") + "xyz"[axis] +
      ": points of the second group lie between " + to_text(shortest) + " and " +
      to_text(longest) +
      " m behind those opposite; the one has to be the other, shifted along "
      "this axis");
  std::vector<unsigned int> &originals = mesh.originals;
  if (originals.empty())
    {
      originals.resize(mesh.points.size());
      std::iota(originals.begin(), originals.end(), 0U);
    }
  const auto root = [&originals](unsigned int p) {
    while (originals[p] != p)
      p = originals[p];
    return p;
  };
  for (const auto &[p, opposite] : joined.pairs)
    originals[root(p)] = root(opposite);
  for (unsigned int &p : originals)
    p = root(p);
  return joined;
}

template OppositePoints<2> opposite_points(const Mesh<2> &,
                                           const std::vector<unsigned int> &,
                                           const std::vector<unsigned int> &,
                                           const unsigned int,
                                           const double);
template OppositePoints<3> opposite_points(const Mesh<3> &,
                                           const std::vector<unsigned int> &,
                                           const std::vector<unsigned int> &,
                                           const unsigned int,
                                           const double);
template OppositePoints<2> join_sides(Mesh<2> &,
                                      const std::vector<unsigned int> &,
                                      const std::vector<unsigned int> &,
                                      const unsigned int,
                                      const double);
template OppositePoints<3> join_sides(Mesh<3> &,
                                      const std::vector<unsigned int> &,
                                      const std::vector<unsigned int> &,
                                      const unsigned int,
                                      const double);
} // namespace mesoslip
