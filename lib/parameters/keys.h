#ifndef mesoslip_parameters_keys_h
#define mesoslip_parameters_keys_h

#include "parameters/parameters.h"
#include "parameters/raw_parameters.h"

#include <array>
#include <functional>
#include <iosfwd>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace mesoslip
{
/** A key of a .prm with everything that is known about it. */
struct Key
{
  std::string section;       ///< path of its subsection; empty at the top level
  std::string name;          ///< name within the section
  std::string value;         ///< text now
  std::string default_value; ///< text without a .prm
  std::string meaning;       ///< what it sets; ends with the unit in brackets
  std::string allowed;       ///< completes "must be": "a number > 0"
  bool is_input = false;     ///< whether it names a file or folder to read
  bool is_list  = false;     ///< whether that is a list, separated by commas

  /** Whether a text is a value of the key. */
  std::function<bool(const std::string &)> accepts;

  /** "Section/Sub section/Key". */
  std::string path() const
  {
    return section.empty() ? name : section + "/" + name;
  }

  /** What it names as input; empty if it does not. */
  std::vector<std::string> inputs() const;
};

/**
 * Binds the keys of a .prm to variables. Each key is written once, in a function that
 * runs twice: before apply() it declares the keys, with the values of the variables as
 * defaults; after apply() it reads them into the variables.
 * @code
 * void bind(Keys &keys, TimeParameters &time)
 * {
 *   const auto section = keys.section("Time");
 *   keys.bind("End time", time.end_time, Range::positive(), "Simulated time [s]");
 * }
 *
 * Keys keys(RawParameters::parse(text, "run.prm"));
 * bind(keys, TimeParameters());
 * keys.apply();
 * bind(keys, time);
 * @endcode
 */
class Keys
{
public:
  /** For the .prm and the --set options in @p raw. */
  explicit Keys(const RawParameters &raw = RawParameters());
  Keys(const Keys &)            = delete;
  Keys &operator=(const Keys &) = delete;

  /**
   * Keys are those of the subsection @p path, which may be several ("Section/Sub section"),
   * until the result is destroyed.
   */
  [[nodiscard]] std::shared_ptr<const void> section(const std::string &path)
  {
    const auto leave = [this, outer = current_section](const void *) {
      current_section = outer;
    };
    current_section = this->path(path);
    return {nullptr, leave};
  }

  /** Path of @p key in the current section, for messages. */
  std::string path(const std::string &key) const;

  /**
   * @name Binding keys of the current section
   * Values are checked in apply(), so that reading does not fail.
   * @{
   */
  /** A number. */
  void bind(const std::string &key,
            double &value,
            const Range &range,
            const std::string &meaning);

  /** A number, or NaN for the word "auto". */
  void bind_or_auto(const std::string &key,
                    double &value,
                    const Range &range,
                    const std::string &meaning);

  /** A whole number from 1 to @p upper, or 0 for the word "auto". */
  void bind_or_auto(const std::string &key,
                    unsigned int &value,
                    const long upper,
                    const std::string &meaning);

  /** A whole number from @p lower to @p upper. */
  template <typename Integer>
  void bind(const std::string &key,
            Integer &value,
            const long lower,
            const long upper,
            const std::string &meaning)
  {
    long number = static_cast<long>(value);
    bind_long(key, number, lower, upper, meaning);
    value = static_cast<Integer>(number);
  }

  /** true or false. */
  void bind(const std::string &key, bool &value, const std::string &meaning);

  /** Any text. */
  void bind(const std::string &key, std::string &value, const std::string &meaning);

  /**
   * One of @p choices: the text itself, or the value of an enum or bool whose values are
   * named in their order.
   */
  template <typename Choice>
  void bind(const std::string &key,
            Choice &value,
            const std::vector<std::string> &choices,
            const std::string &meaning)
  {
    if constexpr (std::is_same_v<Choice, std::string>)
      bind_choice(key, value, choices, meaning);
    else
      {
        std::string name = choices[static_cast<std::size_t>(value)];
        bind_choice(key, name, choices, meaning);
        for (std::size_t i = 0; i < choices.size(); ++i)
          if (choices[i] == name)
            value = static_cast<Choice>(i);
      }
  }

  /** @p n numbers. */
  template <std::size_t n>
  void bind(const std::string &key,
            std::array<double, n> &values,
            const Range &range,
            const std::string &meaning)
  {
    std::vector<double> list(values.begin(), values.end());
    bind_list(key, list, range, meaning, n, n);
    for (std::size_t i = 0; i < n; ++i)
      values[i] = list[i];
  }

  /** @p min_items to @p max_items numbers, separated by commas. */
  void bind_list(const std::string &key,
                 std::vector<double> &values,
                 const Range &range,
                 const std::string &meaning,
                 const std::size_t min_items,
                 const std::size_t max_items);

  /** Whole numbers from @p lower to @p upper, separated by commas. */
  void bind_list(const std::string &key,
                 std::vector<long> &values,
                 const long lower,
                 const long upper,
                 const std::string &meaning,
                 const std::size_t min_items,
                 const std::size_t max_items);

  /** Words out of @p choices (empty: any words), separated by commas. */
  void bind_list(const std::string &key,
                 std::vector<std::string> &words,
                 const std::vector<std::string> &choices,
                 const std::string &meaning);

  /**
   * A list of names of subsections of the current section, which the caller binds next.
   * @p kind, such as "phase", is what they are. @throws UserError for a name that is
   * given twice or that no line of a .prm can say, and for more than @p most.
   */
  void bind_names(const std::string &key,
                  std::vector<std::string> &names,
                  const std::string &kind,
                  const std::string &meaning,
                  const std::size_t most = 10000);

  /** Names of the subsections of the current section that the .prm or --set has, in their order. */
  std::vector<std::string> typed_sections() const;

  /**
   * The path of a file or folder to read; may be empty. A relative path in a .prm is
   * relative to the folder of that .prm, one given by --set to the current folder; the
   * path that is read is absolute.
   */
  void bind_input(const std::string &key, std::string &path, const std::string &meaning);

  /** Paths of files to read, separated by commas; each as for bind_input(). */
  void bind_inputs(const std::string &key,
                   std::vector<std::string> &paths,
                   const std::string &meaning);
  /** @} */

  /**
   * Takes over what the .prm and the --set options say; from then on keys are read.
   * @throws UserError for unknown sections and keys (with the nearest that exist) and for
   * values that are not allowed (with those that are).
   */
  void apply();

  /** Whether keys are read, and no longer declared. */
  bool are_read() const
  {
    return reading;
  }

  /** All keys, in the order of declaration. */
  const std::vector<Key> &all() const
  {
    return keys;
  }

  /** Whether there is a key @p path. */
  bool has(const std::string &path) const
  {
    return index.count(path) > 0;
  }

  /** Value of the key @p path as text. */
  const std::string &value(const std::string &path) const;

  /**
   * @name Conditions between keys
   * They stand beside the bindings and do nothing while keys are declared. A key counts
   * as set when the .prm or --set gives it another value than its default, so that a file
   * with all keys, as every run leaves it, is accepted again.
   * @{
   */
  /** @throws UserError "Section/Key: what" unless @p holds, whatever comes later in the .prm. */
  void require(const bool holds, const std::string &key, const std::string &what) const;

  /** The key @p old of the current section is called @p now; with "Key = value" for @p old one of its
   * values is, with "Section/" for both the whole subsection. Whoever uses the old name is told so. */
  void renamed(const std::string &old, const std::string &now)
  {
    renames[path(old)] = now;
  }

  /** Whether the .prm or --set names the key. */
  bool is_typed(const std::string &path) const;

  /** The same, and it is not empty. */
  bool has_text(const std::string &path) const
  {
    const RawParameters::Entry *entry = raw.find(path);
    return entry != nullptr && entry->value.find_first_not_of(" \t") != std::string::npos;
  }

  /**
   * All paths are relative to the current section; "Section/" stands for all keys below.
   * @throws UserError naming those of @p paths that are set unless the key @p decider has
   * one of @p values.
   */
  void only_with(const std::string &decider,
                 const std::vector<std::string> &values,
                 const std::vector<std::string> &paths) const;

  /**
   * As only_with() when @p used is false. @p reason completes "has no effect, as ", and
   * @p remedy "remove it, or ".
   */
  void only_if(const bool used,
               const std::vector<std::string> &paths,
               const std::string &reason,
               const std::string &remedy) const;
  /** @} */

  /** The .prm and what it includes; empty without one. */
  const std::vector<std::string> &files() const
  {
    return raw.files();
  }

private:
  /** Interprets a text; false if it is no value of the key. */
  template <typename T>
  using Reader = std::function<bool(const std::string &text, T &value)>;

  template <typename T>
  void bind_value(const std::string &key,
                  T &value,
                  const std::string &default_value,
                  const std::string &allowed,
                  const Reader<T> &read,
                  const std::string &meaning);

  void bind_long(const std::string &key,
                 long &value,
                 const long lower,
                 const long upper,
                 const std::string &meaning);
  void bind_choice(const std::string &key,
                   std::string &value,
                   const std::vector<std::string> &choices,
                   const std::string &meaning);
  std::string new_name(const std::string &path) const;
  std::vector<const RawParameters::Entry *>
  set_entries(const std::vector<std::string> &paths) const;

  RawParameters raw;
  bool reading = false;
  std::string current_section;
  std::vector<Key> keys;
  std::map<std::string, std::size_t> index;                ///< of keys, by path
  std::map<std::string, std::string> renames;              ///< old to new, by path
  std::map<std::string, const RawParameters::Entry *> set; ///< by path
};

/** Whether @p path is one of @p keys, of which "Section/" stands for all keys below. */
bool is_among(const std::string &path, const std::vector<std::string> &keys);

/** All keys in .prm syntax, with meaning, allowed values and full digits; can be parsed again. */
void print_parameters(const Keys &keys, std::ostream &out);

/** Those without a section, those that are typed or not the default, but for @p skip as below, in .prm syntax. */
void print_given(const Keys &, std::ostream &, const std::vector<std::string> &skip = {});

/**
 * Lines "Section/Key = value" without the keys whose full paths are in @p skip
 * ("Section/" skips a section): text that determines a result, for digests and
 * comparison. Input files have no name in it; add their content.
 */
std::string canonical_parameters(const Keys &keys,
                                 const std::vector<std::string> &skip = {});

/** In what two such texts differ, for a message: "Friction/Coefficient is 0.4 instead of
 * 0.25, Time/Beta2 is 0.6 instead of 0.5"; empty if they are equal. The first few only. */
std::string parameter_differences(const std::string &now, const std::string &before);
} // namespace mesoslip

#endif
