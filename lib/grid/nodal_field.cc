#include "grid/nodal_field.h"

namespace mesoslip
{
template <typename Number>
NodalField<Number>::NodalField(const unsigned int n_columns,
                               const unsigned int n_rows,
                               const unsigned int n_components)
  : components(n_components)
  , rows(n_rows)
  , columns(n_columns)
  , array_stride(whole_vectors<Number>(n_columns + 1) + 2 * lanes<Number>)
{
  // An odd number of cache lines keeps equal columns off the same cache set.
  if ((array_stride / lanes<Number>) % 2 == 0)
    array_stride += lanes<Number>;
  data.resize((rows + std::size_t(2)) * stride());
}

template <typename Number>
template <typename Other>
void NodalField<Number>::convert_from(const NodalField<Other> &other)
{
  const unsigned int n = columns + 2, end = whole_vectors<Number>(columns) + 1;
  for (int j = -1; j <= static_cast<int>(rows); ++j)
    for (unsigned int c = 0; c < components; ++c)
      {
        const Other *from = other.row(c, j) - 1;
        Number *to        = row(c, j) - 1;
        for (unsigned int i = 0; i < n; ++i)
          to[i] = static_cast<Number>(from[i]);
        for (unsigned int i = n; i < end; ++i)
          to[i] = 0;
      }
}

template <typename Number>
void NodalField<Number>::fill_ghosts(const bool x, const bool y)
{
  if (x)
    for (unsigned int j = 0; j < rows; ++j)
      for (unsigned int c = 0; c < components; ++c)
        {
          Number *p  = row(c, j);
          p[-1]      = p[columns - 1];
          p[columns] = p[0];
        }
  for (unsigned int c = 0; y && c < components; ++c)
    {
      std::copy_n(row(c, rows - 1) - 1, columns + 2, row(c, -1) - 1);
      std::copy_n(row(c, 0) - 1, columns + 2, row(c, rows) - 1);
    }
}

template class NodalField<float>;
template class NodalField<double>;
template void NodalField<float>::convert_from(const NodalField<float> &);
template void NodalField<float>::convert_from(const NodalField<double> &);
template void NodalField<double>::convert_from(const NodalField<float> &);
template void NodalField<double>::convert_from(const NodalField<double> &);
} // namespace mesoslip
