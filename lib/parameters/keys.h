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
/** A key of a .prm and its properties. */
struct Key
{
  std::string section;       ///< path of its subsection; empty at the top level
  std::string name;          ///< name within the section
  std::string value;         ///< current value as text
  std::string default_value; ///< default value as text
  std::string meaning;       ///< description; ends with the unit in brackets
  std::string allowed;       ///< completes "must be": "a number > 0"
  bool is_input = false;     ///< whether it names a file or folder to read
  bool is_list  = false;     ///< whether it names a list of files, separated by commas

  /** Whether a text is a valid value of the key. */
  std::function<bool(const std::string &)> accepts;

  /** "Section/Sub section/Key". */
  std::string path() const
  {
    return section.empty() ? name : section + "/" + name;
  }

  /** Files or folders that it names as input; empty if it names none. */
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
  /** Uses the .prm and the --set options in @p raw. */
  explicit Keys(const RawParameters &raw = RawParameters());
  Keys(const Keys &)            = delete;
  Keys &operator=(const Keys &) = delete;

  /**
   * Enters the subsection @p path, which may have several levels ("Section/Sub
   * section"), until the result is destroyed.
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
  /** Binds a number. */
  void bind(const std::string &key,
            double &value,
            const Range &range,
            const std::string &meaning);

  /** Binds a number; NaN stands for the word "auto". */
  void bind_or_auto(const std::string &key,
                    double &value,
                    const Range &range,
                    const std::string &meaning);

  /** Binds a whole number from 1 to @p upper; 0 stands for the word "auto". */
  void bind_or_auto(const std::string &key,
                    unsigned int &value,
                    const long upper,
                    const std::string &meaning);

  /** Binds a whole number from @p lower to @p upper. */
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

  /** Binds true or false. */
  void bind(const std::string &key, bool &value, const std::string &meaning);

  /** Binds any text. */
  void bind(const std::string &key, std::string &value, const std::string &meaning);

  /**
   * Binds one of @p choices: the text itself, or an enum or bool whose values have these
   * names in order.
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

  /** Binds @p n numbers. */
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

  /** Binds @p min_items to @p max_items numbers, separated by commas. */
  void bind_list(const std::string &key,
                 std::vector<double> &values,
                 const Range &range,
                 const std::string &meaning,
                 const std::size_t min_items,
                 const std::size_t max_items);

  /** Binds whole numbers from @p lower to @p upper, separated by commas. */
  void bind_list(const std::string &key,
                 std::vector<long> &values,
                 const long lower,
                 const long upper,
                 const std::string &meaning,
                 const std::size_t min_items,
                 const std::size_t max_items);

  /** Binds words out of @p choices (empty: any words), separated by commas. */
  void bind_list(const std::string &key,
                 std::vector<std::string> &words,
                 const std::vector<std::string> &choices,
                 const std::string &meaning);

  /**
   * Binds a list of names of subsections of the current section, which the caller binds
   * next. @p kind is their kind in messages, such as "phase".
   * @throws UserError for a repeated or impossible name, and for over @p most names.
   */
  void bind_names(const std::string &key,
                  std::vector<std::string> &names,
                  const std::string &kind,
                  const std::string &meaning,
                  const std::size_t most = 10000);

  /** Names of the subsections of the current section in the .prm or --set, in order. */
  std::vector<std::string> typed_sections() const;

  /**
   * Binds the path of a file or folder to read; may be empty. A relative path in a .prm
   * is relative to the folder of that .prm, a relative path given by --set to the
   * current folder; the bound path is absolute.
   */
  void bind_input(const std::string &key, std::string &path, const std::string &meaning);

  /** Binds paths of files to read, separated by commas, as for bind_input(). */
  void bind_inputs(const std::string &key,
                   std::vector<std::string> &paths,
                   const std::string &meaning);
  /** @} */

  /**
   * Applies the .prm and the --set options; later bindings read values.
   * @throws UserError for unknown sections and keys (with suggestions) and for invalid
   * values (with the allowed values)
   */
  void apply();

  /** Whether keys are read (after apply()), not declared. */
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
   * @name Conditions between keys Call these beside the bindings; they do nothing while
   * keys are declared. A key is set if the .prm or --set gives it a value other than its
   * default, so a file with all keys, as every run writes it, is accepted. @{
   */
  /** @throws UserError "Section/Key: what" unless @p holds, whatever follows. */
  void require(const bool holds, const std::string &key, const std::string &what) const;

  /** Declares that the key @p old of the current section is now @p now, or with "Key =
   * value" one of its values, with "Section/" a subsection. Users of the old name are
   * told. */
  void renamed(const std::string &old, const std::string &now)
  {
    renames[path(old)] = now;
  }

  /** Whether the .prm or --set names the key. */
  bool is_typed(const std::string &path) const;

  /** Whether the .prm or --set gives the key a non-empty value. */
  bool has_text(const std::string &path) const
  {
    const RawParameters::Entry *entry = raw.find(path);
    return entry != nullptr && entry->value.find_first_not_of(" \t") != std::string::npos;
  }

  /**
   * Paths are relative to the current section; "Section/" stands for all keys below.
   * @throws UserError naming the keys of @p paths that are set, unless the key
   * @p decider has one of @p values.
   */
  void only_with(const std::string &decider,
                 const std::vector<std::string> &values,
                 const std::vector<std::string> &paths) const;

  /**
   * Throws as only_with() if @p used is false. @p reason completes "has no effect, as ",
   * and @p remedy "remove it, or "; it may be empty.
   */
  void only_if(const bool used,
               const std::vector<std::string> &paths,
               const std::string &reason,
               const std::string &remedy) const;
  /** @} */

  /** The .prm and its includes; empty without a .prm. */
  const std::vector<std::string> &files() const
  {
    return raw.files();
  }

private:
  /** Parses a text; false if it is not a valid value of the key. */
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
  std::map<std::string, std::size_t> index;                ///< index of a key by its path
  std::map<std::string, std::string> renames;              ///< old path to new path
  std::map<std::string, const RawParameters::Entry *> set; ///< set keys by path
};

/** Whether @p path is in @p keys, where "Section/" stands for all keys below. */
bool is_among(const std::string &path, const std::vector<std::string> &keys);

/** All keys in .prm syntax, with meaning, allowed values and full digits; can be parsed again. */
void print_parameters(const Keys &keys, std::ostream &out);

/** Prints keys in .prm syntax: top-level keys, and keys that are typed or not the
 * default, except @p skip (as in canonical_parameters()). */
void print_given(const Keys &, std::ostream &, const std::vector<std::string> &skip = {});

/**
 * Lines "Section/Key = value" without the keys whose full paths are in @p skip
 * ("Section/" skips a section): text that determines a result, for digests and
 * comparison. Names of input files are omitted; add their content.
 */
std::string canonical_parameters(const Keys &keys,
                                 const std::vector<std::string> &skip = {});

/** Differences of two such texts: "Friction/Coefficient is 0.4 instead of 0.25,
 * Time/Beta2 is 0.6 instead of 0.5"; only the first few; empty if they are equal. */
std::string parameter_differences(const std::string &now, const std::string &before);
} // namespace mesoslip

#endif
