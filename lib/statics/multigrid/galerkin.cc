#include "statics/multigrid/galerkin.h"

#include <algorithm>
#include <cstring>

namespace mesoslip::multigrid
{
namespace
{
/** Stiffness against rotation of a corner relative to its coarse cell, over the shear
 * modulus. */
constexpr double rotation_stiffness = 0.02;

std::array<double, n_finest_coefficients>
finest_coefficients(const ElasticPhase<2> &phase, const double height)
{
  const VoigtMatrix<2> &D = phase.stiffness;
  const Eigen::Matrix2d H = hourglass_stiffness(phase, {{1., height}}) * height / 12.;
  std::array<double, n_finest_coefficients> k;
  k[d11] = D(0, 0) * height;
  k[d12] = D(0, 1) * height;
  k[d13] = D(0, 2) * height;
  k[d22] = D(1, 1) * height;
  k[d23] = D(1, 2) * height;
  k[d33] = D(2, 2) * height;
  k[h11] = H(0, 0);
  k[h12] = H(0, 1);
  k[h22] = H(1, 1);
  return k;
}

/** Sets rows and columns of constrained unknowns of the cells of a row to zero. */
void clear_constrained(const std::vector<ConstrainedUnknowns::Node> &nodes,
                       const unsigned int upper,
                       const bool periodic,
                       NodalField<double> &matrices)
{
  const unsigned int n_cells = matrices.n_columns();
  const auto clear           = [&](const unsigned int cell, const unsigned int unknown) {
    for (unsigned int a = 0; a < 12; ++a)
      {
        const unsigned int r = std::min(a, unknown), c = std::max(a, unknown);
        matrices.row(r * 12 - r * (r - 1) / 2 + c - r, 0)[cell] = 0.;
      }
  };
  for (const ConstrainedUnknowns::Node &node : nodes)
    for (unsigned int c = 0; c < 3; ++c)
      if (node.has(c))
        {
          if (node.column < n_cells)
            clear(node.column, 6 * upper + c);
          if (node.column > 0)
            clear(node.column - 1, 6 * upper + 3 + c);
          else if (periodic)
            clear(n_cells - 1, 6 * upper + 3 + c);
        }
}
} // namespace

Galerkin::Galerkin(const UniformMaterial &material,
                   const std::vector<Interpolation> &interpolations,
                   const std::vector<ConstrainedUnknowns> &constrained)
  : material(material)
  , interpolations(interpolations)
  , constrained(constrained)
  , cell_height(material.grid().spacing[1] / material.grid().spacing[0])
{
  for (const ElasticPhase<2> &phase : material.phases())
    coefficients.push_back(finest_coefficients(phase, cell_height));
  rows.resize(interpolations.size());
  for (unsigned int l = 1; l < rows.size(); ++l)
    for (NodalField<double> &row : rows[l])
      row =
        NodalField<double>(interpolations[l - 1].x.n_coarse_cells(), 1, n_cell_entries);
}

template <typename Number>
void Galerkin::compute(Stencil<Number> &first, std::vector<Stencil<double>> &rest)
{
  NodalField<double> last(interpolations.back().x.n_coarse_cells(), 1, n_cell_entries);
  // Computes all complete rows, at most one per grid: first the row of the finest pair of
  // grids, then coarser ones.
  for (unsigned int J = 0; J < interpolations[0].y.n_coarse_cells(); ++J)
    {
      unsigned int row = J;
      for (unsigned int l = 1; l <= interpolations.size(); ++l)
        {
          const bool coarsest = l == interpolations.size();
          unsigned int parent = 0, b = 0;
          if (!coarsest)
            {
              parent = interpolations[l].y.coarse_cell(row);
              b      = row - interpolations[l].y.start(parent);
            }
          NodalField<double> &matrices = coarsest ? last : rows[l][b];
          if (l == 1)
            finest_row(row, matrices);
          else
            coarse_row(l - 1, row, matrices);
          const Interpolation &p  = interpolations[l - 1];
          const unsigned int next = (row + 1) % p.coarse_y.n_nodes();
          clear_constrained(constrained[l].row(row), 0, p.coarse_x.periodic, matrices);
          clear_constrained(constrained[l].row(next), 1, p.coarse_x.periodic, matrices);
          if (l == 1)
            first.add_cell_row(row, matrices);
          else
            rest[l - 2].add_cell_row(row, matrices);
          if (coarsest || row + 1 < interpolations[l].y.start(parent + 1))
            break;
          row = parent;
        }
    }
  first.finish(constrained[1]);
  for (unsigned int l = 0; l < rest.size(); ++l)
    rest[l].finish(constrained[l + 2]);
}

void Galerkin::finest_row(const unsigned int J, NodalField<double> &matrices)
{
  const Interpolation &p = interpolations[0];
  finest.cell_height     = cell_height;
  for (unsigned int I0 = 0; I0 < p.x.n_coarse_cells(); I0 += lanes<double>)
    {
      p.fill_patch(I0, J, finest);
      set_coefficients(I0, J);
      set_free_nodes(I0, J);
      kernels().galerkin_finest(finest, matrices.row(0, 0) + I0,
                                matrices.component_stride());
    }
}

void Galerkin::set_coefficients(const unsigned int I0, const unsigned int J)
{
  const Interpolation &p = interpolations[0];
  std::memset(finest.coefficient, 0, sizeof(finest.coefficient));
  std::memset(finest.rotation_stiffness, 0, sizeof(finest.rotation_stiffness));
  const unsigned int n = std::min(lanes<double>, p.x.n_coarse_cells() - I0);
  for (unsigned int l = 0; l < n; ++l)
    {
      const unsigned int i = p.x.start(I0 + l), j = p.y.start(J);
      double shear = 0.;
      for (unsigned int b = 0; b < finest.n_rows; ++b)
        for (unsigned int a = 0; i + a < p.x.start(I0 + l + 1); ++a)
          {
            const auto &k = coefficients[material.phase_of(i + a, j + b)];
            for (unsigned int c = 0; c < n_finest_coefficients; ++c)
              finest.coefficient[b][a][c][l] = k[c];
            shear = a + b == 0 ? k[d33] : std::min(shear, k[d33]);
          }
      finest.rotation_stiffness[l] =
        rotation_stiffness * shear / finest.cell_height * finest.width[l] * finest.height;
    }
}

void Galerkin::set_free_nodes(const unsigned int I0, const unsigned int J)
{
  const Interpolation &p = interpolations[0];
  std::fill_n(&finest.free_x[0][0][0], 9 * lanes<double>, 1.);
  std::fill_n(&finest.free_y[0][0][0], 9 * lanes<double>, 1.);
  const unsigned int n_columns = p.x.start(p.x.n_coarse_cells());
  const unsigned int last_cell = std::min(I0 + lanes<double>, p.x.n_coarse_cells()) - 1;
  const unsigned int first = p.x.start(I0), last = p.x.start(last_cell + 1);
  const auto set = [&](const unsigned int column, const unsigned int b,
                       const ConstrainedUnknowns::Node &node) {
    for (unsigned int I = I0; I <= last_cell; ++I)
      if (p.x.start(I) <= column && column <= p.x.start(I + 1))
        {
          const unsigned int a = column - p.x.start(I);
          if (node.has(0))
            finest.free_x[b][a][I - I0] = 0.;
          if (node.has(1))
            finest.free_y[b][a][I - I0] = 0.;
        }
  };
  for (unsigned int b = 0; b <= finest.n_rows; ++b)
    {
      unsigned int j = p.y.start(J) + b;
      if (p.coarse_y.periodic && J + 1 == p.y.n_coarse_cells() && b == finest.n_rows)
        j = 0;
      for (const ConstrainedUnknowns::Node &node : constrained[0].row(j))
        {
          if (node.column >= first && node.column <= last)
            set(node.column, b, node);
          if (node.column == 0 && p.coarse_x.periodic)
            set(n_columns, b, node);
        }
    }
}

void Galerkin::coarse_row(const unsigned int l,
                          const unsigned int J,
                          NodalField<double> &matrices)
{
  const Interpolation &p = interpolations[l];
  for (unsigned int I0 = 0; I0 < p.x.n_coarse_cells(); I0 += lanes<double>)
    {
      p.fill_patch(I0, J, coarse);
      std::memset(coarse.matrix, 0, sizeof(coarse.matrix));
      const unsigned int n = std::min(lanes<double>, p.x.n_coarse_cells() - I0);
      for (unsigned int b = 0; b < coarse.n_rows; ++b)
        for (unsigned int e = 0; e < n_cell_entries; ++e)
          {
            const double *from = rows[l][b].row(e, 0);
            for (unsigned int k = 0; k < n; ++k)
              {
                const unsigned int i      = p.x.start(I0 + k);
                coarse.matrix[b][0][e][k] = from[i];
                if (i + 1 < p.x.start(I0 + k + 1))
                  coarse.matrix[b][1][e][k] = from[i + 1];
              }
          }
      kernels().galerkin_coarse(coarse, matrices.row(0, 0) + I0,
                                matrices.component_stride());
    }
}

template void Galerkin::compute(Stencil<float> &, std::vector<Stencil<double>> &);
template void Galerkin::compute(Stencil<double> &, std::vector<Stencil<double>> &);
} // namespace mesoslip::multigrid
