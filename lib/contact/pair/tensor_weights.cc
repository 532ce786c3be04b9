#include "contact/pair/tensor_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
constexpr unsigned int no_number = std::numeric_limits<unsigned int>::max();

/** Coordinates of the lines at which facets begin or end along an axis (m). */
class Lines
{
public:
  Lines(const std::vector<SurfaceFacet> &facets, const unsigned int axis)
    : axis(axis)
  {
    std::vector<double> all;
    double shortest = std::numeric_limits<double>::infinity();
    for (const SurfaceFacet &facet : facets)
      {
        const auto [from, to] = facet.range(axis);
        all.push_back(from);
        all.push_back(to);
        shortest = std::min(shortest, to - from);
      }
    tolerance = 1e-9 * shortest;
    std::sort(all.begin(), all.end());
    for (const double x : all)
      if (at.empty() || x > at.back() + tolerance)
        at.push_back(x);
  }

  /** Index of the line through a corner; the number of lines if there is none. */
  std::size_t find(const SurfaceFacet::Place &corner) const
  {
    const auto found = std::lower_bound(at.begin(), at.end(), corner[axis] - tolerance);
    return found != at.end() && *found <= corner[axis] + tolerance
             ? static_cast<std::size_t>(found - at.begin())
             : at.size();
  }

  std::vector<double> at; ///< ascending

private:
  const unsigned int axis;
  double tolerance = 0.;
};

/** Edges between lines; if @p repeats, the last node is the first one. */
ContactFacets edges(const std::vector<double> &at, const bool repeats)
{
  const auto n = static_cast<unsigned int>(at.size() - 1);
  ContactFacets result{n + (repeats ? 0 : 1), {}};
  for (unsigned int i = 0; i < n; ++i)
    result.facets.push_back({2,
                             {{i, i + 1 == n && repeats ? 0 : i + 1}},
                             {{{{at[i], 0.}}, {{at[i + 1], 0.}}}}});
  return result;
}
} // namespace

std::optional<FacetGrid> grid_of(const ContactFacets &contact)
{
  for (const SurfaceFacet &facet : contact.facets)
    if (facet.n != 4)
      return std::nullopt;
  const Lines x(contact.facets, 0), y(contact.facets, 1);
  const std::size_t n_x = x.at.size(), n_y = y.at.size();
  if (contact.facets.empty() || contact.facets.size() != (n_x - 1) * (n_y - 1))
    return std::nullopt;
  std::vector<unsigned int> table(n_x * n_y, no_number);
  for (const SurfaceFacet &facet : contact.facets)
    {
      const std::size_t i = x.find(facet.place[0]), k = x.find(facet.place[2]),
                        j = y.find(facet.place[0]), l = y.find(facet.place[2]);
      if (std::max(i, k) != std::min(i, k) + 1 || std::max(j, l) != std::min(j, l) + 1)
        return std::nullopt;
      for (unsigned int v = 0; v < 4; ++v)
        {
          const std::size_t a = x.find(facet.place[v]), b = y.find(facet.place[v]);
          if ((a != i && a != k) || (b != j && b != l))
            return std::nullopt;
          table[a * n_y + b] = facet.node[v];
        }
    }
  if (std::count(table.begin(), table.end(), no_number) > 0)
    return std::nullopt;
  const bool in_x = n_x > 2 && table[0] == table[(n_x - 1) * n_y],
             in_y = n_y > 2 && table[0] == table[n_y - 1];
  FacetGrid grid  = {{{edges(x.at, in_x), edges(y.at, in_y)}}, {}};
  for (std::size_t i = 0; i < grid.along[0].n_nodes; ++i)
    for (std::size_t j = 0; j < grid.along[1].n_nodes; ++j)
      grid.node.push_back(table[i * n_y + j]);
  if (grid.node.size() != contact.n_nodes)
    return std::nullopt;
  return grid;
}

TensorWeights::TensorWeights(const FacetGrid &above,
                             const FacetGrid &below,
                             const std::array<double, 2> &period)
  : along{{MortarWeights(above.along[0], below.along[0], {{period[0], 0.}}),
           MortarWeights(above.along[1], below.along[1], {{period[1], 0.}})}}
  , below(below.node)
  , above_in_y(above.along[1].n_nodes)
  , below_in_y(below.along[1].n_nodes)
  , place(above.node.size())
{
  for (unsigned int k = 0; k < above.node.size(); ++k)
    place[above.node[k]] = k;
}

SurfaceWeights TensorWeights::at(const std::array<double, 2> &way) const
{
  const SparseRows in_x = along[0].rows_at({{way[0], 0.}}),
                   in_y = along[1].rows_at({{way[1], 0.}});
  SparseRows rows;
  rows.entries.reserve(16 * place.size());
  for (const unsigned int at : place)
    {
      const std::size_t i = at / above_in_y, j = at % above_in_y;
      for (std::size_t a = in_x.start[i]; a < in_x.start[i + 1]; ++a)
        for (std::size_t b = in_y.start[j]; b < in_y.start[j + 1]; ++b)
          rows.entries.push_back(
            {below[in_x.entries[a].column * below_in_y + in_y.entries[b].column],
             in_x.entries[a].weight * in_y.entries[b].weight});
      rows.end_row();
    }
  return {std::move(rows), below.size()};
}

std::shared_ptr<const MovingWeights>
make_moving_weights(const ContactFacets &above,
                    const ContactFacets &below,
                    const std::array<double, 2> &period)
{
  const auto upper = grid_of(above), lower = grid_of(below);
  if (upper && lower)
    return std::make_shared<const TensorWeights>(*upper, *lower, period);
  return std::make_shared<const MortarWeights>(above, below, period);
}
} // namespace mesoslip
