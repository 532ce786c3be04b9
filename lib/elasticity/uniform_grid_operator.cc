#include "elasticity/uniform_grid_operator.h"

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
UniformGridOperator::UniformGridOperator(const UniformMaterial &material,
                                         const InstructionSet isa)
  : UniformGridOperator(material, NodeRows::all(material.n_rows()), isa)
{
}

UniformGridOperator::UniformGridOperator(const UniformMaterial &material,
                                         const NodeRows &rows,
                                         const InstructionSet requested)
  : material(material)
  , rows(rows)
  , isa(resolve(requested))
{
  if (rows.n_global != material.n_rows() || rows.begin >= rows.end ||
      rows.end > rows.n_global)
    throw std::invalid_argument("the rows of the operator do not fit the grid");
  if (material.periodicity().y && rows.n_local() != rows.n_global)
    throw std::invalid_argument("a grid periodic in y needs all rows on one rank");
}

template <typename Number>
UniformGridOperator::Precision<Number> &UniformGridOperator::precision() const
{
  const auto made = [this](auto &of_this_precision) -> auto &
  {
    if (!of_this_precision)
      of_this_precision = std::make_unique<Precision<Number>>(material, isa);
    return *of_this_precision;
  };
  if constexpr (std::is_same_v<Number, double>)
    return made(in_double);
  else
    return made(in_float);
}

template <typename Number>
void UniformGridOperator::check(const NodalField<Number> &field) const
{
  if (field.n_columns() != material.n_columns() || field.n_rows() != rows.n_local())
    throw std::invalid_argument("a nodal field does not fit the grid of its operator");
}

/**
 * Computes the internal forces of @p src, one or several owned rows at a time, in the
 * rows of @p dst or, if it is null, in the first rows of a scratch field. After each
 * portion it calls @p consume (local row, number of rows, field, row of field).
 */
template <typename Number, typename Consume>
void UniformGridOperator::traverse(NodalField<Number> *dst,
                                   const NodalField<Number> &src,
                                   const Consume &consume) const
{
  check(src);
  Precision<Number> &p       = precision<Number>();
  const unsigned int ny      = material.grid().cells[1];
  const unsigned int at_once = p.kernels.functions.rows_at_once;

  const auto state = [&](const unsigned int j, NodalField<Number> &f,
                         const unsigned int row) {
    kernels::Rows<Number> r;
    // Storing kernels do not write to the state.
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

template <typename Number>
void UniformGridOperator::vmult(NodalField<Number> &dst,
                                const NodalField<Number> &src) const
{
  check(dst);
  traverse(&dst, src, [](unsigned int, unsigned int, const auto &, unsigned int) {});
  if (material.periodicity().y)
    material.update_copies(dst);
}

void UniformGridOperator::diagonal(NodalField<double> &diagonal) const
{
  check(diagonal);
  const UniformGrid<2> &grid = material.grid();
  const unsigned int nx = grid.cells[0], ny = grid.cells[1];
  const bool periodic_y = material.periodicity().y;
  std::vector<Eigen::Matrix<double, 8, 1>> of_phases;
  for (const ElasticPhase<2> &phase : material.phases())
    of_phases.emplace_back(
      cell_stiffness(phase, {{grid.spacing[0], grid.spacing[1]}}).diagonal());
  diagonal.set_zero();
  for (unsigned int j = rows.begin; j < rows.end; ++j)
    {
      double *x = diagonal.row(0, rows.local(j)), *y = diagonal.row(1, rows.local(j));
      for (const bool above : {false, true})
        for (unsigned int i = 0; i < nx && (periodic_y || (above ? j < ny : j > 0)); ++i)
          {
            const unsigned int cell_row = (above ? j : j + ny - 1) % ny;
            const auto &of_cell         = of_phases[material.phase_of(i, cell_row)];
            for (const unsigned int right : {0, 1})
              {
                const Eigen::Index corner = right + (above ? 0 : 2);
                x[i + right] += of_cell[2 * corner];
                y[i + right] += of_cell[2 * corner + 1];
              }
          }
      if (material.periodicity().x)
        for (double *d : {x, y})
          d[0] = d[nx] = d[0] + d[nx];
    }
}

double UniformGridOperator::elastic_energy(const NodalField<double> &u) const
{
  const unsigned int n = material.n_columns() - (material.periodicity().x ? 1 : 0);
  const auto dot       = precision<double>().kernels.functions.dot;
  double sum           = 0.;
  traverse<double>(nullptr, u,
                   [&](const unsigned int row, const unsigned int n_rows,
                       const NodalField<double> &f, const unsigned int at) {
                     for (unsigned int k = 0; k < n_rows; ++k)
                       sum += dot(u.row(0, row + k), f.row(0, at + k), n) +
                              dot(u.row(1, row + k), f.row(1, at + k), n);
                   });
  return 0.5 * sum;
}

void UniformGridOperator::strain(const NodalField<double> &u,
                                 const unsigned int j,
                                 double *exx,
                                 double *eyy,
                                 double *gxy) const
{
  const UniformGrid<2> &grid = material.grid();
  precision<double>().kernels.functions.strain(
    u.row(0, j), u.row(0, j + 1), u.row(1, j) - u.row(0, j), grid.cells[0],
    0.5 / grid.spacing[0], 0.5 / grid.spacing[1], exx, eyy, gxy);
}

template void UniformGridOperator::vmult(NodalField<double> &,
                                         const NodalField<double> &) const;
template void UniformGridOperator::vmult(NodalField<float> &,
                                         const NodalField<float> &) const;
} // namespace mesoslip
