#ifndef mesoslip_io_number_type_h
#define mesoslip_io_number_type_h

#include <string>
#include <vector>

namespace mesoslip
{
/** Storage type of a number in a file. */
struct NumberType
{
  char kind          = 'u'; ///< b (truth value), i, u or f (floating point), as in NumPy
  unsigned int bytes = 1;   ///< 1, 2, 4 or 8; 4 or 8 with floating point
  bool big_endian    = false; ///< whether the most significant byte comes first

  /** Whether the type holds only whole numbers. */
  bool is_whole() const
  {
    return kind != 'f';
  }

  /** Name in NumPy, such as "<f8". */
  std::string text() const;

  /**
   * Decodes @p n numbers from @p bytes_of_file.
   * @throws UserError beginning with @p path for a whole number from 2^53 on, some of
   * which a double does not hold
   */
  std::vector<double>
  decode(const char *bytes_of_file, const std::size_t n, const std::string &path) const;
};

/** Parses NumPy's name of a type ("<f8", "|u1"); false if it is not supported. */
bool parse_numpy_type(const std::string &text, NumberType &type);

/** Names of the plain number types: "uint8", ..., "float64". */
std::vector<std::string> number_type_names();

/** The type with this name. */
NumberType number_type(const std::string &name, const bool big_endian);

/** @throws UserError beginning with @p path if a value is 2^53 or more. */
void require_exact(const std::vector<double> &values, const std::string &path);
} // namespace mesoslip

#endif
