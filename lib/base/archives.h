#ifndef mesoslip_base_archives_h
#define mesoslip_base_archives_h

#include "base/serialize_members.h"

#include <Eigen/Core>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/array_wrapper.hpp>
#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <type_traits>

namespace boost::serialization
{
/** Saves or restores a fixed-size matrix entry by entry. */
template <class Archive, int n_rows, int n_columns, int options>
void serialize(
  Archive &archive,
  Eigen::Matrix<double, n_rows, n_columns, options, n_rows, n_columns> &matrix,
  const unsigned int)
{
  for (int k = 0; k < n_rows * n_columns; ++k)
    archive &matrix.data()[k];
}
} // namespace boost::serialization

namespace mesoslip
{
namespace internal
{
/**
 * Saves or restores one member; trivially copyable structs and arrays are stored
 * bytewise.
 */
template <class Archive, class T>
void serialize_member(Archive &archive, T &member)
{
  static_assert(!std::is_pointer_v<T>, "addresses mean nothing to another process");
  if constexpr (std::is_trivially_copyable_v<T> && !std::is_arithmetic_v<T> &&
                !std::is_enum_v<T>)
    {
      auto bytes = boost::serialization::make_binary_object(&member, sizeof(T));
      archive &bytes;
    }
  else
    archive &member;
}

/** Saves or restores @p members in their order. */
template <class Archive, class... T>
void serialize_each(Archive &archive, T &...members)
{
  (serialize_member(archive, members), ...);
}
} // namespace internal

template <int n, class Archive, class T>
void serialize_members(Archive &ar, T &object)
{
  static_assert(1 <= n && n <= 14, "add a line below");
  // A structured binding names every member, or it does not compile.
#define MESOSLIP_MEMBERS(number, ...)            \
  if constexpr (n == number)                     \
    {                                            \
      auto &[__VA_ARGS__] = object;              \
      internal::serialize_each(ar, __VA_ARGS__); \
    }
  MESOSLIP_MEMBERS(1, a)
  MESOSLIP_MEMBERS(2, a, b)
  MESOSLIP_MEMBERS(3, a, b, c)
  MESOSLIP_MEMBERS(4, a, b, c, d)
  MESOSLIP_MEMBERS(5, a, b, c, d, e)
  MESOSLIP_MEMBERS(6, a, b, c, d, e, f)
  MESOSLIP_MEMBERS(7, a, b, c, d, e, f, g)
  MESOSLIP_MEMBERS(8, a, b, c, d, e, f, g, h)
  MESOSLIP_MEMBERS(9, a, b, c, d, e, f, g, h, i)
  MESOSLIP_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
  MESOSLIP_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
  MESOSLIP_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
  MESOSLIP_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
  MESOSLIP_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, o)
#undef MESOSLIP_MEMBERS
}

template <class Archive, class Number>
void serialize_array(Archive &archive, Number *values, const std::size_t n)
{
  auto array = boost::serialization::make_array(values, n);
  archive &array;
}
} // namespace mesoslip

#endif
