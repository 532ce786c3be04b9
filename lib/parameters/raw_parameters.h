#ifndef mesoslip_parameters_raw_parameters_h
#define mesoslip_parameters_raw_parameters_h

#include "base/files.h"

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The `set` lines of a .prm file and the --set options, independent of the existing
 * keys; input of Keys.
 */
class RawParameters
{
public:
  /** An assignment or a subsection, with its origin. */
  struct Entry
  {
    std::string path;      ///< "Section/Sub section/Key"
    std::string value;     ///< text as typed; empty for a subsection
    unsigned int line = 0; ///< first line, from 1; 0 for a --set option
    std::string file;      ///< the .prm, or an included file
  };

  /** No entries, as for --print-parameters without a file. */
  RawParameters() = default;

  /** Returns the text of a named file.
   * @throws UserError if there is none. */
  using Reader = std::function<std::string(const std::string &)>;

  /**
   * Parses the text of a .prm. `include other` inserts the lines of another file, whose
   * name is relative to the folder of the .prm; @p reader returns its text.
   * @throws UserError "<file>:<line>: ..." for anything except `set`, `subsection`,
   * `end`, `include`, a comment or blank, for unbalanced subsections and for a key that
   * is set twice.
   */
  static RawParameters parse(const std::string &text,
                             const std::string &file,
                             const Reader &reader = read_file);

  /** Applies 'Section/Key=value'.
   * @throws UserError if there is no '='. */
  void override_with(const std::string &assignment);

  /** Makes keys without effect ignored instead of refused. */
  void ignore_unused()
  {
    unused_is_ignored = true;
  }

  /** Whether keys without effect are ignored. */
  bool ignores_unused() const
  {
    return unused_is_ignored;
  }

  /** The assignment to a key; null if there is none. Case-sensitive. */
  const Entry *find(const std::string &path) const;

  /** All subsections of the .prm, in file order. */
  const std::vector<Entry> &subsections() const
  {
    return sections;
  }

  /** The .prm and its includes. */
  const std::vector<std::string> &files() const
  {
    return all_files;
  }

  /** The lines of the .prm with includes inserted. */
  const std::string &text() const
  {
    return all_lines;
  }

  /** Entries in file order, then the --set options. */
  const std::vector<Entry> &entries() const
  {
    return all_entries;
  }

  /** Folder for relative paths of an entry: the folder of its file; "." for --set. */
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
