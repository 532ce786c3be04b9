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

/** Diagonal block of a cell at one corner; @p sign of dN/dx dN/dy there. */
struct CornerBlock
{
  double xx, yy, xy;
};

CornerBlock
corner_block(const VoigtMatrix<2> &D, const double hx, const double hy, const double sign)
{
  const double Ixx = hy / (3. * hx), Iyy = hx / (3. * hy), Ixy = sign / 4.;
  return {D(0, 0) * Ixx + D(2, 2) * Iyy + 2. * D(0, 2) * Ixy,
          D(1, 1) * Iyy + D(2, 2) * Ixx + 2. * D(1, 2) * Ixy,
          D(0, 2) * Ixx + D(1, 2) * Iyy + (D(0, 1) + D(2, 2)) * Ixy};
}
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
  std::vector<std::array<CornerBlock, 2>> corners;

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
    const double hx = material.grid().spacing[0], hy = material.grid().spacing[1];
    for (const ElasticClass &c : material.classes())
      corners.push_back({{corner_block(c.stiffness, hx, hy, 1.),
                          corner_block(c.stiffness, hx, hy, -1.)}});
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

  /** Calls add(node column, corner block) for the cells around the nodes of row j. */
  template <typename Add>
  void around(const unsigned int j, const Add &add) const
  {
    const unsigned int nx = material.grid().cells[0], ny = material.grid().cells[1];
    const bool wrap = material.periodicity().y;
    for (const bool above : {false, true})
      {
        if (!wrap && (above ? j == ny : j == 0))
          continue;
        const unsigned int cell_row = (above ? j : j + ny - 1) % ny;
        for (unsigned int i = 0; i < nx; ++i)
          {
            // Lower left and upper right corner: positive.
            const auto &blocks = corners[material.class_of(i, cell_row)];
            add(i, blocks[above ? 0 : 1]);
            add(i + 1, blocks[above ? 1 : 0]);
          }
      }
  }

  template <typename Number>
  void blocks(NodalField<Number> &diagonal, NodalField<Number> *coupling) const
  {
    check(diagonal);
    const unsigned int n = material.n_columns();
    std::vector<CornerBlock> row(n);
    for (unsigned int j = rows.begin; j < rows.end; ++j)
      {
        std::fill(row.begin(), row.end(), CornerBlock{0., 0., 0.});
        const auto add = [&](const unsigned int i, const CornerBlock &b) {
          row[i].xx += b.xx;
          row[i].yy += b.yy;
          row[i].xy += b.xy;
        };
        around(j, add);
        if (material.periodicity().x)
          {
            const CornerBlock last = row[n - 1];
            add(n - 1, row[0]);
            add(0, last);
          }
        const unsigned int l = rows.local(j);
        for (unsigned int i = 0; i < n; ++i)
          {
            diagonal.row(0, l)[i] = static_cast<Number>(row[i].xx);
            diagonal.row(1, l)[i] = static_cast<Number>(row[i].yy);
            if (coupling)
              coupling->row(0, l)[i] = static_cast<Number>(row[i].xy);
          }
      }
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
    for (const unsigned int c : {0u, 1u})
      std::copy_n(dst.row(c, 0), material().n_columns(), dst.row(c, dst.n_rows() - 1));
}

template <typename Number>
void UniformGridOperator::diagonal(NodalField<Number> &diagonal) const
{
  implementation->blocks<Number>(diagonal, nullptr);
}

template <typename Number>
void UniformGridOperator::block_diagonal(NodalField<Number> &diagonal,
                                         NodalField<Number> &coupling) const
{
  implementation->check(coupling);
  implementation->blocks<Number>(diagonal, &coupling);
}

UniformGridOperator::Energies
UniformGridOperator::energies(const NodalField<double> &u,
                              const NodalField<double> &w) const
{
  return {0.5 * implementation->product(u), implementation->product(w)};
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
template void UniformGridOperator::diagonal(NodalField<double> &) const;
template void UniformGridOperator::diagonal(NodalField<float> &) const;
template void UniformGridOperator::block_diagonal(NodalField<double> &,
                                                  NodalField<double> &) const;
template void UniformGridOperator::block_diagonal(NodalField<float> &,
                                                  NodalField<float> &) const;
} // namespace mesoslip
