#include "elasticity/multigrid/multigrid.h"

#include "elasticity/multigrid/galerkin.h"

#include <xmmintrin.h>

#include <algorithm>

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
constexpr double strong_contrast_ratio = 1e30;

/**
 * Numbers below the range of single precision count as zero while this lives: what decays
 * along a line would otherwise spend hundreds of cycles an operation on being denormal.
 */
class FlushDenormals
{
public:
  FlushDenormals()
    : saved(_mm_getcsr())
  {
    constexpr unsigned int flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    _mm_setcsr(saved | flush_to_zero | denormals_are_zero);
  }
  ~FlushDenormals()
  {
    _mm_setcsr(saved);
  }
  FlushDenormals(const FlushDenormals &)            = delete;
  FlushDenormals &operator=(const FlushDenormals &) = delete;

private:
  unsigned int saved;
};

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

Multigrid::Multigrid(const UniformMaterial &the_material,
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

void Multigrid::build_interpolations()
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
  for (const Interpolation &interpolation : interpolations)
    transfers.emplace_back(interpolation);
  levels.resize(interpolations.size() + 1);
  for (unsigned int l = 1; l < levels.size(); ++l)
    {
      const unsigned int nx = interpolations[l - 1].coarse_x.n_nodes(),
                         ny = interpolations[l - 1].coarse_y.n_nodes();
      levels[l].x = PaddedRows<float>(3, ny, nx);
      levels[l].b = PaddedRows<float>(3, ny, nx);
      levels[l].r = PaddedRows<float>(3, ny, nx);
    }
}

void Multigrid::set_held(const DofMask &mask)
{
  modes = RigidModes(material, mask);
  held.assign(1, HeldUnknowns(mask, finest_x, finest_y));
  std::vector<Stencil> new_stencils(1);
  for (const Interpolation &interpolation : interpolations)
    {
      held.emplace_back(held.back(), interpolation);
      new_stencils.emplace_back(interpolation.coarse_x, interpolation.coarse_y);
    }
  stencils = std::move(new_stencils);
  Galerkin(material, interpolations, held).compute(stencils);
  for (unsigned int l = 1; l + 1 < levels.size(); ++l)
    {
      const Stencil &stencil = stencils[l];
      levels[l].smoother     = LineSmoother<3>(
        interpolations[l - 1].coarse_x.n_nodes(), interpolations[l - 1].coarse_y.n_nodes(),
        [&stencil](const unsigned int row) {
          const int j = static_cast<int>(row);
          return LineBlocks{stencil.row(centre, j), stencil.row(east, j),
                                stencil.row(north, j), stencil.array_stride()};
        });
    }
  if (!interpolations.empty())
    build_finest_smoother();
  build_bottom();
}

void Multigrid::copy_duplicates(NodalField<float> &x) const
{
  const unsigned int last_column = material.n_columns() - 1, last_row = material.n_rows() - 1;
  for (unsigned int c = 0; c < 2; ++c)
    {
      if (finest_x.periodic)
        for (unsigned int j = 0; j <= last_row; ++j)
          x.row(c, j)[last_column] = x.row(c, j)[0];
      if (finest_y.periodic)
        std::copy_n(x.row(c, 0), last_column + 1, x.row(c, last_row));
    }
}

void Multigrid::finest_residual(const NodalField<float> &x, const NodalField<float> &b)
{
  stiffness.vmult(finest_r, x);
  const unsigned int n = whole_vectors<float>(material.n_columns());
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < material.n_rows(); ++j)
      kernels().subtract_from(n, b.row(c, j), finest_r.row(c, j));
  held[0].clear(finest_r, 2);
}

void Multigrid::vmult(NodalField<float> &x, const NodalField<float> &b)
{
  const FlushDenormals flush;
  finest_r = b;
  if (interpolations.empty())
    {
      for (unsigned int k = 0, j = 0; j < finest_y.n_nodes(); ++j)
        for (unsigned int i = 0; i < finest_x.n_nodes(); ++i)
          for (unsigned int c = 0; c < 2; ++c, ++k)
            bottom_vectors.row(0, 0)[k] = b.row(c, j)[i];
      solve_bottom();
      for (unsigned int k = 0, j = 0; j < finest_y.n_nodes(); ++j)
        for (unsigned int i = 0; i < finest_x.n_nodes(); ++i)
          for (unsigned int c = 0; c < 2; ++c, ++k)
            x.row(c, j)[i] = bottom_vectors.row(1, 0)[k];
      copy_duplicates(x);
      return;
    }
  finest_smoother.columns(finest_r, x, false);
  copy_duplicates(x);
  finest_residual(x, b);
  finest_smoother.rows(finest_r, x);
  copy_duplicates(x);
  finest_residual(x, b);
  transfers[0].restrict_to<2>(finest_r, levels[1].b);
  held[1].clear(levels[1].b, 3);
  visit(1);
  transfers[0].prolongate_from<2>(levels[1].x, x);
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

void Multigrid::visit(const unsigned int l)
{
  if (l + 1 == levels.size())
    {
      Level &level = levels[l];
      const unsigned int nx = level.x.n_columns(), ny = level.x.n_rows();
      for (unsigned int k = 0, j = 0; j < ny; ++j)
        for (unsigned int i = 0; i < nx; ++i)
          for (unsigned int c = 0; c < 3; ++c, ++k)
            bottom_vectors.row(0, 0)[k] = level.b.row(c, j)[i];
      solve_bottom();
      for (unsigned int k = 0, j = 0; j < ny; ++j)
        for (unsigned int i = 0; i < nx; ++i)
          for (unsigned int c = 0; c < 3; ++c, ++k)
            level.x.row(c, j)[i] = bottom_vectors.row(1, 0)[k];
      return;
    }
  sweep(l, true);
  if (strong_contrast)
    sweep(l, false);
}

void Multigrid::sweep(const unsigned int l, const bool from_zero)
{
  Level &level           = levels[l];
  const Stencil &stencil = stencils[l];
  if (from_zero)
    level.r.copy_from(level.b);
  else
    stencil.residual(level.x, level.b, level.r);
  level.smoother.columns(level.r, level.x, !from_zero);
  stencil.residual(level.x, level.b, level.r);
  level.smoother.rows(level.r, level.x);
  stencil.residual(level.x, level.b, level.r);
  transfers[l].restrict_to<3>(level.r, levels[l + 1].b);
  held[l + 1].clear(levels[l + 1].b, 3);
  visit(l + 1);
  transfers[l].prolongate_from<3>(levels[l + 1].x, level.x);
  stencil.residual(level.x, level.b, level.r);
  level.smoother.rows(level.r, level.x);
  stencil.residual(level.x, level.b, level.r);
  level.smoother.columns(level.r, level.x, true);
}

void Multigrid::solve_bottom()
{
  kernels().dense(bottom_vectors.n_columns(), bottom_inverse.row(0, 0),
                  bottom_inverse.array_stride(), bottom_vectors.row(0, 0),
                  bottom_vectors.row(1, 0));
}
} // namespace multigrid
} // namespace mesoslip
