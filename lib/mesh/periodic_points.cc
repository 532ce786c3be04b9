#include "mesh/periodic_points.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/boost_adaptors/point.h>

#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

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
} // namespace mesoslip
