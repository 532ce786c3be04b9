#ifndef mesoslip_io_hdf5_internal_h
#define mesoslip_io_hdf5_internal_h

#include "io/hdf5_file.h"

#include "io/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <hdf5.h>
#include <string>
#include <type_traits>
#include <vector>

// Only for the sources of Hdf5File: the HDF5 library's names stay here.
namespace mesoslip
{
namespace hdf5
{
/**
 * From now on nothing is closed any more: the library (1.10) crashes when it closes a
 * file that it cannot write to, also in its own exit handlers.
 */
void abandon();
bool abandoned();

/**
 * While the library reads a file: should it crash, the process ends at once with a
 * sentence that names the file and with ExitStatus::user_error. What of a damaged file is
 * known to make it crash is not given to it (structure.h, FixedStrings); this is for
 * the rest. Of several, one within another, the outermost counts.
 */
class CrashGuard
{
public:
  explicit CrashGuard(const std::string &path);
  CrashGuard(const CrashGuard &) = delete;
  ~CrashGuard();

private:
  static constexpr std::array<int, 4> crashes = {{SIGSEGV, SIGBUS, SIGFPE, SIGABRT}};

  const std::string own;
  bool outermost                                      = false;
  std::array<struct sigaction, crashes.size()> before = {};
};

/** Closes whatever an HDF5 identifier stands for. */
class Handle
{
public:
  explicit Handle(const hid_t identifier = -1)
    : id(identifier)
  {
  }
  Handle(Handle &&other) noexcept
    : id(other.id)
  {
    other.id = -1;
  }
  Handle(const Handle &) = delete;
  ~Handle()
  {
    if (id >= 0 && !abandoned())
      H5Idec_ref(id);
  }
  operator hid_t() const
  {
    return id;
  }
  bool valid() const
  {
    return id >= 0;
  }
  /** Gives up ownership. */
  hid_t release()
  {
    const hid_t released = id;
    id                   = -1;
    return released;
  }

private:
  hid_t id;
};

/** The type of T in memory. */
template <typename T>
hid_t native_type();

template <>
inline hid_t native_type<double>()
{
  return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t native_type<float>()
{
  return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t native_type<int>()
{
  return H5T_NATIVE_INT;
}
template <>
inline hid_t native_type<unsigned int>()
{
  return H5T_NATIVE_UINT;
}
template <>
inline hid_t native_type<std::int64_t>()
{
  return H5T_NATIVE_INT64;
}
template <>
inline hid_t native_type<std::uint64_t>()
{
  return H5T_NATIVE_UINT64;
}
template <>
inline hid_t native_type<std::uint8_t>()
{
  return H5T_NATIVE_UINT8;
}

inline std::vector<hsize_t> dims(const Shape &shape)
{
  return std::vector<hsize_t>(shape.begin(), shape.end());
}

inline std::size_t product(const Shape &shape)
{
  std::size_t n = 1;
  for (const std::size_t extent : shape)
    n *= extent;
  return n;
}

/** Position of the first of @p n values that is not finite; n if all are. */
template <typename T>
std::size_t find_not_finite(const T *values, const std::size_t n)
{
  if constexpr (std::is_floating_point<T>::value)
    return static_cast<std::size_t>(
      std::find_if(values, values + n, [](const T x) { return !std::isfinite(x); }) -
      values);
  else
    return n;
}

/** @throws NumericalFailure if @p object of the file @p path would get such a value. */
template <typename T>
void require_finite(const std::string &path,
                    const std::string &object,
                    const T *values,
                    const std::size_t n)
{
  const std::size_t position = find_not_finite(values, n);
  if (position < n)
    throw NumericalFailure(path + ": " + object +
                           " would hold a value that is not finite, at position " +
                           std::to_string(position) + " of " + std::to_string(n) +
                           "; look for an input that is far too large, and at its unit");
}

/** A simple dataspace, or a scalar one for an empty shape. */
Handle make_space(const Shape &shape);

/**
 * Texts as they are stored: UTF-8 of fixed length, filled up with zeros. Not of variable
 * length: these lie in a heap of which the library (1.10) checks nothing, so that a
 * damaged file makes it crash, hang or write beyond its memory.
 */
struct FixedStrings
{
  /** Of the length of the longest one. */
  explicit FixedStrings(const std::vector<std::string> &strings);

  Handle type;            ///< of one text
  std::string characters; ///< of all texts, one after the other
};

/**
 * Number of values of the extents, false if a file of that size cannot hold as many
 * bytes: a damaged or hostile file must not make us ask for all memory. Deflate shrinks
 * to 1/1032 at best; a few megabytes are never too many. @p object: anything in the file.
 */
bool count_values(const hid_t object,
                  const std::vector<hsize_t> &extents,
                  const std::size_t value_bytes,
                  std::size_t &n);

/** The extents of a dataspace, empty for a scalar; false for one without or if damaged.
 */
bool read_extents(const hid_t space, std::vector<hsize_t> &extents);

/** All strings of a dataset or attribute; false on failure, or if they are not of fixed
 *  length (FixedStrings). */
bool read_all_strings(const hid_t object,
                      const bool attribute,
                      std::vector<std::string> &strings);
} // namespace hdf5
} // namespace mesoslip

#endif
