#include "grid/padded_rows.h"

#include <algorithm>

namespace mesoslip
{
template <typename Number>
PaddedRows<Number>::PaddedRows(const unsigned int n_arrays,
                               const unsigned int n_rows,
                               const unsigned int n_columns)
  : arrays(n_arrays)
  , rows(n_rows)
  , columns(n_columns)
  , stride(whole_vectors<Number>(n_columns + 1) + 2 * lanes<Number>)
{
  // An odd number of cache lines keeps equal columns off the same cache set.
  if ((stride / lanes<Number>) % 2 == 0)
    stride += lanes<Number>;
  data = line_zeros<Number>(size());
}

template <typename Number>
void PaddedRows<Number>::set_zero()
{
  std::fill_n(data.get(), size(), Number(0));
}

template <typename Number>
template <typename Other>
void PaddedRows<Number>::convert_from(const PaddedRows<Other> &other)
{
  for (int j = -1; j <= static_cast<int>(rows); ++j)
    for (unsigned int k = 0; k < arrays; ++k)
      {
        const Other *from    = other.row(k, j) - 1;
        Number *to           = row(k, j) - 1;
        const unsigned int n = columns + 2, end = whole_vectors<Number>(columns) + 1;
        for (unsigned int i = 0; i < n; ++i)
          to[i] = static_cast<Number>(from[i]);
        for (unsigned int i = n; i < end; ++i)
          to[i] = 0;
      }
}

template <typename Number>
void PaddedRows<Number>::fill_ghosts(const bool x, const bool y)
{
  if (x)
    for (int j = 0; j < static_cast<int>(rows); ++j)
      for (unsigned int k = 0; k < arrays; ++k)
        {
          Number *p  = row(k, j);
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
template void PaddedRows<float>::convert_from(const PaddedRows<float> &);
template void PaddedRows<float>::convert_from(const PaddedRows<double> &);
template void PaddedRows<double>::convert_from(const PaddedRows<float> &);
template void PaddedRows<double>::convert_from(const PaddedRows<double> &);
} // namespace mesoslip
