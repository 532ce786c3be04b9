#ifndef mesoslip_base_text_h
#define mesoslip_base_text_h

#include <string>
#include <vector>

namespace mesoslip
{
/** Parses all of @p text, or returns false. Accepts a leading '+'; no NaN, no infinity.
 */
bool parse_number(const std::string &text, double &value);

/** Parses all of @p text as an integer in the range of long, or returns false. */
bool parse_number(const std::string &text, long &value);

/**
 * Whether @p value is 0 or its absolute value is from 1e-100 to 1e100; squares and
 * products with properties of a body then neither vanish nor overflow.
 */
bool has_usable_size(const double value);

/** Second half of the message about any other number. */
constexpr const char *usable_sizes = "numbers are 0, or from 1e-100 to 1e100 in size";

/**
 * Removes a UTF-8 byte order mark and ends each line with a line feed, also after CR or
 * CR LF.
 */
std::string plain_lines(const std::string &text);

/** Whether @p text is valid UTF-8, which JSON requires. */
bool is_utf8(const std::string &text);

/** Removes leading and trailing blanks. */
std::string trimmed(const std::string &text);

/**
 * The word of @p candidates with the smallest edit distance to @p word, ignoring case; ""
 * if none is close enough to be a typing error.
 */
std::string nearest_word(const std::string &word,
                         const std::vector<std::string> &candidates);

/** The shortest decimal text that reads back as the same double. */
std::string to_text(const double value);

/** Comma-separated numbers, each in its shortest form: "0.1, 2". */
std::string to_text(const std::vector<double> &values);

/** Comma-separated words: "a, b, c". */
std::string to_text(const std::vector<std::string> &words);

/** Items of a comma-separated list without surrounding blanks; no items for "". */
std::vector<std::string> split_list(const std::string &text);
} // namespace mesoslip

#endif
