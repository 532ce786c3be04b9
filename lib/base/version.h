#ifndef mesoslip_base_version_h
#define mesoslip_base_version_h

namespace mesoslip
{
/** Version of the programs, the same as in CMakeLists.txt. */
constexpr const char *version = "0.2.0";
} // namespace mesoslip

#endif
