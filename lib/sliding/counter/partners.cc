#include "sliding/counter/partners.h"

#include "base/errors.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace mesoslip
{
namespace
{
/** The contact nodes of a body by their places. */
class PlacesByX
{
public:
  PlacesByX(const std::array<std::vector<double>, 2> &place, const double tolerance)
    : place(place)
    , tolerance(tolerance)
    , order(place[0].size())
  {
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](const unsigned int a, const unsigned int b) {
                return place[0][a] < place[0][b];
              });
  }

  /** The node at a place, or the number of nodes. */
  unsigned int find(const double x, const double y) const
  {
    auto at = std::lower_bound(order.begin(), order.end(), x - tolerance,
                               [&](const unsigned int node, const double value) {
                                 return place[0][node] < value;
                               });
    for (; at != order.end() && place[0][*at] <= x + tolerance; ++at)
      if (place[1].empty() || std::fabs(place[1][*at] - y) <= tolerance)
        return *at;
    return static_cast<unsigned int>(order.size());
  }

private:
  const std::array<std::vector<double>, 2> &place;
  const double tolerance;
  std::vector<unsigned int> order; ///< nodes with ascending x
};

/** "9 nodes on 6 mm", "20 nodes on 6 mm x 2 mm". */
std::string extent_text(const std::array<std::vector<double>, 2> &place)
{
  std::string text = std::to_string(place[0].size()) + " nodes";
  for (unsigned int d = 0; d < 2 && !place[d].empty(); ++d)
    {
      const auto [lower, upper] = std::minmax_element(place[d].begin(), place[d].end());
      text += (d == 0 ? " on " : " x ") + quantity_text(*upper - *lower, "m");
    }
  return text;
}
} // namespace

template <int dim>
std::vector<unsigned int> partners_in(const GivenBody<dim> &body,
                                      const GivenBody<dim> &counter)
{
  const auto &of_body             = body.facts().contact_place,
             &place               = counter.facts().contact_place;
  const double tolerance          = 1e-6 * body.contact_nodes().spacing;
  const std::vector<double> &rise = counter.facts().contact_height;
  if (!rise.empty() && *std::max_element(rise.begin(), rise.end()) > tolerance)
    throw UserError(
      "Counter body/Mesh/Contact boundary: it is not even, its nodes rise by " +
      quantity_text(*std::max_element(rise.begin(), rise.end()), "m") +
      "; name a plane group, or let the body above it be the one that is not even");
  const PlacesByX nodes(of_body, tolerance);
  std::vector<unsigned int> partners;
  std::vector<bool> taken(of_body[0].size());
  for (std::size_t i = 0; i < place[0].size(); ++i)
    if (const unsigned int k = nodes.find(place[0][i], dim == 3 ? place[1][i] : 0.);
        k < taken.size() && !taken[k])
      {
        partners.push_back(k);
        taken[k] = true;
      }
  if (partners.size() < place[0].size() || partners.size() < taken.size())
    throw UserError("Counter body: it has " + extent_text(place) +
                    " at the contact, which are to be where those of the body are, " +
                    extent_text(of_body) + ", and " +
                    std::to_string(taken.size() - partners.size()) +
                    " of these have no partner; " +
                    (counter.parameters.mesh.is_given() || body.parameters.mesh.is_given()
                       ? "mesh both bodies with the same nodes there"
                       : std::string("give it the same width and cells along x") +
                           (dim == 3 ? " and y" : "")));
  return partners;
}

template std::vector<unsigned int> partners_in(const GivenBody<2> &,
                                               const GivenBody<2> &);
template std::vector<unsigned int> partners_in(const GivenBody<3> &,
                                               const GivenBody<3> &);
} // namespace mesoslip
