#include "elasticity/multigrid/padded_rows.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace mesoslip
{
namespace multigrid
{
void PaddedRows::Free::operator()(float *p) const
{
  std::free(p);
}

PaddedRows::PaddedRows(const unsigned int n_arrays,
                       const unsigned int n_rows,
                       const unsigned int n_columns)
  : arrays(n_arrays)
  , rows(n_rows)
  , columns(n_columns)
  , stride(whole_vectors(n_columns) + 2 * lanes)
{
  // An odd number of cache lines keeps equal columns off the same cache set.
  if ((stride / lanes) % 2 == 0)
    stride += lanes;
  void *memory =
    std::aligned_alloc(64, (rows + 2) * static_cast<std::size_t>(arrays) * stride * 4);
  if (memory == nullptr)
    throw std::bad_alloc();
  data.reset(static_cast<float *>(memory));
  set_zero();
}

void PaddedRows::set_zero()
{
  std::fill_n(data.get(), (rows + 2) * static_cast<std::size_t>(arrays) * stride, 0.F);
}

void PaddedRows::fill_ghosts(const bool x, const bool y)
{
  if (x)
    for (int j = 0; j < static_cast<int>(rows); ++j)
      for (unsigned int k = 0; k < arrays; ++k)
        {
          float *p   = row(k, j);
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
} // namespace multigrid
} // namespace mesoslip
