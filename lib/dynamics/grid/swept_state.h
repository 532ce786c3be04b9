#ifndef mesoslip_dynamics_grid_swept_state_h
#define mesoslip_dynamics_grid_swept_state_h

#include "grid/nodal_field.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace mesoslip
{
/**
 * Displacements and velocities of a body as the sweeps over its rows have them: in double
 * precision the fields themselves, in single precision copies of them, which load() and
 * save() bring up to date where something else writes or reads rows. Rows have local
 * numbers. Internal to TemporalBlocking.
 */
template <typename Number>
class SweptState
{
public:
  /** @p u (m) and @p w (m/s) must outlive it. */
  SweptState(NodalField<double> &u, NodalField<double> &w)
    : of_body{{&u, &w}}
  {
    if constexpr (is_copy)
      for (unsigned int field = 0; field < 2; ++field)
        copies[field] = NodalField<Number>(u.n_columns(), u.n_rows());
  }

  /** Component @p c of the displacements (m) of a row. */
  Number *u(const unsigned int c, const unsigned int row)
  {
    return swept(0).row(c, row);
  }

  /** Component @p c of the velocities of the scheme (m/s) of a row. */
  Number *w(const unsigned int c, const unsigned int row)
  {
    return swept(1).row(c, row);
  }

  /** Numbers from one row to the next. */
  std::size_t stride()
  {
    return swept(0).stride();
  }

  /** Copies @p n columns from @p column on of @p n_rows rows from the fields of the body. */
  void load(const unsigned int row,
            const unsigned int n_rows,
            const unsigned int column,
            const unsigned int n)
  {
    for_each_copy(*this, row, n_rows, [&](const double *of_body, Number *copy) {
      std::transform(of_body + column, of_body + column + n, copy + column,
                     [](const double x) { return static_cast<Number>(x); });
    });
  }

  /** Copies them to the fields of the body. */
  void save(const unsigned int row,
            const unsigned int n_rows,
            const unsigned int column,
            const unsigned int n)
  {
    for_each_copy(*this, row, n_rows, [&](double *of_body, const Number *copy) {
      std::copy_n(copy + column, n, of_body + column);
    });
  }

  /** Whether load() of @p n_rows rows with @p n columns would change nothing. */
  bool is_current(const unsigned int row,
                  const unsigned int n_rows,
                  const unsigned int n) const
  {
    bool same = true;
    for_each_copy(*this, row, n_rows, [&](const double *of_body, const Number *copy) {
      same = same && std::equal(copy, copy + n, of_body,
                                [](const Number of_copy, const double x) {
                                  return of_copy == static_cast<Number>(x);
                                });
    });
    return same;
  }

private:
  static constexpr bool is_copy = !std::is_same_v<Number, double>;

  NodalField<Number> &swept(const unsigned int field)
  {
    if constexpr (is_copy)
      return copies[field];
    else
      return *of_body[field];
  }

  /** Calls @p action with each component of the rows and its copy, if there are copies. */
  template <typename Self, typename Action>
  static void for_each_copy(Self &self,
                            const unsigned int row,
                            const unsigned int n_rows,
                            const Action &action)
  {
    for (unsigned int l = row; is_copy && l < row + n_rows; ++l)
      for (unsigned int field = 0; field < 2; ++field)
        for (unsigned int c = 0; c < 2; ++c)
          action(self.of_body[field]->row(c, l), self.copies[field].row(c, l));
  }

  const std::array<NodalField<double> *, 2> of_body;
  std::array<NodalField<Number>, 2> copies;
};
} // namespace mesoslip

#endif
