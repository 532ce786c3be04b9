#ifndef mesoslip_io_slice_names_h
#define mesoslip_io_slice_names_h

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Compares the order of @p names, sorted byte by byte, with the numbers in them: capitals count as
 * small letters, and a minus as a sign where other names have none there. Where one number alone
 * tells the names apart, none may be missing or there twice; steps of all may be larger than one.
 * @throws UserError beginning with @p folder
 */
void require_slices_in_order(const std::string &folder,
                             const std::vector<std::string> &names);
} // namespace mesoslip

#endif
