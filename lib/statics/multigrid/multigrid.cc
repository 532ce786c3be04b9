#include "statics/multigrid/multigrid.h"

#include "base/flush_denormals.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace mesoslip::multigrid
{
namespace
{
/** Largest number of nodes of the coarsest grid, which is solved by a dense inverse... */
constexpr unsigned int max_bottom_nodes = 64;
/** ...unless no axis has enough cells to be halved. */
bool can_halve(const unsigned int n_cells)
{
  return n_cells >= 3;
}

/** Ratio of shear moduli above which coarse grids are visited twice. */
constexpr double strong_contrast_ratio = 50.;

double shear_contrast(const UniformMaterial &material)
{
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.;
  for (const unsigned int phase : material.phases_that_occur())
    {
      const double shear = material.phases()[phase].stiffness(2, 2);
      smallest           = std::min(smallest, shear);
      largest            = std::max(largest, shear);
    }
  return largest / smallest;
}
} // namespace

const Kernels &kernels()
{
  using Tables                 = const Kernels &(*)();
  const Tables tables[]        = MESOSLIP_VARIANTS(kernels);
  static const Kernels &chosen = variant(tables, InstructionSet::automatic)();
  return chosen;
}

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
bool Multigrid<Number>::can_coarsen(const UniformGrid<2> &grid)
{
  return can_halve(grid.cells[0]) || can_halve(grid.cells[1]);
}

template <typename Number>
void Multigrid<Number>::build_interpolations()
{
  Assert(can_coarsen(material.grid()), dealii::ExcMessage("too few cells"));
  Conductor conductor = finest_conductor(material);
  Axis x = finest_x, y = finest_y;
  do
    {
      const bool halve_x = can_halve(x.n_cells()), halve_y = can_halve(y.n_cells());
      if (!halve_x && !halve_y)
        break;
      interpolations.emplace_back(x, y, halve_x, halve_y, conductor);
      x         = interpolations.back().coarse_x;
      y         = interpolations.back().coarse_y;
      conductor = interpolations.back().coarse_conductor(conductor);
    }
  while (x.n_nodes() * y.n_nodes() > max_bottom_nodes);

  from_finest = Transfer<Number>(interpolations[0]);
  first       = Level<Number>(interpolations[0]);
  if (bottom() > 1)
    {
      first.to_coarse = Transfer<Number>(interpolations[1]);
      interface       = Level<Number>(interpolations[1]).b;
    }
  for (unsigned int l = 2; l <= bottom(); ++l)
    {
      rest.emplace_back(interpolations[l - 1]);
      if (l < bottom())
        rest.back().to_coarse = Transfer<double>(interpolations[l]);
    }
}

/** Residual of @p x, whose periodic copies are set first. */
template <typename Number>
void Multigrid<Number>::finest_residual(NodalField<Number> &x,
                                        const NodalField<Number> &b)
{
  material.update_copies(x);
  stiffness.vmult(finest_r, x);
  const unsigned int n = whole_vectors<Number>(material.n_columns());
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < material.n_rows(); ++j)
      grid_kernels<Number>().subtract_from(n, b.row(c, j), finest_r.row(c, j));
  constrained[0].clear(finest_r, 2);
}

template <typename Number>
void Multigrid<Number>::vmult(NodalField<Number> &x, const NodalField<Number> &b)
{
  const FlushDenormals flush;
  finest_r = b;
  finest_smoother.columns(finest_r, x, false);
  finest_residual(x, b);
  finest_smoother.rows(finest_r, x);
  finest_residual(x, b);

  from_finest.template restrict_to<2>(finest_r, first.b);
  constrained[1].clear(first.b, 3);
  visit_first();
  from_finest.template prolongate_from<2>(first.x, x);
  constrained[0].clear(x, 2);

  finest_residual(x, b);
  finest_smoother.rows(finest_r, x);
  finest_residual(x, b);
  finest_smoother.columns(finest_r, x, true);
  constrained[0].clear(x, 2);
  material.update_copies(x);
}

template <typename Number>
void Multigrid<Number>::visit_first()
{
  if (bottom() == 1)
    return solve_bottom(first);
  sweep(first, true, [this]() {
    Level<double> &next = rest[0];
    first.to_coarse.template restrict_to<3>(first.r, interface);
    next.b.convert_from(interface);
    constrained[2].clear(next.b, 3);
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
    return solve_bottom(level);
  const auto correct = [this, l, &level]() {
    Level<double> &next = rest[l - 1];
    level.to_coarse.template restrict_to<3>(level.r, next.b);
    constrained[l + 1].clear(next.b, 3);
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
template <typename T>
void Multigrid<Number>::solve_bottom(Level<T> &level)
{
  double *in = bottom_vectors.row(0, 0), *out = bottom_vectors.row(1, 0);
  const unsigned int nx = level.x.n_columns(), n = bottom_vectors.n_columns();
  for (unsigned int k = 0; k < n; ++k)
    in[k] = level.b(k % 3, {k / 3 % nx, k / 3 / nx});
  kernels().dense(n, bottom_inverse.row(0, 0), bottom_inverse.component_stride(), in,
                  out);
  for (unsigned int k = 0; k < n; ++k)
    level.x(k % 3, {k / 3 % nx, k / 3 / nx}) = static_cast<T>(out[k]);
}

template class Multigrid<float>;
template class Multigrid<double>;
} // namespace mesoslip::multigrid
