#ifndef mesoslip_io_number_type_h
#define mesoslip_io_number_type_h

#include <string>
#include <vector>

namespace mesoslip
{
/** How a number is stored in a file. */
struct NumberType
{
  char kind          = 'u'; ///< b (truth value), i, u or f (floating point), as in NumPy
  unsigned int bytes = 1;   ///< 1, 2, 4 or 8; 4 or 8 with floating point
  bool big_endian    = false; ///< whether its first byte is the highest

  /** Whether all its values are whole numbers. */
  bool is_whole() const
  {
    return kind != 'f';
  }

  /** As NumPy writes it: "<f8". */
  std::string text() const;

  /**
   * @p n numbers that begin at @p bytes_of_file. @throws UserError beginning with @p path
   * for a whole number from 2^53 on, some of which a double does not hold
   */
  std::vector<double>
  decode(const char *bytes_of_file, const std::size_t n, const std::string &path) const;
};

/** The type that NumPy calls @p text ("<f8", "|u1"), or false if it is none of these. */
bool parse_numpy_type(const std::string &text, NumberType &type);

/** Names of the types of plain numbers: "uint8", ..., "float64". */
std::vector<std::string> number_type_names();

/** The type of that name. */
NumberType number_type(const std::string &name, const bool big_endian);

/** @throws UserError beginning with @p path if one of @p values is 2^53 or more. */
void require_exact(const std::vector<double> &values, const std::string &path);
} // namespace mesoslip

#endif
