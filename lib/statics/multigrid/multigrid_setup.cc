#include "statics/multigrid/galerkin.h"
#include "statics/multigrid/multigrid.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace mesoslip::multigrid
{
namespace
{
/** Blocks of the node rows of the finest grid, assembled from cell matrices. */
template <typename Number>
class FinestBlocks
{
public:
  FinestBlocks(const UniformMaterial &the_material,
               const Axis &the_x,
               const Axis &the_y,
               const ConstrainedUnknowns &the_constraints)
    : material(the_material)
    , x(the_x)
    , y(the_y)
    , constrained(the_constraints)
    , arrays(the_x.n_nodes() + 1, 1, n_arrays)
  {
    for (const ElasticPhase<2> &phase : material.phases())
      cells.emplace_back(cell_stiffness(phase, {{1., y.position[1] / x.position[1]}})
                           .template cast<Number>());
  }

  LineBlocks<Number> operator()(const unsigned int j)
  {
    arrays.set_zero();
    const unsigned int ny = y.n_cells();
    if (j < ny)
      add_cells(j, 0);
    if (j > 0 || y.periodic)
      add_cells(j > 0 ? j - 1 : ny - 1, 2);
    if (x.periodic)
      for (unsigned int k = 0; k < n_arrays; ++k)
        arrays.row(k, 0)[0] += arrays.row(k, 0)[x.n_cells()];
    for (const ConstrainedUnknowns::Node &node : constrained.row(j))
      constrain(node);
    // The row above; above the last row is the first, on a periodic axis.
    for (const ConstrainedUnknowns::Node &node : constrained.row((j + 1) % y.n_nodes()))
      clear_column(node, node.column, 7);
    return {arrays.row(0, 0), arrays.row(3, 0), arrays.row(7, 0),
            arrays.component_stride()};
  }

private:
  /** 3 of the nodes, 4 to the right, 4 upwards. */
  static constexpr unsigned int n_arrays = 11;

  /** Adds cell row j, whose lower (corner 0) or upper (2) nodes form the row. */
  void add_cells(const unsigned int j, const unsigned int corner)
  {
    Number *to[n_arrays];
    for (unsigned int k = 0; k < n_arrays; ++k)
      to[k] = arrays.row(k, 0);
    for (unsigned int i = 0; i < x.n_cells(); ++i)
      {
        const Eigen::Matrix<Number, 8, 8> &K = cells[material.phase_of(i, j)];
        const unsigned int l = 2 * corner, r = l + 2;
        for (unsigned int c = 0, k = 0; c < 2; ++c)
          for (unsigned int d = c; d < 2; ++d, ++k)
            {
              to[k][i] += K(l + c, l + d);
              to[k][i + 1] += K(r + c, r + d);
            }
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            {
              to[3 + 2 * c + d][i] += K(l + c, r + d);
              if (corner == 0)
                {
                  to[7 + 2 * c + d][i] += K(c, 4 + d);
                  to[7 + 2 * c + d][i + 1] += K(2 + c, 6 + d);
                }
            }
      }
  }

  void clear_column(const ConstrainedUnknowns::Node &node,
                    const unsigned int i,
                    const unsigned int array)
  {
    for (unsigned int d = 0; d < 2; ++d)
      if (node.has(d))
        for (unsigned int c = 0; c < 2; ++c)
          arrays.row(array + 2 * c + d, 0)[i] = 0;
  }

  void constrain(const ConstrainedUnknowns::Node &node)
  {
    const unsigned int i = node.column;
    for (unsigned int c = 0; c < 2; ++c)
      if (node.has(c))
        {
          arrays.row(1, 0)[i]     = 0;
          arrays.row(2 * c, 0)[i] = 1;
          for (unsigned int d = 0; d < 2; ++d)
            arrays.row(3 + 2 * c + d, 0)[i] = arrays.row(7 + 2 * c + d, 0)[i] = 0;
        }
    // The node to the left; left of the first is the last, on a periodic axis.
    clear_column(node, (i > 0 ? i : x.n_nodes()) - 1, 3);
  }

  const UniformMaterial &material;
  const Axis &x;
  const Axis &y;
  const ConstrainedUnknowns &constrained;
  std::vector<Eigen::Matrix<Number, 8, 8>> cells;
  NodalField<Number> arrays;
};
} // namespace

template <typename Number>
void Multigrid<Number>::build_bottom(const DofMask &mask)
{
  const Axis &x = interpolations.back().coarse_x;
  const Axis &y = interpolations.back().coarse_y;
  Eigen::MatrixXd matrix =
    rest.empty() ? first.stencil.dense() : rest.back().stencil.dense();
  const unsigned int n = static_cast<unsigned int>(matrix.rows());
  // Adds energy to rigid motions: they are absent from the right-hand side up to
  // round-off.
  const double scale  = matrix.trace() / n;
  const double aspect = finest_y.position[1] / finest_x.position[1];
  const RigidModes modes(material, mask);
  for (const auto &mode : modes.modes())
    {
      Eigen::VectorXd z(n);
      for (unsigned int k = 0, j = 0; j < y.n_nodes(); ++j)
        for (unsigned int i = 0; i < x.n_nodes(); ++i)
          {
            z[k++] = mode[0] - mode[2] * modes.y(y.position[j] / aspect);
            z[k++] = mode[1] + mode[2] * modes.x(x.position[i]);
            z[k++] = mode[2];
          }
      z.normalize();
      matrix.noalias() += scale * z * z.transpose();
    }
  // In place: allocating copies takes longer than writing them.
  const Eigen::LDLT<Eigen::Ref<Eigen::MatrixXd>> factors(matrix);
  const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(n, n));
  bottom_inverse                = NodalField<double>(n, 1, n);
  bottom_vectors                = NodalField<double>(n, 1, 2);
  for (unsigned int r = 0; r < n; ++r)
    for (unsigned int c = 0; c < n; ++c)
      bottom_inverse.row(r, 0)[c] = 0.5 * (inverse(r, c) + inverse(c, r));
}

template <typename Number>
void Multigrid<Number>::set_constrained(const DofMask &mask)
{
  constrained.assign(1, ConstrainedUnknowns(mask, finest_x, finest_y));
  for (const Interpolation &interpolation : interpolations)
    constrained.emplace_back(constrained.back(), interpolation.x, interpolation.y);

  Stencil<Number> stencil(interpolations[0].coarse_x, interpolations[0].coarse_y);
  std::vector<Stencil<double>> stencils;
  for (unsigned int l = 1; l < bottom(); ++l)
    stencils.emplace_back(interpolations[l].coarse_x, interpolations[l].coarse_y);
  Galerkin(material, interpolations, constrained).compute(stencil, stencils);

  FinestBlocks<Number> blocks(material, finest_x, finest_y, constrained[0]);
  finest_smoother =
    LineSmoother<2, Number>(finest_x.n_nodes(), finest_y.n_nodes(),
                            [&blocks](const unsigned int j) { return blocks(j); });
  first.set_stencil(std::move(stencil));
  for (unsigned int l = 2; l <= bottom(); ++l)
    rest[l - 2].set_stencil(std::move(stencils[l - 2]));
  build_bottom(mask);
}

template void Multigrid<float>::set_constrained(const DofMask &);
template void Multigrid<double>::set_constrained(const DofMask &);
} // namespace mesoslip::multigrid
