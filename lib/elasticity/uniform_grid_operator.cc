#include "elasticity/uniform_grid_operator.h"

#include "elasticity/row_sweep.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace mesoslip
{
namespace
{
using Strain = decltype(&kernels::baseline::strain);
using Dot    = decltype(&kernels::baseline::dot);

std::pair<Strain, Dot> row_functions(const InstructionSet isa)
{
  using namespace kernels;
  const Strain strains[] = MESOSLIP_VARIANTS(strain);
  const Dot dots[]       = MESOSLIP_VARIANTS(dot);
  return {variant(strains, isa), variant(dots, isa)};
}

/** Everything one precision needs; made when that precision is first used. */
template <typename Number>
struct Precision
{
  Precision(const UniformMaterial &material, const InstructionSet isa)
    : kernels(material, isa)
    , sweep(material, kernels)
    , rows(material.n_columns(), kernels.functions.rows_at_once)
  {
  }

  RowKernels<Number> kernels;
  RowSweep<Number> sweep;
  NodalField<Number> rows;
};
} // namespace

struct UniformGridOperator::Implementation
{
  const UniformMaterial &material;
  NodeRows rows;
  InstructionSet isa;
  Strain strain;
  Dot dot;
  std::unique_ptr<Precision<double>> in_double;
  std::unique_ptr<Precision<float>> in_float;

  Implementation(const UniformMaterial &m,
                 const NodeRows &r,
                 const InstructionSet requested)
    : material(m)
    , rows(r)
    , isa(resolve(requested))
  {
    std::tie(strain, dot) = row_functions(isa);
    if (rows.n_global != material.n_rows() || rows.begin >= rows.end ||
        rows.end > rows.n_global)
      throw std::invalid_argument("the rows of the operator do not fit the grid");
    if (material.periodicity().y && rows.n_local() != rows.n_global)
      throw std::invalid_argument("a grid periodic in y needs all rows on one rank");
  }

  Precision<double> &precision(const double)
  {
    if (!in_double)
      in_double = std::make_unique<Precision<double>>(material, isa);
    return *in_double;
  }

  Precision<float> &precision(const float)
  {
    if (!in_float)
      in_float = std::make_unique<Precision<float>>(material, isa);
    return *in_float;
  }

  template <typename Number>
  void check(const NodalField<Number> &field) const
  {
    if (field.n_columns() != material.n_columns() || field.n_rows() != rows.n_local())
      throw std::invalid_argument("a nodal field does not fit the grid of its operator");
  }

  /**
   * Internal forces of @p src, in portions of one or several owned rows, written to the
   * rows of @p dst or, if that is null, to the first rows of a scratch field. After each
   * portion @p consume (local row, number of rows, field, row of field) is called.
   */
  template <typename Number, typename Consume>
  void
  traverse(NodalField<Number> *dst, const NodalField<Number> &src, const Consume &consume)
  {
    check(src);
    Precision<Number> &p       = precision(Number());
    const unsigned int ny      = material.grid().cells[1];
    const unsigned int at_once = p.kernels.functions.rows_at_once;

    const auto state = [&](const unsigned int j, NodalField<Number> &f,
                           const unsigned int row) {
      kernels::Rows<Number> r;
      // The storing kernels do not write to the state.
      r.ux       = const_cast<Number *>(src.row(0, rows.local(j)));
      r.uy       = const_cast<Number *>(src.row(1, rows.local(j)));
      r.stride   = src.stride();
      r.fx       = f.row(0, row);
      r.fy       = f.row(1, row);
      r.f_stride = f.stride();
      return r;
    };

    p.sweep.reset();
    if (rows.has_lower_ghost())
      p.sweep.store(state(rows.begin - 1, p.rows, 0), rows.begin - 1, false);
    else if (material.periodicity().y)
      p.sweep.store(state(ny - 1, p.rows, 0), ny - 1, false);

    const unsigned int end  = std::min(rows.end, ny);
    NodalField<Number> &out = dst ? *dst : p.rows;
    for (unsigned int j = rows.begin; j < end;)
      {
        const bool several   = j + at_once <= end;
        const unsigned int n = several ? at_once : 1;
        const unsigned int l = dst ? rows.local(j) : 0;
        p.sweep.store(state(j, out, l), j, several);
        consume(rows.local(j), n, out, l);
        j += n;
      }
    if (rows.end == rows.n_global && !material.periodicity().y)
      {
        const unsigned int l = dst ? rows.local(ny) : 0;
        p.sweep.finish(state(ny, out, l));
        consume(rows.local(ny), 1, out, l);
      }
  }

  double product(const NodalField<double> &v)
  {
    const unsigned int n = material.n_columns() - (material.periodicity().x ? 1 : 0);
    double sum           = 0.;
    traverse<double>(nullptr, v,
                     [&](const unsigned int row, const unsigned int n_rows,
                         const NodalField<double> &f, const unsigned int at) {
                       for (unsigned int k = 0; k < n_rows; ++k)
                         sum += dot(v.row(0, row + k), f.row(0, at + k), n) +
                                dot(v.row(1, row + k), f.row(1, at + k), n);
                     });
    return sum;
  }
};

UniformGridOperator::UniformGridOperator(const UniformMaterial &material,
                                         const InstructionSet isa)
  : UniformGridOperator(material, NodeRows::all(material.n_rows()), isa)
{
}

UniformGridOperator::UniformGridOperator(const UniformMaterial &material,
                                         const NodeRows &rows,
                                         const InstructionSet isa)
  : implementation(std::make_unique<Implementation>(material, rows, isa))
{
}

UniformGridOperator::~UniformGridOperator()                               = default;
UniformGridOperator::UniformGridOperator(UniformGridOperator &&) noexcept = default;

const UniformMaterial &UniformGridOperator::material() const
{
  return implementation->material;
}

const NodeRows &UniformGridOperator::rows() const
{
  return implementation->rows;
}

template <typename Number>
void UniformGridOperator::vmult(NodalField<Number> &dst,
                                const NodalField<Number> &src) const
{
  implementation->check(dst);
  implementation->traverse(
    &dst, src,
    [](unsigned int, unsigned int, const NodalField<Number> &, unsigned int) {});
  if (material().periodicity().y)
    material().copy_duplicates(dst);
}

// A cell gives the entries of the diagonal at two opposite corners the same numbers.
void UniformGridOperator::diagonal(NodalField<double> &diagonal) const
{
  implementation->check(diagonal);
  const UniformGrid<2> &grid = material().grid();
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  const bool periodic_y = material().periodicity().y;
  const double hx = grid.spacing[0], hy = grid.spacing[1];
  const double Ixx = hy / (3. * hx), Iyy = hx / (3. * hy);
  diagonal.set_zero();
  for (unsigned int j = rows().begin; j < rows().end; ++j)
    {
      double *x = diagonal.row(0, rows().local(j)), *y = diagonal.row(1, rows().local(j));
      for (const bool above : {false, true})
        for (unsigned int i = 0; i < nx && (periodic_y || (above ? j < ny : j > 0)); ++i)
          {
            const unsigned int cell_row = (above ? j : j + ny - 1) % ny;
            const VoigtMatrix<2> &D =
              material().phases()[material().phase_of(i, cell_row)].stiffness;
            // The sign of dN/dx dN/dy: lower left and upper right corner are positive.
            for (const bool right : {false, true})
              {
                const double Ixy = (above == right ? -1. : 1.) / 4.;
                x[i + right] += D(0, 0) * Ixx + D(2, 2) * Iyy + 2. * D(0, 2) * Ixy;
                y[i + right] += D(1, 1) * Iyy + D(2, 2) * Ixx + 2. * D(1, 2) * Ixy;
              }
          }
      if (material().periodicity().x)
        for (double *d : {x, y})
          d[0] = d[nx] = d[0] + d[nx];
    }
}

double UniformGridOperator::elastic_energy(const NodalField<double> &u) const
{
  return 0.5 * implementation->product(u);
}

void UniformGridOperator::strain(const NodalField<double> &u,
                                 const unsigned int j,
                                 double *exx,
                                 double *eyy,
                                 double *gxy) const
{
  const UniformGrid<2> &grid = material().grid();
  implementation->strain(u.row(0, j), u.row(0, j + 1), u.row(1, j) - u.row(0, j),
                         grid.cells[0], 0.5 / grid.spacing[0], 0.5 / grid.spacing[1], exx,
                         eyy, gxy);
}

template void UniformGridOperator::vmult(NodalField<double> &,
                                         const NodalField<double> &) const;
template void UniformGridOperator::vmult(NodalField<float> &,
                                         const NodalField<float> &) const;
} // namespace mesoslip
