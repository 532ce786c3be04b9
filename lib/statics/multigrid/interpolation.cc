#include "statics/multigrid/interpolation.h"

#include <algorithm>
#include <cstring>
#include <memory>

namespace mesoslip::multigrid
{
namespace
{
/** Conductances may be slightly negative; weights are made of positive values. */
float strength(const float conductance)
{
  return std::max(conductance, 0.F);
}

/** Distances of the middle nodes of coarse cells from their ends; 0 without a middle
 * node. */
std::vector<std::array<double, 2>> middle_distances(const Axis &fine,
                                                    const AxisCoarsening &coarsening)
{
  std::vector<std::array<double, 2>> distances(coarsening.n_coarse_cells());
  for (unsigned int k = 0; k < distances.size(); ++k)
    if (coarsening.has_middle(k))
      distances[k] = {
        {fine.width(coarsening.start(k)), fine.width(coarsening.start(k) + 1)}};
  return distances;
}

float share(const float first, const float second)
{
  const float sum = first + second;
  return sum > 0.F ? first / sum : 0.5F;
}

using Vector = float __attribute__((vector_size(64), may_alias));

constexpr unsigned int pairs[n_pairs][2] = {{0, 1}, {0, 2}, {0, 3},
                                            {1, 2}, {1, 3}, {2, 3}};

Vector load(const float *lanes_of_patch)
{
  return *reinterpret_cast<const Vector *>(lanes_of_patch);
}

/** Adds the contribution of row @p b of the fine cells of sixteen coarse cells. */
void add_cells(const AxisCoarsening &x,
               const NodalField<float> &cells,
               const Patch<float> &patch,
               const unsigned int I0,
               const unsigned int b,
               NodalField<float> &result,
               const int J)
{
  const unsigned int n = std::min(lanes<float>, x.n_coarse_cells() - I0);
  Vector sum[n_pairs]  = {};
  for (unsigned int a = 0; a < 2; ++a)
    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        Vector g = {}, d[4];
        for (unsigned int l = 0; l < n; ++l)
          if (a == 0 || x.has_middle(I0 + l))
            g[l] = cells.row(p, 0)[x.start(I0 + l) + a];
        const unsigned int *f = pairs[p];
        for (unsigned int c = 0; c < 4; ++c)
          d[c] = load(patch.weight[b + f[0] / 2][a + f[0] % 2][c]) -
                 load(patch.weight[b + f[1] / 2][a + f[1] % 2][c]);
        for (unsigned int q = 0; q < n_pairs; ++q)
          sum[q] -= g * d[pairs[q][0]] * d[pairs[q][1]];
      }
  for (unsigned int q = 0; q < n_pairs; ++q)
    for (unsigned int l = 0; l < n; ++l)
      result.row(q, J)[I0 + l] += sum[q][l];
}
} // namespace

Interpolation::Interpolation(const Axis &fine_x,
                             const Axis &fine_y,
                             const bool halve_x,
                             const bool halve_y,
                             const Conductor &conductor)
  : x(fine_x, halve_x)
  , y(fine_y, halve_y)
  , coarse_x(x.coarse(fine_x))
  , coarse_y(y.coarse(fine_y))
  , x_distance(middle_distances(fine_x, x))
  , y_distance(middle_distances(fine_y, y))
{
  const unsigned int m = x.n_coarse_cells(), n = y.n_coarse_cells();
  left    = NodalField<float>(m, n + 1, 1);
  lower   = NodalField<float>(m + 1, n, 1);
  corners = NodalField<float>(m, n, 4);

  NodalField<float> below(fine_x.n_cells(), 1, n_pairs);
  NodalField<float> above(fine_x.n_cells(), 1, n_pairs);
  if (halve_x)
    for (unsigned int J = 0; J <= n; ++J)
      {
        const int j = static_cast<int>(y.start(fine_y.periodic && J == n ? 0 : J));
        conductor(j - 1, below);
        conductor(j, above);
        set_left_weights(static_cast<int>(J), below, above);
      }
  for (unsigned int J = 0; J < n; ++J)
    if (y.has_middle(J))
      {
        conductor(static_cast<int>(y.start(J)), below);
        conductor(static_cast<int>(y.start(J)) + 1, above);
        set_lower_weights(static_cast<int>(J), below, above);
        if (halve_x)
          set_corner_weights(static_cast<int>(J), below, above);
      }
}

void Interpolation::set_left_weights(const int J,
                                     const NodalField<float> &below,
                                     const NodalField<float> &above)
{
  const float *b23 = below.row(p23, 0), *b03 = below.row(p03, 0),
              *b12 = below.row(p12, 0);
  const float *a01 = above.row(p01, 0), *a03 = above.row(p03, 0),
              *a12 = above.row(p12, 0);
  float *weight    = left.row(0, J);
  for (unsigned int I = 0; I < x.n_coarse_cells(); ++I)
    if (x.has_middle(I))
      {
        const unsigned int i = x.start(I) + 1;
        weight[I]            = share(
                     strength(b23[i - 1] + a01[i - 1]) + strength(b03[i - 1]) + strength(a12[i - 1]),
                     strength(b23[i] + a01[i]) + strength(b12[i]) + strength(a03[i]));
      }
}

void Interpolation::set_lower_weights(const int J,
                                      const NodalField<float> &below,
                                      const NodalField<float> &above)
{
  const float *b02 = below.row(p02, 0), *b13 = below.row(p13, 0),
              *b03 = below.row(p03, 0), *b12 = below.row(p12, 0);
  const float *a02 = above.row(p02, 0), *a13 = above.row(p13, 0),
              *a03 = above.row(p03, 0), *a12 = above.row(p12, 0);
  float *weight = lower.row(0, J);
  for (unsigned int I = 0; I <= x.n_coarse_cells(); ++I)
    {
      const int i = static_cast<int>(x.start(I));
      weight[I] =
        share(strength(b02[i] + b13[i - 1]) + strength(b03[i - 1]) + strength(b12[i]),
              strength(a02[i] + a13[i - 1]) + strength(a03[i]) + strength(a12[i - 1]));
    }
}

void Interpolation::set_corner_weights(const int J,
                                       const NodalField<float> &below,
                                       const NodalField<float> &above)
{
  const float *b02 = below.row(p02, 0), *b13 = below.row(p13, 0),
              *b03 = below.row(p03, 0), *b12 = below.row(p12, 0),
              *b23 = below.row(p23, 0);
  const float *a02 = above.row(p02, 0), *a13 = above.row(p13, 0),
              *a03 = above.row(p03, 0), *a12 = above.row(p12, 0),
              *a01  = above.row(p01, 0);
  const float *down = left.row(0, J), *up = left.row(0, J + 1);
  const float *side = lower.row(0, J);
  for (unsigned int I = 0; I < x.n_coarse_cells(); ++I)
    if (x.has_middle(I))
      {
        const unsigned int i = x.start(I) + 1;
        const float south    = strength(b02[i] + b13[i - 1]),
                    north    = strength(a02[i] + a13[i - 1]),
                    west     = strength(b23[i - 1] + a01[i - 1]),
                    east     = strength(b23[i] + a01[i]);
        const float w[4]     = {
              strength(b03[i - 1]) + south * down[I] + west * side[I],
              strength(b12[i]) + south * (1.F - down[I]) + east * side[I + 1],
              strength(a12[i - 1]) + north * up[I] + west * (1.F - side[I]),
              strength(a03[i]) + north * (1.F - up[I]) + east * (1.F - side[I + 1])};
        const float sum = w[0] + w[1] + w[2] + w[3];
        for (unsigned int c = 0; c < 4; ++c)
          corners.row(c, J)[I] = sum > 0.F ? w[c] / sum : 0.25F;
      }
}

template <typename Number>
void Interpolation::fill_patch(const unsigned int I0,
                               const unsigned int J,
                               Patch<Number> &patch) const
{
  std::memset(patch.weight, 0, sizeof(patch.weight));
  std::memset(patch.x, 0, sizeof(patch.x));
  std::fill_n(patch.width, Patch<Number>::n, Number(1));
  const bool middle    = y.has_middle(J);
  patch.n_rows         = middle ? 2 : 1;
  patch.height         = static_cast<Number>(coarse_y.width(J));
  patch.y[0]           = 0;
  patch.y[1]           = middle ? static_cast<Number>(y_distance[J][0]) : patch.height;
  patch.y[2]           = patch.height;
  const unsigned int n = std::min(Patch<Number>::n, x.n_coarse_cells() - I0);
  for (unsigned int l = 0; l < n; ++l)
    fill_lane(l, I0 + l, J, patch);
}

template <typename Number>
void Interpolation::fill_lane(const unsigned int l,
                              const unsigned int I,
                              const unsigned int J,
                              Patch<Number> &patch) const
{
  auto &w       = patch.weight;
  const bool mx = x.has_middle(I), my = y.has_middle(J);
  const unsigned int r = mx ? 2 : 1, t = my ? 2 : 1;
  const int row  = static_cast<int>(J);
  patch.width[l] = static_cast<Number>(coarse_x.width(I));
  patch.x[r][l]  = patch.width[l];
  w[0][0][0][l] = w[0][r][1][l] = w[t][0][2][l] = w[t][r][3][l] = 1;
  if (mx)
    {
      patch.x[1][l]     = static_cast<Number>(x_distance[I][0]);
      const Number down = left.row(0, row)[I], up = left.row(0, row + 1)[I];
      w[0][1][0][l] = down;
      w[0][1][1][l] = 1 - down;
      w[t][1][2][l] = up;
      w[t][1][3][l] = 1 - up;
    }
  if (my)
    for (unsigned int s = 0; s < 2; ++s)
      {
        const Number side     = lower.row(0, row)[I + s];
        w[1][s * r][s][l]     = side;
        w[1][s * r][s + 2][l] = 1 - side;
      }
  if (mx && my)
    {
      // Weights have to sum to one exactly, so that rigid motions are reproduced.
      Number rest = 1;
      for (unsigned int c = 0; c < 3; ++c)
        {
          w[1][1][c][l] = corners.row(c, row)[I];
          rest -= w[1][1][c][l];
        }
      w[1][1][3][l] = rest;
    }
}

Conductor finest_conductor(const UniformMaterial &material)
{
  // Edges along x stretch (D11) and shear (D33), edges along y stretch (D22) and shear.
  const double ratio = material.grid().spacing[1] / material.grid().spacing[0];
  std::vector<std::array<float, 2>> edge;
  for (const ElasticPhase<2> &phase : material.phases())
    {
      const VoigtMatrix<2> &D = phase.stiffness;
      edge.push_back({{static_cast<float>((D(0, 0) + D(2, 2)) * ratio / 4.),
                       static_cast<float>((D(1, 1) + D(2, 2)) / ratio / 4.)}});
    }
  return [&material, edge](int j, NodalField<float> &row) {
    const int nx = static_cast<int>(material.grid().cells[0]),
              ny = static_cast<int>(material.grid().cells[1]);
    row.set_zero();
    if (material.periodicity().y)
      j = (j + ny) % ny;
    else if (j < 0 || j >= ny)
      return;
    for (int i = 0; i < nx; ++i)
      {
        const std::array<float, 2> &g = edge[material.phase_of(i, j)];
        row.row(p01, 0)[i] = row.row(p23, 0)[i] = g[0];
        row.row(p02, 0)[i] = row.row(p13, 0)[i] = g[1];
      }
    row.fill_ghosts(material.periodicity().x, false);
  };
}

Conductor Interpolation::coarse_conductor(const Conductor &fine) const
{
  const unsigned int m = x.n_coarse_cells(), n = y.n_coarse_cells();
  NodalField<float> result(m, n, n_pairs);
  NodalField<float> cells(x.start(m), 1, n_pairs);
  Patch<float> patch;
  for (unsigned int J = 0; J < n; ++J)
    for (unsigned int b = 0; y.start(J) + b < y.start(J + 1); ++b)
      {
        fine(static_cast<int>(y.start(J) + b), cells);
        for (unsigned int I0 = 0; I0 < m; I0 += lanes<float>)
          {
            fill_patch(I0, J, patch);
            add_cells(x, cells, patch, I0, b, result, static_cast<int>(J));
          }
      }
  result.fill_ghosts(coarse_x.periodic, coarse_y.periodic);
  return [stored = std::make_shared<const NodalField<float>>(std::move(result))](
           const int j, NodalField<float> &row) {
    row.set_zero();
    if (j >= -1 && j <= static_cast<int>(stored->n_rows()))
      for (unsigned int k = 0; k < n_pairs; ++k)
        std::copy_n(stored->row(k, j) - 1, row.n_columns() + 2, row.row(k, 0) - 1);
  };
}

template void
Interpolation::fill_patch(const unsigned int, const unsigned int, Patch<float> &) const;
template void
Interpolation::fill_patch(const unsigned int, const unsigned int, Patch<double> &) const;
} // namespace mesoslip::multigrid
