#ifndef mesoslip_base_serialize_members_h
#define mesoslip_base_serialize_members_h

#include <cstddef>

// Declarations only; files with an archive include base/archives.h. Headers that define
// serialize() therefore do not include Boost.
namespace mesoslip
{
/**
 * For serialize() of a plain struct: saves or restores all its @p n members in the order
 * of declaration. A wrong @p n does not compile, so that no member is forgotten.
 */
template <int n, class Archive, class T>
void serialize_members(Archive &ar, T &object);

/** Saves or restores @p n numbers bytewise. */
template <class Archive, class Number>
void serialize_array(Archive &archive, Number *values, const std::size_t n);
} // namespace mesoslip

#endif
