#include "statics/multigrid/galerkin.h"
#include "statics/multigrid/multigrid.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace mesoslip
{
namespace multigrid
{
namespace
{
/** Blocks of the node rows of the finest grid, made from those of the cells. */
template <typename Number>
class FinestBlocks
{
public:
  FinestBlocks(const UniformMaterial &the_material,
               const Axis &the_x,
               const Axis &the_y,
               const HeldUnknowns &the_held)
    : material(the_material)
    , x(the_x)
    , y(the_y)
    , held(the_held)
    , arrays(n_arrays, 1, the_x.n_nodes() + 1)
  {
    for (const ElasticClass &c : material.classes())
      cells.emplace_back(finest_cell_matrix(c.stiffness, y.position[1] / x.position[1])
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
    for (const HeldUnknowns::Node &node : held.row(j))
      hold(node);
    // The row above; that of the last one is the first, if any.
    for (const HeldUnknowns::Node &node : held.row((j + 1) % y.n_nodes()))
      clear_column(node, node.column, 7);
    return {arrays.row(0, 0), arrays.row(3, 0), arrays.row(7, 0), arrays.array_stride()};
  }

private:
  /** 3 of the nodes, 4 to the right, 4 upwards. */
  static constexpr unsigned int n_arrays = 11;

  /** Cell row j; its lower (corner 0) or upper (2) nodes are those of the row. */
  void add_cells(const unsigned int j, const unsigned int corner)
  {
    Number *to[n_arrays];
    for (unsigned int k = 0; k < n_arrays; ++k)
      to[k] = arrays.row(k, 0);
    for (unsigned int i = 0; i < x.n_cells(); ++i)
      {
        const Eigen::Matrix<Number, 8, 8> &K = cells[material.class_of(i, j)];
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

  void clear_column(const HeldUnknowns::Node &node,
                    const unsigned int i,
                    const unsigned int array)
  {
    for (unsigned int d = 0; d < 2; ++d)
      if (node.holds(d))
        for (unsigned int c = 0; c < 2; ++c)
          arrays.row(array + 2 * c + d, 0)[i] = 0;
  }

  void hold(const HeldUnknowns::Node &node)
  {
    const unsigned int i = node.column;
    for (unsigned int c = 0; c < 2; ++c)
      if (node.holds(c))
        {
          arrays.row(1, 0)[i]     = 0;
          arrays.row(2 * c, 0)[i] = 1;
          for (unsigned int d = 0; d < 2; ++d)
            arrays.row(3 + 2 * c + d, 0)[i] = arrays.row(7 + 2 * c + d, 0)[i] = 0;
        }
    // The node to the left; that of the first one is the last, if any.
    clear_column(node, (i > 0 ? i : x.n_nodes()) - 1, 3);
  }

  const UniformMaterial &material;
  const Axis &x;
  const Axis &y;
  const HeldUnknowns &held;
  std::vector<Eigen::Matrix<Number, 8, 8>> cells;
  PaddedRows<Number> arrays;
};

Eigen::MatrixXd finest_dense(const UniformMaterial &material,
                             const Axis &x,
                             const Axis &y,
                             const HeldUnknowns &held)
{
  const unsigned int nx = x.n_nodes(), ny = y.n_nodes();
  const Eigen::Index n_unknowns = Eigen::Index{2} * nx * ny;
  Eigen::MatrixXd matrix        = Eigen::MatrixXd::Zero(n_unknowns, n_unknowns);
  for (unsigned int j = 0; j < y.n_cells(); ++j)
    for (unsigned int i = 0; i < x.n_cells(); ++i)
      {
        const auto K =
          finest_cell_matrix(material.classes()[material.class_of(i, j)].stiffness,
                             y.position[1] / x.position[1]);
        const auto unknown = [&](const unsigned int k) {
          const unsigned int n = k / 2;
          return 2 * ((j + n / 2) % ny * nx + (i + n % 2) % nx) + k % 2;
        };
        for (unsigned int r = 0; r < 8; ++r)
          for (unsigned int c = 0; c < 8; ++c)
            matrix(unknown(r), unknown(c)) += K(r, c);
      }
  for (unsigned int j = 0; j < ny; ++j)
    for (const HeldUnknowns::Node &node : held.row(j))
      for (unsigned int c = 0; c < 2; ++c)
        if (node.holds(c))
          {
            const unsigned int k = 2 * (j * nx + node.column) + c;
            matrix.row(k).setZero();
            matrix.col(k).setZero();
            matrix(k, k) = 1.;
          }
  return matrix;
}
} // namespace

template <typename Number>
void Multigrid<Number>::build_finest_smoother()
{
  FinestBlocks<Number> blocks(material, finest_x, finest_y, held[0]);
  finest_smoother =
    LineSmoother<2, Number>(finest_x.n_nodes(), finest_y.n_nodes(),
                            [&blocks](const unsigned int j) { return blocks(j); });
}

template <typename Number>
template <typename T>
void Multigrid<Number>::build_smoother(Level<T> &level, const Axis &x, const Axis &y)
{
  const Stencil<T> &stencil = level.stencil;
  level.smoother =
    LineSmoother<3, T>(x.n_nodes(), y.n_nodes(), [&stencil](const unsigned int row) {
      const int j = static_cast<int>(row);
      return LineBlocks<T>{stencil.row(centre, j), stencil.row(east, j),
                           stencil.row(north, j), stencil.array_stride()};
    });
}

template <typename Number>
void Multigrid<Number>::build_bottom()
{
  const bool only_grid          = interpolations.empty();
  const Axis &x                 = only_grid ? finest_x : interpolations.back().coarse_x;
  const Axis &y                 = only_grid ? finest_y : interpolations.back().coarse_y;
  const unsigned int components = only_grid ? 2 : 3;
  Eigen::MatrixXd matrix        = only_grid      ? finest_dense(material, x, y, held[0])
                                  : rest.empty() ? first.stencil.dense()
                                                 : rest.back().stencil.dense();
  const unsigned int n          = static_cast<unsigned int>(matrix.rows());

  // Rigid motions get an energy: they are not in the right-hand side, but for round-off.
  const double scale = matrix.trace() / n;
  for (const auto &mode : modes.modes())
    {
      Eigen::VectorXd z(n);
      const double aspect = finest_y.position[1] / finest_x.position[1];
      for (unsigned int k = 0, j = 0; j < y.n_nodes(); ++j)
        for (unsigned int i = 0; i < x.n_nodes(); ++i)
          {
            z[k++] = mode[0] - mode[2] * modes.y(y.position[j] / aspect);
            z[k++] = mode[1] + mode[2] * modes.x(x.position[i]);
            if (components == 3)
              z[k++] = mode[2];
          }
      z.normalize();
      matrix.noalias() += scale * z * z.transpose();
    }
  // In place: fresh memory for copies takes longer than to write them.
  const Eigen::LDLT<Eigen::Ref<Eigen::MatrixXd>> factors(matrix);
  const Eigen::MatrixXd inverse = factors.solve(Eigen::MatrixXd::Identity(n, n));
  bottom_inverse                = PaddedRows<double>(n, 1, n);
  bottom_vectors                = PaddedRows<double>(2, 1, n);
  for (unsigned int r = 0; r < n; ++r)
    for (unsigned int c = 0; c < n; ++c)
      bottom_inverse.row(r, 0)[c] = 0.5 * (inverse(r, c) + inverse(c, r));
}

template <typename Number>
void Multigrid<Number>::set_held(const DofMask &mask)
{
  modes = RigidModes(material, mask);
  held.assign(1, HeldUnknowns(mask, finest_x, finest_y));
  for (const Interpolation &interpolation : interpolations)
    held.emplace_back(held.back(), interpolation);
  if (bottom() > 0)
    {
      std::vector<Stencil<double>> stencils;
      first.stencil =
        Stencil<Number>(interpolations[0].coarse_x, interpolations[0].coarse_y);
      for (unsigned int l = 2; l <= bottom(); ++l)
        stencils.emplace_back(interpolations[l - 1].coarse_x,
                              interpolations[l - 1].coarse_y);
      Galerkin(material, interpolations, held).compute(first.stencil, stencils);
      for (unsigned int l = 2; l <= bottom(); ++l)
        rest[l - 2].stencil = std::move(stencils[l - 2]);
      build_finest_smoother();
    }
  for (unsigned int l = 1; l < bottom(); ++l)
    {
      const Interpolation &p = interpolations[l - 1];
      if (l == 1)
        build_smoother(first, p.coarse_x, p.coarse_y);
      else
        build_smoother(rest[l - 2], p.coarse_x, p.coarse_y);
    }
  build_bottom();
}

template void Multigrid<float>::set_held(const DofMask &);
template void Multigrid<double>::set_held(const DofMask &);
} // namespace multigrid
} // namespace mesoslip
