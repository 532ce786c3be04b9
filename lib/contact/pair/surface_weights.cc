#include "contact/pair/surface_weights.h"

#include <cmath>

namespace mesoslip
{
SparseRows SparseRows::transposed(const std::size_t n_columns) const
{
  SparseRows result;
  result.start.assign(n_columns + 1, 0);
  for (const Entry &entry : entries)
    ++result.start[entry.column + 1];
  for (std::size_t j = 0; j < n_columns; ++j)
    result.start[j + 1] += result.start[j];
  result.entries.resize(entries.size());
  std::vector<std::size_t> next(result.start.begin(), result.start.end() - 1);
  for (unsigned int k = 0; k < n_rows(); ++k)
    for (std::size_t e = start[k]; e < start[k + 1]; ++e)
      result.entries[next[entries[e].column]++] = {k, entries[e].weight};
  return result;
}

std::vector<double> SurfaceWeights::reach() const
{
  std::vector<double> sums(columns.n_rows());
  for (std::size_t j = 0; j < sums.size(); ++j)
    for (std::size_t e = columns.start[j]; e < columns.start[j + 1]; ++e)
      sums[j] += std::fabs(columns.entries[e].weight);
  return sums;
}
} // namespace mesoslip
