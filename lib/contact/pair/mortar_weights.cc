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
SurfaceFacet moved(SurfaceFacet facet, const SurfaceFacet::Place &by)
{
  for (unsigned int k = 0; k < facet.n; ++k)
    for (unsigned int d = 0; d < 2; ++d)
      facet.place[k][d] += by[d];
  return facet;
}

/**
 * First and last image of a surface with this @p period, starting at @p lowest, that may
 * lie below the range @p part.
 */
std::array<long long, 2>
images(const std::array<double, 2> &part, const double lowest, const double period)
{
  if (!(period > 0.))
    return {{0, 0}};
  return {{std::llround(std::floor((part[0] - lowest) / period)),
           std::llround(std::floor((part[1] - lowest) / period))}};
}

/**
 * The matrix of psi = dual phi: diag(s) M^-1 with the integrals s_i of phi_i and M_ik of
 * phi_i phi_k.
 */
std::array<std::array<double, 4>, 4> dual_functions(const SurfaceFacet &facet)
{
  std::vector<WeightedPlace> points;
  quadrature_of_overlap(facet, facet, points);
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  for (const auto &[place, weight] : points)
    {
      const std::array<double, 4> values = facet.shapes(place);
      const Eigen::Map<const Eigen::Vector4d> phi(values.data());
      M += weight * phi * phi.transpose();
    }
  const Eigen::MatrixXd of_corners = M.topLeftCorner(facet.n, facet.n);
  const Eigen::MatrixXd found =
    of_corners.rowwise().sum().asDiagonal() * of_corners.inverse();
  std::array<std::array<double, 4>, 4> dual = {};
  for (unsigned int i = 0; i < facet.n; ++i)
    for (unsigned int k = 0; k < facet.n; ++k)
      dual[i][k] = found(i, k);
  return dual;
}
} // namespace

/** Results, and work arrays for each pair of facets. */
struct MortarWeights::Work
{
  std::vector<Product> products;
  std::vector<WeightedPlace> points;
  double covered = 0.; ///< covered part of the current facet (m^2, in 2D m)
};

MortarWeights::MortarWeights(const ContactFacets &upper,
                             const ContactFacets &lower,
                             const std::array<double, 2> &period)
  : n_above(upper.n_nodes)
  , n_below(lower.n_nodes)
  , below(lower.facets)
  , period(period)
{
  for (const SurfaceFacet &facet : upper.facets)
    above.push_back({facet, dual_functions(facet), facet.size()});
  std::sort(below.begin(), below.end(), [](const SurfaceFacet &a, const SurfaceFacet &b) {
    return a.range(0)[0] < b.range(0)[0];
  });
  lowest.fill(std::numeric_limits<double>::infinity());
  for (const SurfaceFacet &facet : below)
    {
      for (unsigned int d = 0; d < 2; ++d)
        lowest[d] = std::min(lowest[d], facet.range(d)[0]);
      const auto [from, to] = facet.range(0);
      first.push_back(from);
      longest = std::max(longest, to - from);
    }
}

SurfaceWeights MortarWeights::at(const std::array<double, 2> &way) const
{
  return {rows_at(way), n_below};
}

SparseRows MortarWeights::rows_at(const std::array<double, 2> &way) const
{
  Work work;
  work.products.reserve(16 * above.size());
  for (const Upper &upper : above)
    add_facet(upper, way, work);
  return rows_of(work.products);
}

/** Works in the frame of the surface below, whose images the facet may overlap. */
void MortarWeights::add_facet(const Upper &upper,
                              const std::array<double, 2> &way,
                              Work &work) const
{
  const SurfaceFacet here = moved(upper.facet, {{-way[0], -way[1]}});
  const auto in_x         = images(here.range(0), lowest[0], period[0]),
             in_y         = images(here.range(1), lowest[1], period[1]);
  work.covered            = 0.;
  for (long long i = in_x[0]; i <= in_x[1]; ++i)
    for (long long j = in_y[0]; j <= in_y[1]; ++j)
      add_overlaps(upper,
                   moved(here, {{-static_cast<double>(i) * period[0],
                                 -static_cast<double>(j) * period[1]}}),
                   work);
  constexpr double rounding = 1e-9;
  if (!(work.covered >= (1. - rounding) * upper.size))
    throw NumericalFailure("the counter body ends below the body, at x = " +
                           to_text(upper.facet.place[0][0]) + " m");
}

/** Adds the products of the moved @p facet with the facets below it. */
void MortarWeights::add_overlaps(const Upper &upper,
                                 const SurfaceFacet &facet,
                                 Work &work) const
{
  const auto [from, to]    = facet.range(0);
  const auto [front, back] = facet.range(1);
  auto f                   = static_cast<std::size_t>(
    std::lower_bound(first.begin(), first.end(), from - longest) - first.begin());
  for (; f < below.size() && first[f] < to; ++f)
    {
      const SurfaceFacet &other = below[f];
      if (facet.n > 2)
        if (const auto [start, end] = other.range(1); start >= back || end <= front)
          continue;
      quadrature_of_overlap(facet, other, work.points);
      if (work.points.empty())
        continue;
      double sums[4][4] = {}; // sums of phi_k phi_j
      for (const auto &[place, weight] : work.points)
        {
          const std::array<double, 4> own = facet.shapes(place),
                                      met = other.shapes(place);
          work.covered += weight;
          for (unsigned int k = 0; k < facet.n; ++k)
            for (unsigned int j = 0; j < other.n; ++j)
              sums[k][j] += weight * own[k] * met[j];
        }
      for (unsigned int i = 0; i < facet.n; ++i)
        for (unsigned int j = 0; j < other.n; ++j)
          {
            double of_dual = 0.;
            for (unsigned int k = 0; k < facet.n; ++k)
              of_dual += upper.dual[i][k] * sums[k][j];
            work.products.push_back({facet.node[i], {other.node[j], of_dual}});
          }
    }
}

/**
 * Sums each node's products with the same node below, and divides by the sum of its row.
 */
SparseRows MortarWeights::rows_of(const std::vector<Product> &products) const
{
  std::vector<std::size_t> begin(n_above + 2);
  for (const Product &product : products)
    ++begin[product.node + 2];
  for (unsigned int k = 0; k < n_above; ++k)
    begin[k + 2] += begin[k + 1];
  std::vector<SparseRows::Entry> sorted(products.size());
  for (const Product &product : products)
    sorted[begin[product.node + 1]++] = product.entry;
  SparseRows rows;
  rows.entries.reserve(products.size());
  for (unsigned int k = 0; k < n_above; ++k)
    {
      double sum = 0.;
      for (std::size_t e = begin[k]; e < begin[k + 1]; ++e)
        {
          const SparseRows::Entry &entry = sorted[e];
          sum += entry.weight;
          auto same =
            rows.entries.begin() + static_cast<std::ptrdiff_t>(rows.start.back());
          while (same != rows.entries.end() && same->column != entry.column)
            ++same;
          if (same == rows.entries.end())
            rows.entries.push_back(entry);
          else
            same->weight += entry.weight;
        }
      for (std::size_t e = rows.start.back(); e < rows.entries.size(); ++e)
        rows.entries[e].weight /= sum;
      rows.end_row();
    }
  return rows;
}
} // namespace mesoslip
