#ifndef mesoslip_base_serialize_members_h
#define mesoslip_base_serialize_members_h

#include <cstddef>

// Declarations alone: whoever has an archive includes base/archives.h, so that headers with a serialize() do not bring Boost.
namespace mesoslip
{
/**
 * For the serialize() of a plain struct: saves or restores all its @p n members, in the
 * order of their declaration. Another number than there are members does not compile, so
 * that a member that is added cannot be forgotten.
 */
template <int n, class Archive, class T>
void serialize_members(Archive &ar, T &object);

/** Saves or restores @p n numbers, as they are in memory. */
template <class Archive, class Number>
void serialize_array(Archive &archive, Number *values, const std::size_t n);
} // namespace mesoslip

#endif
