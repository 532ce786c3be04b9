#ifndef mesoslip_io_drafts_h
#define mesoslip_io_drafts_h

#include <string>

namespace mesoslip
{
/**
 * @name Drafts Files in the format of results, without computed data, for the --validate
 * of later runs. Their header marks them as drafts, so Hdf5File::check_header() refuses
 * them unless drafts are accepted. The tables (CSV) of a run with --try begin with a
 * draft line, and CsvTable::read() refuses them. @{
 */

/** Digest in the header of a draft. */
inline constexpr char draft_digest[] = "draft";

/** First line of a CSV file that is a draft. */
inline constexpr char draft_line[] =
  "# draft: made with --try, whose inputs may be drafts in which nothing was computed";

/** Lets this process read drafts as well. */
void accept_drafts();

/** Whether this process reads drafts. */
bool drafts_are_accepted();

/**
 * Path of the draft @p name in @p folder, which is created.
 * @throws UserError if a file of that name exists, finished or not: a draft never
 * replaces a result.
 */
std::string path_of_draft(const std::string &folder, const std::string &name);

/** Removes an unfinished draft. */
void discard_draft();

/** During the lifetime of an object all files that this process creates are drafts. */
class DraftMark
{
public:
  /** @p is_filled: whether the rows of Hdf5File::reserve_rows() will be written; if not,
   * they take no disk space and read as zeros. */
  explicit DraftMark(const bool is_filled);
  ~DraftMark();
  DraftMark(const DraftMark &)            = delete;
  DraftMark &operator=(const DraftMark &) = delete;

  /** Whether an object exists. */
  static bool is_set();

  /** Whether an object exists whose files are not filled. */
  static bool leaves_empty();
};
/** @} */
} // namespace mesoslip

#endif
