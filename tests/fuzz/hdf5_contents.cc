#include "hdf5_contents.h"

#include <algorithm>

namespace mesoslip_tests
{
hid_t some_type(Choices &choices)
{
  static const hid_t numbers[] = {H5T_NATIVE_DOUBLE, H5T_NATIVE_FLOAT, H5T_NATIVE_INT,
                                  H5T_NATIVE_UINT,   H5T_NATIVE_UINT8, H5T_NATIVE_INT64,
                                  H5T_NATIVE_UINT64, H5T_IEEE_F64BE,   H5T_STD_I32BE,
                                  H5T_STD_REF_OBJ};
  const unsigned int kind      = choices.below(16);
  if (kind < 10)
    return H5Tcopy(numbers[kind]);
  hid_t type = -1;
  if (kind == 10)
    type = H5Tcreate(H5T_OPAQUE, 1 + choices.below(16));
  else if (kind == 11)
    {
      type = H5Tcreate(H5T_COMPOUND, 16);
      H5Tinsert(type, "a", 0, H5T_NATIVE_DOUBLE);
      H5Tinsert(type, "b", 8, H5T_NATIVE_INT);
    }
  else if (kind == 12)
    type = H5Tenum_create(H5T_NATIVE_INT);
  else if (kind == 13)
    type = H5Tvlen_create(H5T_NATIVE_DOUBLE);
  else
    {
      type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, kind == 14 ? H5T_VARIABLE : 1 + choices.below(8));
    }
  return type;
}

Space some_space(Choices &choices)
{
  static const hsize_t extents[] = {
    0, 1, 2, 3, 4, 5, 7, 64, 1000000, hsize_t(1) << 32, hsize_t(1) << 62};
  Space space;
  const unsigned int rank = choices.below(7);
  if (rank == 6)
    space.id = H5Screate(H5S_NULL);
  else if (rank == 0)
    {
      space.id     = H5Screate(H5S_SCALAR);
      space.values = 1;
    }
  else
    {
      double n = 1.;
      for (unsigned int axis = 0; axis < rank; ++axis)
        {
          // Mostly small ones: what is larger than the file is refused at once.
          space.extents.push_back(
            extents[choices.below(16) % 11 % (choices.byte() < 32 ? 11 : 8)]);
          n *= static_cast<double>(space.extents.back());
        }
      space.id = H5Screate_simple(static_cast<int>(rank), space.extents.data(), nullptr);
      space.values =
        n < 1e5 ? static_cast<std::size_t>(n) : 0; // the others stay unwritten
    }
  return space;
}

std::vector<char> some_values(Choices &choices, const hid_t type, const std::size_t n)
{
  std::vector<char> bytes(n * std::max<std::size_t>(H5Tget_size(type), 1),
                          static_cast<char>(choices.byte()));
  for (std::size_t i = choices.below(64); i < bytes.size() && !choices.empty();
       i += 1 + choices.below(8))
    bytes[i] = static_cast<char>(choices.byte());
  return bytes;
}

bool holds_addresses(const hid_t type)
{
  return H5Tget_class(type) == H5T_VLEN || H5Tis_variable_str(type) > 0;
}
} // namespace mesoslip_tests
