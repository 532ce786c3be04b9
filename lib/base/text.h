#ifndef mesoslip_base_text_h
#define mesoslip_base_text_h

#include <string>
#include <vector>

namespace mesoslip
{
/** Parses all of @p text, or returns false. Accepts a leading '+'; no NaN, no infinity.
 */
bool parse_number(const std::string &text, double &value);

/** As above for whole numbers that fit. */
bool parse_number(const std::string &text, long &value);

/** Whether @p value is 0 or from 1e-100 to 1e100 in size, so that squares and products with what
 * bodies have neither vanish nor overflow. */
bool has_usable_size(const double value);

/** How a sentence about another number goes on. */
constexpr const char *usable_sizes = "numbers are 0, or from 1e-100 to 1e100 in size";

/** Without the mark that some editors put in front of UTF-8, and with a line feed at the
 * end of each line, also where it was a carriage return or both. */
std::string plain_lines(const std::string &text);

/** Whether it can go on into JSON. */
bool is_utf8(const std::string &text);

/** Without leading and trailing blanks. */
std::string trimmed(const std::string &text);

/**
 * The word of @p candidates that is nearest to @p word in edit distance (upper and lower
 * case alike); "" when none is near enough to be a slip.
 */
std::string nearest_word(const std::string &word,
                         const std::vector<std::string> &candidates);

/** The shortest decimal text that reads back as the same double. */
std::string to_text(const double value);

/** Numbers separated by commas, each as above: "0.1, 2". */
std::string to_text(const std::vector<double> &values);

/** Words separated by commas: "a, b, c". */
std::string to_text(const std::vector<std::string> &words);

/** Items of a comma separated list, without surrounding blanks; none for "". */
std::vector<std::string> split_list(const std::string &text);
} // namespace mesoslip

#endif
