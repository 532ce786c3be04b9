#include "statics/voxel/packed_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mesoslip::voxel
{
namespace
{
constexpr double largest_multiple = 140737488355327.; // 2^47 - 1
}

PackedField::PackedField(const VoxelField<double> &field)
  : grid(field.grid())
  , n_row(std::size_t{field.n_nodes()[0]} + 2)
  , high(grid.n_components() * n_row * grid.n_node_rows())
  , low(high.size())
{
  const auto &n      = field.n_nodes();
  const auto for_row = [&](const auto &action) {
    std::size_t first = 0;
    for (unsigned int k = 0; k <= n[2] + 1; ++k)
      for (unsigned int j = 0; j < grid.node_rows_in_plane(); ++j)
        for (unsigned int c = 0; c < grid.n_components(); ++c, first += n_row)
          action(field.row(c, j, k), first);
  };
  double largest = 0.;
  bool is_finite = true;
  for_row([&](const double *row, const std::size_t) {
    for (std::size_t i = 0; i < n_row; ++i)
      {
        largest   = std::max(largest, std::abs(row[i]));
        is_finite = is_finite && std::isfinite(row[i]);
      }
  });
  if (!is_finite)
    throw std::invalid_argument("A field that is not finite cannot be packed.");
  unit = largest / largest_multiple;
  if (unit < std::numeric_limits<double>::min())
    return; // zeros
  for_row([&](const double *row, const std::size_t first) {
    for (std::size_t i = 0; i < n_row; ++i)
      {
        const std::int64_t multiple = std::llrint(row[i] / unit);
        high[first + i]             = static_cast<std::int32_t>(multiple >> 16);
        low[first + i]              = static_cast<std::uint16_t>(multiple & 0xffff);
      }
  });
}

void PackedField::read_row(const unsigned int c,
                           const unsigned int j,
                           const unsigned int k,
                           double *out) const
{
  const std::size_t first = (grid.node_row(j, k) * grid.n_components() + c) * n_row;
  for (std::size_t i = 0; i < n_row; ++i)
    out[i] = (high[first + i] * 65536. + low[first + i]) * unit;
}
} // namespace mesoslip::voxel
