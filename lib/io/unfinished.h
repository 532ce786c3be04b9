#ifndef mesoslip_io_unfinished_h
#define mesoslip_io_unfinished_h

#include <string>

namespace mesoslip
{
/**
 * A run replaces the results in its folder when it has all of its own. Until then the
 * parameters and the log there are of the new run and the results of an earlier one; if
 * it fails, for good. A file `unfinished.txt` lists those results meanwhile.
 */
constexpr char unfinished_name[] = "unfinished.txt";

/** Lists the results (.h5, .csv, .xdmf) in @p folder, if there are any. @throws UserError
 */
void mark_unfinished(const std::string &folder);

/** The results in @p folder are those of the run: the list goes. */
void unmark_unfinished(const std::string &folder);

/**
 * Throws a UserError beginning with @p what if @p path, an input, is among the results
 * that the list in its folder names.
 */
void require_finished(const std::string &what, const std::string &path);
} // namespace mesoslip

#endif
