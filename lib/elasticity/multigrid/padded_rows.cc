#include "elasticity/multigrid/padded_rows.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace mesoslip
{
namespace multigrid
{
template <typename Number>
void PaddedRows<Number>::Free::operator()(Number *p) const
{
  std::free(p);
}

template <typename Number>
PaddedRows<Number>::PaddedRows(const unsigned int n_arrays,
                       const unsigned int n_rows,
                       const unsigned int n_columns)
  : arrays(n_arrays)
  , rows(n_rows)
  , columns(n_columns)
  , stride(whole_vectors<Number>(n_columns) + 2 * lanes<Number>)
{
  // An odd number of cache lines keeps equal columns off the same cache set.
  if ((stride / lanes<Number>) % 2 == 0)
    stride += lanes<Number>;
  void *memory = std::aligned_alloc(64, size() * sizeof(Number));
  if (memory == nullptr)
    throw std::bad_alloc();
  data.reset(static_cast<Number *>(memory));
  set_zero();
}

template <typename Number>
void PaddedRows<Number>::set_zero()
{
  std::fill_n(data.get(), size(), Number(0));
}

template <typename Number>
void PaddedRows<Number>::copy_from(const PaddedRows &other)
{
  std::copy_n(other.data.get(), size(), data.get());
}

template <typename Number>
void PaddedRows<Number>::fill_ghosts(const bool x, const bool y)
{
  if (x)
    for (int j = 0; j < static_cast<int>(rows); ++j)
      for (unsigned int k = 0; k < arrays; ++k)
        {
          Number *p   = row(k, j);
          p[-1]      = p[columns - 1];
          p[columns] = p[0];
        }
  if (!y)
    return;
  const int n = static_cast<int>(rows);
  for (unsigned int k = 0; k < arrays; ++k)
    {
      std::copy_n(row(k, n - 1) - 1, columns + 2, row(k, -1) - 1);
      std::copy_n(row(k, 0) - 1, columns + 2, row(k, n) - 1);
    }
}

template class PaddedRows<float>;
template class PaddedRows<double>;
} // namespace multigrid
} // namespace mesoslip
