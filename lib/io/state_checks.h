#ifndef mesoslip_io_state_checks_h
#define mesoslip_io_state_checks_h

#include <stdexcept>

namespace mesoslip
{
/** Whether all vectors have as many entries. */
template <typename Vector, typename... Vectors>
bool equally_long(const Vector &first, const Vectors &...others)
{
  return ((others.size() == first.size()) && ...);
}

/** For a serialize(): a loaded state whose parts do not fit together is refused. */
template <class Archive>
void require_when_loading(const Archive &, const bool fits)
{
  if (Archive::is_loading::value && !fits)
    throw std::length_error("the parts of a saved state do not fit together");
}
} // namespace mesoslip

#endif
