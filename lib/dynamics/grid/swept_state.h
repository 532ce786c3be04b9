#ifndef mesoslip_dynamics_grid_swept_state_h
#define mesoslip_dynamics_grid_swept_state_h

#include "grid/halo.h"
#include "grid/nodal_field.h"

#include <algorithm>
#include <array>

namespace mesoslip
{
/**
 * Displacements and velocities of a body as the sweeps over its rows have them: in single
 * precision copies of the fields, which are brought up to date where something else reads or
 * writes rows. Rows have local numbers. Internal to TemporalBlocking.
 */
template <typename Number>
class SweptState
{
public:
  /** @p u (m) and @p w (m/s) must outlive it. */
  SweptState(NodalField<double> &u, NodalField<double> &w)
    : of_body{{&u, &w}}
    , copies{{{u.n_columns(), u.n_rows()}, {u.n_columns(), u.n_rows()}}}
  {
  }

  /** Component @p c of the displacements (m) of a row. */
  Number *u(const unsigned int c, const unsigned int row)
  {
    return copies[0].row(c, row);
  }

  /** Component @p c of the velocities of the scheme (m/s) of a row. */
  Number *w(const unsigned int c, const unsigned int row)
  {
    return copies[1].row(c, row);
  }

  /** Numbers from one row to the next. */
  std::size_t stride() const
  {
    return copies[0].stride();
  }

  /** Takes @p n columns from @p column on of @p n_rows rows from the fields of the body. */
  void load(const unsigned int row,
            const unsigned int n_rows,
            const unsigned int column,
            const unsigned int n)
  {
    for_each_piece(row, n_rows, [&](const double *of_body, Number *copy) {
      std::transform(of_body + column, of_body + column + n, copy + column,
                     [](const double x) { return static_cast<Number>(x); });
    });
  }

  /** Writes them there. */
  void save(const unsigned int row,
            const unsigned int n_rows,
            const unsigned int column,
            const unsigned int n)
  {
    for_each_piece(row, n_rows, [&](double *of_body, const Number *copy) {
      std::copy_n(copy + column, n, of_body + column);
    });
  }

  /** Whether load() of @p n_rows rows with @p n columns would change nothing. */
  bool is_current(const unsigned int row,
                  const unsigned int n_rows,
                  const unsigned int n) const
  {
    bool same = true;
    for (unsigned int l = row; l < row + n_rows; ++l)
      for (unsigned int field = 0; field < 2; ++field)
        for (unsigned int c = 0; c < 2; ++c)
          same =
            same &&
            std::equal(of_body[field]->row(c, l), of_body[field]->row(c, l) + n,
                       copies[field].row(c, l), [](const double x, const Number copy) {
                         return static_cast<Number>(x) == copy;
                       });
    return same;
  }

private:
  template <typename Action>
  void
  for_each_piece(const unsigned int row, const unsigned int n_rows, const Action &action)
  {
    for (unsigned int l = row; l < row + n_rows; ++l)
      for (unsigned int field = 0; field < 2; ++field)
        for (unsigned int c = 0; c < 2; ++c)
          action(of_body[field]->row(c, l), copies[field].row(c, l));
  }

  const std::array<NodalField<double> *, 2> of_body;
  std::array<NodalField<Number>, 2> copies;
};

/** In double precision the fields of the body themselves. */
template <>
class SweptState<double>
{
public:
  /** @p u (m) and @p w (m/s) must outlive it. */
  SweptState(NodalField<double> &u, NodalField<double> &w)
    : of_body{{&u, &w}}
  {
  }

  /** Component @p c of the displacements (m) of a row. */
  double *u(const unsigned int c, const unsigned int row)
  {
    return of_body[0]->row(c, row);
  }

  /** Component @p c of the velocities of the scheme (m/s) of a row. */
  double *w(const unsigned int c, const unsigned int row)
  {
    return of_body[1]->row(c, row);
  }

  /** Numbers from one row to the next. */
  std::size_t stride() const
  {
    return of_body[0]->stride();
  }

  /** Nothing: there is no copy. */
  void load(unsigned int, unsigned int, unsigned int, unsigned int)
  {
  }

  /** Nothing: there is no copy. */
  void save(unsigned int, unsigned int, unsigned int, unsigned int)
  {
  }

  /** True: there is no copy. */
  bool is_current(unsigned int, unsigned int, unsigned int) const
  {
    return true;
  }

private:
  const std::array<NodalField<double> *, 2> of_body;
};
} // namespace mesoslip

#endif
