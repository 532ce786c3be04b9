#ifndef mesoslip_io_drafts_h
#define mesoslip_io_drafts_h

#include <string>

namespace mesoslip
{
/**
 * @name Drafts
 * Files like results, in which nothing was computed, for the --validate of later runs. Their
 * header says so; hence Hdf5File::check_header() refuses them, unless they are accepted.
 * The tables (CSV) of a run with --try begin with a line that says it, and CsvTable::read()
 * refuses them.
 * @{
 */

/** Digest in the header of a draft. */
inline constexpr char draft_digest[] = "draft";

/** First line of a CSV file that is a draft. */
inline constexpr char draft_line[] =
  "# draft: made with --try, whose inputs may be drafts in which nothing was computed";

/** From now on this process reads drafts as well. */
void accept_drafts();

/** Whether it does. */
bool drafts_are_accepted();

/**
 * Path of the draft @p name in @p folder, which is created. @throws UserError if there is a
 * file of that name, finished or not: a draft never replaces a result.
 */
std::string path_of_draft(const std::string &folder, const std::string &name);

/** Removes what writing a draft has left unfinished. */
void discard_draft();

/** While one lives, all files that this process begins are drafts. */
class DraftMark
{
public:
  /** Whether what Hdf5File::reserve_rows() makes place for is going to be filled; otherwise it
   * takes no place on the disk and reads as zeros. */
  explicit DraftMark(const bool is_filled);
  ~DraftMark();
  DraftMark(const DraftMark &)            = delete;
  DraftMark &operator=(const DraftMark &) = delete;

  /** Whether there is one. */
  static bool is_set();

  /** Whether there is one of files that are not filled. */
  static bool leaves_empty();
};
/** @} */
} // namespace mesoslip

#endif
