#ifndef mesoslip_statics_voxel_packed_field_h
#define mesoslip_statics_voxel_packed_field_h

#include "statics/voxel/voxel_field.h"

#include <cstdint>
#include <vector>

namespace mesoslip::voxel
{
/**
 * A field to keep, in six bytes a number instead of eight: whole multiples of 2^-47 of the
 * largest absolute value on this rank, which is 1e-14 of it, whereas a double of six bytes
 * would have 4e-12 of each number. Rows have their ghosts, but no padding.
 */
class PackedField
{
public:
  PackedField() = default;

  /** Of @p field, whose ghosts are set. @throws std::invalid_argument for numbers that are
   *  not finite */
  explicit PackedField(const VoxelField<double> &field);

  /** The numbers of VoxelField::row() from the first ghost to the last, n_in_row() of them. */
  void read_row(const unsigned int c,
                const unsigned int j,
                const unsigned int k,
                double *out) const;

  /** Nodes along x and two ghosts. */
  std::size_t n_in_row() const
  {
    return n_row;
  }

  /** Whether nothing has been packed. */
  bool empty() const
  {
    return high.empty();
  }

private:
  VoxelGrid grid;
  std::size_t n_row = 0; ///< with ghosts
  double unit       = 0.;
  LineVector<std::int32_t> high; ///< multiples of 65536
  LineVector<std::uint16_t> low; ///< what is left
};
} // namespace mesoslip::voxel

#endif
