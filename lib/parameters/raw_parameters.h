#ifndef mesoslip_parameters_raw_parameters_h
#define mesoslip_parameters_raw_parameters_h

#include "base/files.h"

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The `set` lines of a .prm file and the --set options, before anything is known
 * about which keys exist; Keys takes it over.
 */
class RawParameters
{
public:
  /** One assignment, or a subsection, and where it came from. */
  struct Entry
  {
    std::string path;      ///< "Section/Sub section/Key"
    std::string value;     ///< text as typed; empty for a subsection
    unsigned int line = 0; ///< from 1, where it begins; 0 for a --set option
    std::string file;      ///< the .prm, or one that it includes
  };

  /** Nothing set: what --print-parameters without a file sees. */
  RawParameters() = default;

  /** Text of the file of a name. @throws UserError where there is none. */
  using Reader = std::function<std::string(const std::string &)>;

  /**
   * Parses the text of a .prm. `include other` stands for the lines of another file, whose
   * name is relative to the folder of the .prm, and of which @p reader gives the text.
   * @throws UserError "<file>:<line>: ..." for anything that is not `set`, `subsection`,
   * `end`, `include`, a comment or blank, for unbalanced subsections and for a key that is
   * set twice.
   */
  static RawParameters parse(const std::string &text,
                             const std::string &file,
                             const Reader &reader = read_file);

  /** Applies 'Section/Key=value'. @throws UserError when there is no '='. */
  void override_with(const std::string &assignment);

  /** From now on keys that have no effect with the others are left aside, not refused. */
  void ignore_unused()
  {
    unused_is_ignored = true;
  }

  /** Whether they are. */
  bool ignores_unused() const
  {
    return unused_is_ignored;
  }

  /** The assignment to a key; null if there is none. Upper and lower case matter. */
  const Entry *find(const std::string &path) const;

  /** All subsections of the .prm, in the order of their lines. */
  const std::vector<Entry> &subsections() const
  {
    return sections;
  }

  /** The .prm and what it includes. */
  const std::vector<std::string> &files() const
  {
    return all_files;
  }

  /** The lines of the .prm, those that it includes in their places. */
  const std::string &text() const
  {
    return all_lines;
  }

  /** In the order of the file, those of --set behind. */
  const std::vector<Entry> &entries() const
  {
    return all_entries;
  }

  /** Where relative paths of an entry start: that of its file; "." for --set. */
  static std::string folder(const Entry &entry);

  /** "file.prm:12" or "--set 'Section/Key=value'". */
  static std::string origin(const Entry &entry);

private:
  std::vector<Entry> all_entries, sections;
  std::vector<std::string> all_files;
  std::string all_lines;
  bool unused_is_ignored = false;
};
} // namespace mesoslip

#endif
