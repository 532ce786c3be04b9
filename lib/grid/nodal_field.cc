#include "grid/nodal_field.h"

#include <algorithm>

namespace mesoslip
{
template <typename Number>
NodalField<Number>::NodalField(const unsigned int n_columns, const unsigned int n_rows)
  : columns(n_columns)
  , rows(n_rows)
  , row_stride((n_columns + vector_length - 1) / vector_length * vector_length +
               vector_length)
{
  // An odd number of cache lines keeps rows of equal x off the same cache set.
  if ((row_stride / vector_length) % 2 == 0)
    row_stride += vector_length;
  data = line_zeros<Number>(size());
}

template <typename Number>
NodalField<Number>::NodalField(const NodalField &other)
  : NodalField(other.columns, other.rows)
{
  std::copy_n(other.begin(), size(), begin());
}

template <typename Number>
NodalField<Number> &NodalField<Number>::operator=(const NodalField &other)
{
  if (this != &other)
    {
      if (columns != other.columns || rows != other.rows)
        *this = NodalField(other.columns, other.rows);
      std::copy_n(other.begin(), size(), begin());
    }
  return *this;
}

template <typename Number>
void NodalField<Number>::set_zero()
{
  std::fill_n(begin(), size(), Number(0));
}

template class NodalField<double>;
template class NodalField<float>;
} // namespace mesoslip
