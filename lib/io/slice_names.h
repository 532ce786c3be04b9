#ifndef mesoslip_io_slice_names_h
#define mesoslip_io_slice_names_h

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Checks that the order of @p names, sorted byte by byte, agrees with the numbers in
 * them, ignoring case; a minus is a sign if other names have none there. If a single
 * number distinguishes the names, none may be missing or repeated (a constant step above
 * one is allowed).
 * @throws UserError beginning with @p folder
 */
void require_slices_in_order(const std::string &folder,
                             const std::vector<std::string> &names);
} // namespace mesoslip

#endif
