#ifndef mesoslip_io_parameters_h
#define mesoslip_io_parameters_h

#include <limits>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
/** The values a number may take; bounds are inclusive unless said otherwise. */
struct Range
{
  double lower         = -std::numeric_limits<double>::max(); ///< smallest value
  double upper         = std::numeric_limits<double>::max();  ///< largest value
  bool lower_exclusive = false; ///< lower itself is not allowed
  bool upper_exclusive = false; ///< upper itself is not allowed

  /** All finite numbers. */
  static Range any();
  /** x > 0. */
  static Range positive();
  /** x >= 0. */
  static Range non_negative();
  /** lower <= x <= upper. */
  static Range closed(const double lower, const double upper);
  /** lower < x < upper. */
  static Range open(const double lower, const double upper);
  /** lower < x <= upper. */
  static Range left_open(const double lower, const double upper);
  /** lower <= x. */
  static Range at_least(const double lower);
  /** Lengths (m) of bodies and cells whose products neither vanish nor overflow. */
  static Range length();
  /** Entries of a stiffness (Pa), likewise. */
  static Range stiffness();
  /** Densities (kg/m^3), likewise. */
  static Range density();

  /** False for NaN. */
  bool contains(const double x) const;

  /** For messages: "> 0", "in [0, 1)", "" when everything is allowed. */
  std::string text() const;
};

/**
 * A subsection of a ParameterHandler, left again at the end of the scope.
 * "Outer/Inner" enters both.
 */
class ParameterSection
{
public:
  /**
   * Enters the subsections of @p path, "Section/Sub section"; the destructor leaves them.
   */
  ParameterSection(dealii::ParameterHandler &handler, const std::string &path);
  ~ParameterSection();
  ParameterSection(const ParameterSection &)            = delete;
  ParameterSection &operator=(const ParameterSection &) = delete;

private:
  dealii::ParameterHandler &prm;
  unsigned int depth = 0;
};

/**
 * @name Declaring keys in the current section
 * Defaults keep all their digits. @p meaning ends with the unit in brackets:
 * "Time step as a fraction of the critical one [-]".
 * @{
 */
/** A number within @p range. */
void declare_double(dealii::ParameterHandler &prm,
                    const std::string &key,
                    const double value,
                    const Range &range,
                    const std::string &meaning);

/** A number or the word "auto" (get_double_or_auto() returns NaN for it). */
void declare_double_or_auto(dealii::ParameterHandler &prm,
                            const std::string &key,
                            const std::string &value,
                            const Range &range,
                            const std::string &meaning);

/** A whole number from @p lower to @p upper. */
void declare_integer(dealii::ParameterHandler &prm,
                     const std::string &key,
                     const long value,
                     const long lower,
                     const long upper,
                     const std::string &meaning);

/** true or false. */
void declare_bool(dealii::ParameterHandler &prm,
                  const std::string &key,
                  const bool value,
                  const std::string &meaning);

/** One of @p choices. */
void declare_selection(dealii::ParameterHandler &prm,
                       const std::string &key,
                       const std::string &value,
                       const std::vector<std::string> &choices,
                       const std::string &meaning);

/** A comma separated list whose items are among @p choices (empty: any words). */
void declare_word_list(dealii::ParameterHandler &prm,
                       const std::string &key,
                       const std::vector<std::string> &value,
                       const std::vector<std::string> &choices,
                       const std::string &meaning);

/** A comma separated list of numbers with @p min_items to @p max_items items. */
void declare_double_list(
  dealii::ParameterHandler &prm,
  const std::string &key,
  const std::vector<double> &value,
  const Range &range,
  const std::string &meaning,
  const unsigned int min_items = 0,
  const unsigned int max_items = std::numeric_limits<unsigned int>::max());

/** Whole numbers from @p lower to @p upper, separated by commas. */
void declare_integer_list(
  dealii::ParameterHandler &prm,
  const std::string &key,
  const std::vector<long> &value,
  const long lower,
  const long upper,
  const std::string &meaning,
  const unsigned int min_items = 0,
  const unsigned int max_items = std::numeric_limits<unsigned int>::max());

/** Any text. */
void declare_string(dealii::ParameterHandler &prm,
                    const std::string &key,
                    const std::string &value,
                    const std::string &meaning);

/**
 * The path of a file to read; may be empty. A relative path in a .prm is relative to
 * the folder of that .prm, one given by --set to the current folder; after parsing
 * the value is an absolute path.
 */
void declare_input_file(dealii::ParameterHandler &prm,
                        const std::string &key,
                        const std::string &value,
                        const std::string &meaning);
/** @} */

/**
 * @name Reading keys of the current section
 * Values were checked when the .prm was parsed; a key that was not declared is a
 * mistake in the program and throws std::logic_error.
 * @{
 */
/** A number. */
double get_double(dealii::ParameterHandler &prm, const std::string &key);

/** NaN for "auto". */
double get_double_or_auto(dealii::ParameterHandler &prm, const std::string &key);

/** A whole number. */
long get_integer(dealii::ParameterHandler &prm, const std::string &key);

/** true or false. */
bool get_bool(dealii::ParameterHandler &prm, const std::string &key);

/** The text as it stands. */
std::string get_string(dealii::ParameterHandler &prm, const std::string &key);

/** Items of a comma separated list. */
std::vector<std::string> get_word_list(dealii::ParameterHandler &prm,
                                       const std::string &key);

/** Numbers of a comma separated list. */
std::vector<double> get_double_list(dealii::ParameterHandler &prm,
                                    const std::string &key);

/** Whole numbers of a comma separated list. */
std::vector<long> get_integer_list(dealii::ParameterHandler &prm, const std::string &key);

/**
 * The absolute path of a file that exists and can be read. @throws UserError naming
 * key and path when it is empty, missing, a folder or unreadable; @p hint, when given,
 * follows ("run rve_homogenization first").
 */
std::string get_input_file(dealii::ParameterHandler &prm,
                           const std::string &key,
                           const std::string &hint = "");
/** @} */

/** @p path if absolute or empty, otherwise @p folder / @p path, made absolute. */
std::string resolve_input_path(const std::string &path, const std::string &folder);

/** Throws a UserError beginning with @p what unless @p path is a readable file. */
void require_readable_file(const std::string &what,
                           const std::string &path,
                           const std::string &hint = "");

/**
 * The same for an input of a run, which must not be left from an earlier run either
 * (earlier_results.h).
 */
void require_input_file(const std::string &what,
                        const std::string &path,
                        const std::string &hint = "");

/** The shortest decimal text that reads back as the same double. */
std::string to_text(const double value);

/** "a, b, c". */
std::string to_text(const std::vector<double> &values);

/** As above for words. */
std::string to_text(const std::vector<std::string> &words);

/** Items of a comma separated list, without surrounding blanks; none for "". */
std::vector<std::string> split_list(const std::string &text);
} // namespace mesoslip

#endif
