#include "statics/multigrid/interpolation.h"

#include <algorithm>
#include <memory>

namespace mesoslip::multigrid
{
namespace
{
using Vector = float __attribute__((vector_size(64), may_alias));

constexpr unsigned int pairs[n_pairs][2] = {{0, 1}, {0, 2}, {0, 3},
                                            {1, 2}, {1, 3}, {2, 3}};

Vector load(const float *lanes_of_patch)
{
  return *reinterpret_cast<const Vector *>(lanes_of_patch);
}

/** Adds what row @p b of the fine cells of sixteen coarse cells contributes. */
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

Conductor finest_conductor(const UniformMaterial &material)
{
  // Edges along x stretch (D11) and shear (D33), those along y stretch (D22) and shear.
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
} // namespace mesoslip::multigrid
