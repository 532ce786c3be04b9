#include "contact/pair/mortar_weights.h"

#include "base/errors.h"
#include "base/text.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
using Values = Eigen::Matrix<double, 4, 1>;

std::array<double, 2> range(const SurfaceFacet &facet, const unsigned int axis)
{
  std::array<double, 2> found = {{facet.place[0][axis], facet.place[0][axis]}};
  for (unsigned int k = 1; k < facet.n; ++k)
    {
      found[0] = std::min(found[0], facet.place[k][axis]);
      found[1] = std::max(found[1], facet.place[k][axis]);
    }
  return found;
}

SurfaceFacet moved(SurfaceFacet facet, const SurfaceFacet::Place &by)
{
  for (unsigned int k = 0; k < facet.n; ++k)
    for (unsigned int d = 0; d < 2; ++d)
      facet.place[k][d] += by[d];
  return facet;
}

/** Images of a surface with this @p period, which begins at @p lowest, that may lie below the @p part. */
std::array<long long, 2>
images(const std::array<double, 2> &part, const double lowest, const double period)
{
  if (!(period > 0.))
    return {{0, 0}};
  return {{std::llround(std::floor((part[0] - lowest) / period)),
           std::llround(std::floor((part[1] - lowest) / period))}};
}
} // namespace

/** Integrals over the facet at work, and rows of all nodes. */
struct MortarWeights::Scratch
{
  Eigen::Matrix4d squares; ///< of phi_i phi_k of the facet
  double covered = 0.;     ///< of the facet (m^2, in 2D m)
  std::vector<std::pair<unsigned int, Values>>
    products; ///< of phi_i and phi_j, for node j below
  std::vector<WeightedPlace> points;
  std::vector<std::vector<Entry>> rows; ///< integrals of psi_i phi_j
};

MortarWeights::MortarWeights(const ContactFacets &above,
                             const ContactFacets &given,
                             const std::array<double, 2> &period)
  : above(above)
  , below(given.facets)
  , period(period)
{
  std::sort(below.begin(), below.end(), [](const SurfaceFacet &a, const SurfaceFacet &b) {
    return range(a, 0)[0] < range(b, 0)[0];
  });
  constexpr double infinity = std::numeric_limits<double>::infinity();
  extent                    = {{{{infinity, infinity}}, {{-infinity, -infinity}}}};
  for (const SurfaceFacet &facet : below)
    {
      for (unsigned int d = 0; d < 2; ++d)
        {
          const auto [from, to] = range(facet, d);
          extent[0][d]          = std::min(extent[0][d], from);
          extent[1][d]          = std::max(extent[1][d], to);
        }
      const auto [from, to] = range(facet, 0);
      first.push_back(from);
      longest = std::max(longest, to - from);
    }
}

SurfaceWeights MortarWeights::at(const std::array<double, 2> &way) const
{
  Scratch scratch;
  scratch.rows.resize(above.n_nodes);
  for (const SurfaceFacet &facet : above.facets)
    add_facet(facet, way, scratch);
  SurfaceWeights weights;
  for (std::vector<Entry> &row : scratch.rows)
    {
      std::sort(row.begin(), row.end(),
                [](const Entry &a, const Entry &b) { return a.node < b.node; });
      double sum = 0.;
      for (const Entry &entry : row)
        sum += entry.weight;
      for (const Entry &entry : row)
        if (weights.node.size() > weights.start.back() &&
            weights.node.back() == entry.node)
          weights.weight.back() += entry.weight / sum;
        else
          {
            weights.node.push_back(entry.node);
            weights.weight.push_back(entry.weight / sum);
          }
      weights.start.push_back(weights.node.size());
    }
  return weights;
}

/** In the frame of the surface below, into whose images the facet may reach. */
void MortarWeights::add_facet(const SurfaceFacet &facet,
                              const std::array<double, 2> &way,
                              Scratch &scratch) const
{
  scratch.squares.setZero();
  scratch.covered = 0.;
  scratch.products.clear();
  const SurfaceFacet here = moved(facet, {{-way[0], -way[1]}});
  const auto in_x         = images(range(here, 0), extent[0][0], period[0]),
             in_y         = images(range(here, 1), extent[0][1], period[1]);
  for (long long i = in_x[0]; i <= in_x[1]; ++i)
    for (long long j = in_y[0]; j <= in_y[1]; ++j)
      {
        const SurfaceFacet image = moved(here, {{-static_cast<double>(i) * period[0],
                                                 -static_cast<double>(j) * period[1]}});
        const auto [from, to]    = range(image, 0);
        add_overlaps(image, from, to, scratch);
      }
  constexpr double rounding = 1e-9;
  if (!(scratch.covered >= (1. - rounding) * facet.size()))
    throw NumericalFailure("the counter body ends below the body, at x = " +
                           to_text(facet.place[0][0]) + " m");
  const unsigned int n       = facet.n;
  const auto M               = scratch.squares.topLeftCorner(n, n);
  const Eigen::MatrixXd dual = M.rowwise().sum().asDiagonal() * M.inverse();
  for (const auto &[node, product] : scratch.products)
    {
      const Eigen::VectorXd of_dual = dual * product.head(n);
      for (unsigned int k = 0; k < n; ++k)
        scratch.rows[facet.node[k]].push_back({node, of_dual[k]});
    }
}

/** Of a facet from @p from to @p to along x with those below it. */
void MortarWeights::add_overlaps(const SurfaceFacet &facet,
                                 const double from,
                                 const double to,
                                 Scratch &scratch) const
{
  const auto [front, back] = range(facet, 1);
  auto f                   = static_cast<std::size_t>(
    std::lower_bound(first.begin(), first.end(), from - longest) - first.begin());
  for (; f < below.size() && first[f] < to; ++f)
    {
      const SurfaceFacet &other = below[f];
      if (facet.n > 2)
        if (const auto [start, end] = range(other, 1); start >= back || end <= front)
          continue;
      quadrature_of_overlap(facet, other, scratch.points);
      std::array<Values, 4> products;
      products.fill(Values::Zero());
      for (const auto &[place, weight] : scratch.points)
        {
          const std::array<double, 4> own = facet.shapes(place),
                                      met = other.shapes(place);
          const Eigen::Map<const Values> phi(own.data());
          scratch.covered += weight;
          scratch.squares += weight * phi * phi.transpose();
          for (unsigned int k = 0; k < other.n; ++k)
            products[k] += weight * met[k] * phi;
        }
      for (unsigned int k = 0; k < other.n && !scratch.points.empty(); ++k)
        scratch.products.emplace_back(other.node[k], products[k]);
    }
}
} // namespace mesoslip
