#include "statics/multigrid/multigrid.h"

#include "statics/multigrid/flush_denormals.h"

#include <algorithm>
#include <type_traits>

namespace mesoslip
{
namespace multigrid
{
namespace
{
/** The coarsest grid is solved by a dense inverse: at most so many nodes... */
constexpr unsigned int max_bottom_nodes = 64;
/** ...unless no direction has so many cells any more. */
constexpr unsigned int min_cells_to_halve = 3;

/** Ratio of shear moduli beyond which one visit of the coarse grids is not enough. */
constexpr double strong_contrast_ratio = 50.;

double shear_contrast(const UniformMaterial &material)
{
  double smallest = 0., largest = 0.;
  std::vector<bool> used(256, false);
  for (unsigned int j = 0; j < material.grid().cells[1]; ++j)
    for (unsigned int i = 0; i < material.grid().cells[0]; ++i)
      used[material.class_of(i, j)] = true;
  for (unsigned int c = 0; c < material.classes().size(); ++c)
    if (used[c])
      {
        const double shear = material.classes()[c].stiffness(2, 2);
        smallest           = smallest == 0. ? shear : std::min(smallest, shear);
        largest            = std::max(largest, shear);
      }
  return largest / smallest;
}
} // namespace

template <typename Number>
Multigrid<Number>::Multigrid(const UniformMaterial &the_material,
                             const UniformGridOperator &the_stiffness)
  : material(the_material)
  , stiffness(the_stiffness)
  , finest_x(Axis::uniform(material.grid().cells[0], 1., material.periodicity().x))
  , finest_y(Axis::uniform(material.grid().cells[1],
                           material.grid().spacing[1] / material.grid().spacing[0],
                           material.periodicity().y))
  , strong_contrast(shear_contrast(material) > strong_contrast_ratio)
  , finest_r(material.n_columns(), material.n_rows())
{
  build_interpolations();
}

template <typename Number>
void Multigrid<Number>::build_interpolations()
{
  Conductor conductor = Conductor::finest(material);
  Axis x = finest_x, y = finest_y;
  while (interpolations.empty() || x.n_nodes() * y.n_nodes() > max_bottom_nodes)
    {
      const bool halve_x = x.n_cells() >= min_cells_to_halve,
                 halve_y = y.n_cells() >= min_cells_to_halve;
      if (!halve_x && !halve_y)
        break;
      interpolations.emplace_back(x, y, halve_x, halve_y, conductor);
      x         = interpolations.back().coarse_x;
      y         = interpolations.back().coarse_y;
      conductor = interpolations.back().coarse_conductor(conductor);
    }
  build_levels();
}

template <typename Number>
void Multigrid<Number>::build_levels()
{
  if (bottom() == 0)
    return;
  from_finest = Transfer<Number>(interpolations[0]);
  first       = Level<Number>(interpolations[0].coarse_x, interpolations[0].coarse_y);
  if (bottom() == 1)
    return;
  first.to_coarse = Transfer<Number>(interpolations[1]);
  interface       = PaddedRows<Number>(3, interpolations[1].coarse_y.n_nodes(),
                                 interpolations[1].coarse_x.n_nodes());
  for (unsigned int l = 2; l <= bottom(); ++l)
    {
      rest.emplace_back(interpolations[l - 1].coarse_x, interpolations[l - 1].coarse_y);
      if (l < bottom())
        rest.back().to_coarse = Transfer<double>(interpolations[l]);
    }
}

template <typename Number>
void Multigrid<Number>::copy_duplicates(NodalField<Number> &x) const
{
  const unsigned int last_column = material.n_columns() - 1,
                     last_row    = material.n_rows() - 1;
  for (unsigned int c = 0; c < 2; ++c)
    {
      if (finest_x.periodic)
        for (unsigned int j = 0; j <= last_row; ++j)
          x.row(c, j)[last_column] = x.row(c, j)[0];
      if (finest_y.periodic)
        std::copy_n(x.row(c, 0), last_column + 1, x.row(c, last_row));
    }
}

template <typename Number>
void Multigrid<Number>::finest_residual(const NodalField<Number> &x,
                                        const NodalField<Number> &b)
{
  stiffness.vmult(finest_r, x);
  const unsigned int n = whole_vectors<Number>(material.n_columns());
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < material.n_rows(); ++j)
      grid_kernels<Number>().subtract_from(n, b.row(c, j), finest_r.row(c, j));
  held[0].clear(finest_r, 2);
}

template <typename Number>
void Multigrid<Number>::vmult(NodalField<Number> &x, const NodalField<Number> &b)
{
  const FlushDenormals flush;
  if (bottom() == 0)
    {
      solve_bottom(x, b, finest_x, finest_y, 2);
      return copy_duplicates(x);
    }
  finest_r = b;
  finest_smoother.columns(finest_r, x, false);
  copy_duplicates(x);
  finest_residual(x, b);
  finest_smoother.rows(finest_r, x);
  copy_duplicates(x);
  finest_residual(x, b);
  from_finest.template restrict_to<2>(finest_r, first.b);
  held[1].clear(first.b, 3);
  visit_first();
  from_finest.template prolongate_from<2>(first.x, x);
  held[0].clear(x, 2);
  copy_duplicates(x);
  finest_residual(x, b);
  finest_smoother.rows(finest_r, x);
  copy_duplicates(x);
  finest_residual(x, b);
  finest_smoother.columns(finest_r, x, true);
  held[0].clear(x, 2);
  copy_duplicates(x);
}

template <typename Number>
void Multigrid<Number>::visit_first()
{
  if (bottom() == 1)
    return solve_bottom(first.x, first.b, interpolations[0].coarse_x,
                        interpolations[0].coarse_y, 3);
  sweep(first, true, [this]() {
    Level<double> &next = rest[0];
    first.to_coarse.template restrict_to<3>(first.r, interface);
    next.b.convert_from(interface);
    held[2].clear(next.b, 3);
    visit(2);
    interface.convert_from(next.x);
    first.to_coarse.template prolongate_from<3>(interface, first.x);
  });
}

template <typename Number>
void Multigrid<Number>::visit(const unsigned int l)
{
  Level<double> &level = rest[l - 2];
  if (l == bottom())
    return solve_bottom(level.x, level.b, interpolations[l - 1].coarse_x,
                        interpolations[l - 1].coarse_y, 3);
  const auto correct = [this, l, &level]() {
    Level<double> &next = rest[l - 1];
    level.to_coarse.template restrict_to<3>(level.r, next.b);
    held[l + 1].clear(next.b, 3);
    visit(l + 1);
    level.to_coarse.template prolongate_from<3>(next.x, level.x);
  };
  sweep(level, true, correct);
  if (strong_contrast)
    sweep(level, false, correct);
}

/** Columns, rows, coarse grid, rows, columns. */
template <typename Number>
template <typename T, typename Correct>
void Multigrid<Number>::sweep(Level<T> &level,
                              const bool from_zero,
                              const Correct &correct)
{
  const Stencil<T> &A = level.stencil;
  if (from_zero)
    level.r.convert_from(level.b);
  else
    A.residual(level.x, level.b, level.r);
  level.smoother.columns(level.r, level.x, !from_zero);
  A.residual(level.x, level.b, level.r);
  level.smoother.rows(level.r, level.x);
  A.residual(level.x, level.b, level.r);
  correct();
  A.residual(level.x, level.b, level.r);
  level.smoother.rows(level.r, level.x);
  A.residual(level.x, level.b, level.r);
  level.smoother.columns(level.r, level.x, true);
}

template <typename Number>
template <typename Field>
void Multigrid<Number>::solve_bottom(Field &x,
                                     const Field &b,
                                     const Axis &axis_x,
                                     const Axis &axis_y,
                                     const unsigned int n_components)
{
  double *in = bottom_vectors.row(0, 0), *out = bottom_vectors.row(1, 0);
  const auto for_each_unknown = [&](const auto &function) {
    for (unsigned int k = 0, j = 0; j < axis_y.n_nodes(); ++j)
      for (unsigned int i = 0; i < axis_x.n_nodes(); ++i)
        for (unsigned int c = 0; c < n_components; ++c, ++k)
          function(k, c, j, i);
  };
  using T = std::decay_t<decltype(x.row(0, 0)[0])>;
  for_each_unknown([&](const unsigned int k, const unsigned int c, const unsigned int j,
                       const unsigned int i) { in[k] = b.row(c, j)[i]; });
  kernels().dense(bottom_vectors.n_columns(), bottom_inverse.row(0, 0),
                  bottom_inverse.array_stride(), in, out);
  for_each_unknown(
    [&](const unsigned int k, const unsigned int c, const unsigned int j,
        const unsigned int i) { x.row(c, j)[i] = static_cast<T>(out[k]); });
}

template class Multigrid<float>;
template class Multigrid<double>;
} // namespace multigrid
} // namespace mesoslip
