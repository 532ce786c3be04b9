#ifndef mesoslip_statics_voxel_packed_field_h
#define mesoslip_statics_voxel_packed_field_h

#include "statics/voxel/voxel_field.h"

#include <cstdint>
#include <vector>

namespace mesoslip::voxel
{
/**
 * A field stored in six instead of eight bytes per number: whole multiples of 2^-47 of
 * the largest absolute value on this rank (relative error 1e-14 of it, whereas a
 * six-byte double would have 4e-12 of each number). Rows include ghosts, but no padding.
 */
class PackedField
{
public:
  PackedField() = default;

  /** Packs @p field, whose ghosts are set.
   * @throws std::invalid_argument for numbers that are not finite */
  explicit PackedField(const VoxelField<double> &field);

  /** The numbers of VoxelField::row() from the first ghost to the last, n_in_row() of them. */
  void read_row(const unsigned int c,
                const unsigned int j,
                const unsigned int k,
                double *out) const;

  /** Length of a row: nodes along x and two ghosts. */
  std::size_t n_in_row() const
  {
    return n_row;
  }

  /** Whether no field is packed. */
  bool empty() const
  {
    return high.empty();
  }

private:
  VoxelGrid grid;
  std::size_t n_row = 0; ///< including ghosts
  double unit       = 0.;
  LineVector<std::int32_t> high; ///< multiples of 65536
  LineVector<std::uint16_t> low; ///< remainders below 65536
};
} // namespace mesoslip::voxel

#endif
