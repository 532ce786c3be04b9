#ifndef mesoslip_io_hdf5_internal_h
#define mesoslip_io_hdf5_internal_h

#include "io/hdf5_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <hdf5.h>
#include <type_traits>
#include <vector>

// Internal to the sources of Hdf5File: keeps the names of the HDF5 library out of other
// headers.
namespace mesoslip
{
/** Bytes at the beginning of a signed file reserved for the signature line; a user block
 * of HDF5. */
constexpr std::size_t signature_bytes = 512;

/**
 * Writes "FORMAT xxh3-128 CHECKSUM" and a line feed into the first bytes of @p path,
 * which are reserved for it: the 128 bit XXH3 checksum of all bytes after
 * signature_bytes, in 32 hexadecimal digits. It detects accidental changes only.
 * @throws UserError if the file cannot be read or written.
 */
void sign_file(const std::string &path, const std::string &format);

/** Writes @p line temporarily in place of the signature.
 * @throws UserError. */
void write_first_line(const std::string &path, const std::string &line);

/** The line last written by write_first_line() or sign_file(); empty if none was. */
std::string first_line(const std::string &path);

/** Compares a file with its signature.
 * @throws UserError if it cannot be read. */
Signature check_signature(const std::string &path);

namespace hdf5
{
/** Makes Hdf5File::writing_has_failed() true from now on. */
void note_failed_writing();

/** Describes missing or short files that hold the numbers of @p dataset of the file
 * @p path (virtual and external datasets); HDF5 would read zeros. Empty: none. */
std::string missing_numbers(const std::string &path, const hid_t dataset);

/** HDF5 type of the numbers T in memory. */
template <typename T>
hid_t native_type()
{
  static_assert(std::is_arithmetic_v<T>, "no type of numbers");
  if constexpr (std::is_floating_point_v<T>)
    return sizeof(T) == 4 ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_signed_v<T>)
    return sizeof(T) == 4 ? H5T_NATIVE_INT32 : H5T_NATIVE_INT64;
  else
    return sizeof(T) == 1   ? H5T_NATIVE_UINT8
           : sizeof(T) == 2 ? H5T_NATIVE_UINT16
           : sizeof(T) == 4 ? H5T_NATIVE_UINT32
                            : H5T_NATIVE_UINT64;
}

/** A shape as a vector of hsize_t. */
inline std::vector<hsize_t> dims(const Shape &shape)
{
  return std::vector<hsize_t>(shape.begin(), shape.end());
}

/** Number of values of a shape. */
inline std::size_t product(const Shape &shape)
{
  std::size_t n = 1;
  for (const std::size_t extent : shape)
    n *= extent;
  return n;
}

/** A simple dataspace, or a scalar one for an empty shape. */
inline Hdf5Handle make_space(const Shape &shape)
{
  return Hdf5Handle(shape.empty() ? H5Screate(H5S_SCALAR)
                                  : H5Screate_simple(static_cast<int>(shape.size()),
                                                     dims(shape).data(), nullptr));
}

/** The dataspace of @p dataset with a block selected: @p count values from @p offset
 * along each axis. */
inline Hdf5Handle
select_block(const hid_t dataset, const Shape &offset, const Shape &count)
{
  Hdf5Handle space(H5Dget_space(dataset));
  H5Sselect_hyperslab(space, H5S_SELECT_SET, dims(offset).data(), nullptr,
                      dims(count).data(), nullptr);
  return space;
}

/** "a value that is not finite, at position 3 of 7", or empty if all are finite. */
template <typename T>
std::string not_finite(const T *values, const std::size_t n)
{
  if constexpr (std::is_floating_point_v<T>)
    {
      const T *found =
        std::find_if(values, values + n, [](const T x) { return !std::isfinite(x); });
      if (found != values + n)
        return "a value that is not finite, at position " +
               std::to_string(found - values) + " of " + std::to_string(n);
    }
  return "";
}

/** Whether T is a std::vector of values. */
template <typename T>
constexpr bool is_vector = false;
template <typename T>
constexpr bool is_vector<std::vector<T>> = true;

/** Number of values of a T that is a std::array of values; 0 for any other T. */
template <typename T>
constexpr std::size_t array_size = 0;
template <typename T, std::size_t n>
constexpr std::size_t array_size<std::array<T, n>> = n;

/** Name of a dataset in messages. */
inline std::string dataset_text(const std::string &name)
{
  return "the dataset " + name;
}

/** Name of an attribute in messages. */
inline std::string attribute_text(const std::string &object, const std::string &name)
{
  return "the attribute '" + name + "' of " + object;
}

} // namespace hdf5
} // namespace mesoslip

/** DO(T) for each type that datasets and attributes may have. */
#define MESOSLIP_HDF5_TYPES(DO) \
  DO(double)                    \
  DO(float)                     \
  DO(int)                       \
  DO(unsigned int)              \
  DO(std::int64_t) DO(std::uint64_t) DO(std::uint8_t) DO(std::uint16_t) DO(std::string)

#endif
