#ifndef mesoslip_io_raw_parameters_h
#define mesoslip_io_raw_parameters_h

#include <iosfwd>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
/**
 * The `set` lines of a .prm file and the --set options, before anything is known
 * about which keys exist. Declaring reads from it what decides further sections:
 * @code
 * for (const std::string &name : raw.section_names("Phases/Names", {"matrix"}, "phase"))
 *   declare_phase(prm, "Phases/" + name);
 * @endcode
 * The keys so read have to be declared like any other.
 */
class RawParameters
{
public:
  /** One assignment and where it came from. */
  struct Entry
  {
    /** "Section/Sub section/Key". */
    std::string path;
    std::string value; ///< text as typed
    /** 0 for a --set option. */
    unsigned int line = 0;
  };

  /** Nothing set: what --print-parameters without a file sees. */
  RawParameters() = default;

  /**
   * Parses the text of a .prm. @throws UserError "<file>:<line>: ..." for anything that
   * is not `set`, `subsection`, `end`, a comment or blank, for unbalanced subsections
   * and for a key that is set twice.
   */
  static RawParameters parse(const std::string &text, const std::string &file);

  /** Applies 'Section/Key=value'. @throws UserError when there is no '='. */
  void override_with(const std::string &assignment);

  /** Text of a key, or @p fallback. Upper and lower case matter. */
  std::string get(const std::string &path, const std::string &fallback) const;

  /** Comma separated items of a key, or @p fallback. */
  std::vector<std::string> get_list(const std::string &path,
                                    const std::vector<std::string> &fallback) const;

  /**
   * As get_list(), each item once, where every item is the name of a subsection. @p kind:
   * "phase". @throws UserError for a name that no line of a .prm can say.
   */
  std::vector<std::string> section_names(const std::string &path,
                                         const std::vector<std::string> &fallback,
                                         const std::string &kind) const;

  /** Whether the .prm or --set names the key. */
  bool has(const std::string &path) const;

  /** Names of the subsections of @p path ("" for the top), in order of appearance. */
  std::vector<std::string> subsections(const std::string &path) const;

  /**
   * Sets every entry in @p prm. @throws UserError for unknown sections and keys (with
   * the nearest that exist) and for values outside their range (with the range).
   */
  void apply(dealii::ParameterHandler &prm) const;

  /** In the order of the file, those of --set behind. */
  const std::vector<Entry> &entries() const
  {
    return all_entries;
  }

  /** The folder of the .prm: where its relative paths start. */
  std::string folder() const;

  /** "file.prm:12" or "--set 'Section/Key=value'". */
  std::string origin(const Entry &entry) const;

private:
  const Entry *find(const std::string &path) const;

  std::string file_name;
  std::vector<Entry> all_entries;
  std::vector<std::string> sections;
  std::vector<unsigned> section_lines;
};

/**
 * All declared keys of @p prm in .prm syntax, with meaning, allowed values and full
 * digits. What it prints can be parsed again.
 */
void print_parameters(const dealii::ParameterHandler &prm, std::ostream &out);

/**
 * Lines "Section/Key = value" without the keys whose full paths are in @p skip
 * ("Section/" skips a section): text that determines a result, for digests and
 * comparison. Input files have no name in it; add their content.
 */
std::string canonical_parameters(const dealii::ParameterHandler &prm,
                                 const std::vector<std::string> &skip = {});

/**
 * In what two such texts differ, for a message: "Friction/Coefficient is 0.4 instead of
 * 0.25, Time/Beta2 is 0.6 instead of 0.5"; empty if they are equal. The first few only.
 */
std::string parameter_differences(const std::string &now, const std::string &before);
} // namespace mesoslip

#endif
