#ifndef mesoslip_base_serialize_members_h
#define mesoslip_base_serialize_members_h

#include <Eigen/Core>

#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <type_traits>

namespace boost::serialization
{
/** Small matrices, by their entries. */
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
/** Saves or restores one member; plain structs and their arrays as they are in memory. */
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

/**
 * For the serialize() of a plain struct: saves or restores all its @p n members, in the
 * order of their declaration. Another number than there are members does not compile, so
 * that a member that is added cannot be forgotten.
 */
template <int n, class Archive, class T>
void serialize_members(Archive &ar, T &object)
{
  static_assert(1 <= n && n <= 12, "add a line below");
  using internal::serialize_each;
  // A structured binding names every member, or it does not compile.
  if constexpr (n == 1)
    {
      auto &[a] = object;
      serialize_each(ar, a);
    }
  else if constexpr (n == 2)
    {
      auto &[a, b] = object;
      serialize_each(ar, a, b);
    }
  else if constexpr (n == 3)
    {
      auto &[a, b, c] = object;
      serialize_each(ar, a, b, c);
    }
  else if constexpr (n == 4)
    {
      auto &[a, b, c, d] = object;
      serialize_each(ar, a, b, c, d);
    }
  else if constexpr (n == 5)
    {
      auto &[a, b, c, d, e] = object;
      serialize_each(ar, a, b, c, d, e);
    }
  else if constexpr (n == 6)
    {
      auto &[a, b, c, d, e, f] = object;
      serialize_each(ar, a, b, c, d, e, f);
    }
  else if constexpr (n == 7)
    {
      auto &[a, b, c, d, e, f, g] = object;
      serialize_each(ar, a, b, c, d, e, f, g);
    }
  else if constexpr (n == 8)
    {
      auto &[a, b, c, d, e, f, g, h] = object;
      serialize_each(ar, a, b, c, d, e, f, g, h);
    }
  else if constexpr (n == 9)
    {
      auto &[a, b, c, d, e, f, g, h, i] = object;
      serialize_each(ar, a, b, c, d, e, f, g, h, i);
    }
  else if constexpr (n == 10)
    {
      auto &[a, b, c, d, e, f, g, h, i, j] = object;
      serialize_each(ar, a, b, c, d, e, f, g, h, i, j);
    }
  else if constexpr (n == 11)
    {
      auto &[a, b, c, d, e, f, g, h, i, j, k] = object;
      serialize_each(ar, a, b, c, d, e, f, g, h, i, j, k);
    }
  else if constexpr (n == 12)
    {
      auto &[a, b, c, d, e, f, g, h, i, j, k, l] = object;
      serialize_each(ar, a, b, c, d, e, f, g, h, i, j, k, l);
    }
}
} // namespace mesoslip

#endif
