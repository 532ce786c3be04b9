#include "sliding/counter/partners.h"

#include "base/errors.h"
#include "base/text.h"
#include "material/plausibility.h"
#include "sliding/flat/flat_way.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace mesoslip
{
namespace
{
/** The contact nodes of a body, searchable by position. */
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

/** Checks that the contact of @p counter is a plane. */
template <int dim>
void require_even(const GivenBody<dim> &counter, const double tolerance)
{
  const std::vector<double> &rise = counter.facts().contact_height;
  if (!rise.empty() && *std::max_element(rise.begin(), rise.end()) > tolerance)
    throw UserError(
      "Counter body/Mesh/Contact boundary: it is not even, its nodes rise by " +
      quantity_text(*std::max_element(rise.begin(), rise.end()), "m") +
      "; name a plane group, or let the body above it be the one that is not even");
}

/** For each contact node of @p counter the coincident node of @p body; each node is used
 * once. */
template <int dim>
std::vector<unsigned int> found_partners(const GivenBody<dim> &body,
                                         const GivenBody<dim> &counter,
                                         const double tolerance)
{
  const auto &of_body = body.facts().contact_place,
             &place   = counter.facts().contact_place;
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
  return partners;
}

template <int dim>
bool are_all(const std::vector<unsigned int> &partners,
             const GivenBody<dim> &body,
             const GivenBody<dim> &counter)
{
  return partners.size() == counter.facts().contact_place[0].size() &&
         partners.size() == body.facts().contact_place[0].size();
}

/** Range of a contact along an axis (m). */
template <int dim>
Interval extent_of(const GivenBody<dim> &body, const unsigned int axis)
{
  Interval extent = {1e300, -1e300};
  for (const SurfaceFacet &facet : body.facts().contact_facets)
    {
      const auto [from, to] = facet.range(axis);
      extent.from           = std::min(extent.from, from);
      extent.to             = std::max(extent.to, to);
    }
  return extent;
}

/** Period of a periodic body along an axis (m), spanned by its contact; 0: not
 * periodic. */
template <int dim>
double period_of(const GivenBody<dim> &body, const unsigned int axis)
{
  const ContactParameters &p = body.parameters;
  const bool repeats =
    p.mesh.is_plane_grid() ? axis == 0 && p.periodic : !p.mesh.periodic[axis].empty();
  const Interval extent = extent_of(body, axis);
  return repeats ? extent.to - extent.from : 0.;
}

/** Periods of the counter body; checks that it is below the whole body on its way. */
template <int dim>
std::array<double, 2> periods_below(const GivenBody<dim> &body,
                                    const GivenBody<dim> &counter)
{
  constexpr double rounding   = 1e-9;
  std::array<double, 2> found = {};
  const Interval way =
    counter.parameters.slides_on ? way_of_flat(body.parameters) : Interval();
  for (unsigned int axis = 0; axis + 1 < dim; ++axis)
    {
      const Interval own = extent_of(body, axis), below = extent_of(counter, axis);
      const double along  = body.parameters.contact.flat_direction[axis],
                   period = period_of(body, axis), length = own.to - own.from;
      const auto [back, forth]  = std::minmax({along * way.from, along * way.to});
      const std::string of_axis = std::string(" m along ") + "xy"[axis];
      found[axis]               = period_of(counter, axis);
      if (period > 0. && found[axis] > 0. &&
          std::fabs(period - found[axis]) > rounding * period)
        throw UserError("Counter body: it repeats itself after " + to_text(found[axis]) +
                        of_axis + ", the body after " + to_text(period) +
                        " m; give both the same length, or let the body not be periodic");
      if (!(found[axis] > 0.) && (own.from - forth < below.from - rounding * length ||
                                  own.to - back > below.to + rounding * length))
        throw UserError(
          "Counter body: it goes from " + brief_text(6, below.from, " to ", below.to) +
          of_axis + ", but the body comes above " +
          brief_text(6, own.from - forth, " to ", own.to - back) + " m" +
          (counter.parameters.slides_on ? " of it on its way" : "") +
          "; make it longer, or " +
          (counter.parameters.slides_on ? "periodic, or reduce Time/End time"
                                        : "let the smaller body be the one above"));
    }
  return found;
}
} // namespace

std::string text_of(const SurfaceMeeting &meeting)
{
  const std::string start = "Contact of both bodies: ";
  if (meeting.sliding)
    return start + "the counter body slides on, weights of its nodes follow its way";
  return start + (meeting.weights.are_partners()
                    ? "nodes match, each has one partner"
                    : "nodes do not match, those of the counter body have weights");
}

template <int dim>
SurfaceMeeting meeting_of(const GivenBody<dim> &body, const GivenBody<dim> &counter)
{
  const double tolerance = 1e-6 * body.contact_nodes().spacing;
  require_even(counter, tolerance);
  const bool slides                        = counter.parameters.slides_on;
  const std::vector<unsigned int> partners = found_partners(body, counter, tolerance);
  SurfaceMeeting meeting;
  if (!slides && are_all(partners, body, counter))
    {
      const std::size_t n = body.facts().size.n_contact_nodes;
      std::vector<unsigned int> below(partners.size());
      for (unsigned int j = 0; j < partners.size(); ++j)
        below[partners[j]] = j;
      SparseRows rows;
      for (std::size_t k = 0; k < n; ++k) // without the periodic copy of a grid
        {
          rows.entries.push_back({below[k], 1.});
          rows.end_row();
        }
      meeting.weights = {rows, n};
      return meeting;
    }
  const auto moving = make_moving_weights(
    ContactFacets{static_cast<unsigned int>(body.facts().size.n_contact_nodes),
                  body.facts().contact_facets},
    ContactFacets{static_cast<unsigned int>(counter.facts().size.n_contact_nodes),
                  counter.facts().contact_facets},
    periods_below(body, counter));
  try
    {
      meeting.weights = moving->at({});
    }
  catch (const NumericalFailure &failure)
    {
      throw UserError(std::string("Counter body: ") + failure.what() +
                      "; it has to be below all of the body");
    }
  if (slides)
    meeting.sliding = moving;
  return meeting;
}

template SurfaceMeeting meeting_of(const GivenBody<2> &, const GivenBody<2> &);
template SurfaceMeeting meeting_of(const GivenBody<3> &, const GivenBody<3> &);
} // namespace mesoslip
