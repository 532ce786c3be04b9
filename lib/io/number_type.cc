#include "io/number_type.h"

#include "base/errors.h"
#include "base/text.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <regex>

namespace mesoslip
{
namespace
{
/** The bytes of a number, the lowest one last. */
std::uint64_t bits_of(const char *bytes, const NumberType &type)
{
  std::uint64_t value = 0;
  for (unsigned int k = 0; k < type.bytes; ++k)
    value = value << 8U |
            static_cast<unsigned char>(bytes[type.big_endian ? k : type.bytes - 1 - k]);
  return value;
}

double number_of(const std::uint64_t bits, const NumberType &type)
{
  if (type.kind == 'f' && type.bytes == 4)
    {
      const auto half = static_cast<std::uint32_t>(bits);
      float value;
      std::memcpy(&value, &half, sizeof value);
      return value;
    }
  if (type.kind == 'f')
    {
      double value;
      std::memcpy(&value, &bits, sizeof value);
      return value;
    }
  const unsigned int unused = 64 - 8 * type.bytes;
  return type.kind == 'i'
           ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
           : static_cast<double>(bits);
}
} // namespace

std::string NumberType::text() const
{
  return std::string(bytes == 1   ? "|"
                     : big_endian ? ">"
                                  : "<") +
         kind + std::to_string(bytes);
}

std::vector<double> NumberType::decode(const char *bytes_of_file,
                                       const std::size_t n,
                                       const std::string &path) const
{
  std::vector<double> values(n);
  for (std::size_t k = 0; k < n; ++k)
    values[k] = number_of(bits_of(bytes_of_file + k * bytes, *this), *this);
  if (is_whole() && bytes == 8)
    require_exact(values, path);
  return values;
}

bool parse_numpy_type(const std::string &text, NumberType &type)
{
  std::smatch part;
  if (!std::regex_match(text, part, std::regex("([<>|=])([biu][1248]|f[48])")))
    return false;
  type.big_endian = part[1] == ">";
  type.kind       = part[2].str()[0];
  type.bytes      = static_cast<unsigned int>(part[2].str()[1] - '0');
  return true;
}

std::vector<std::string> number_type_names()
{
  return {"uint8", "int8",   "uint16", "int16",   "uint32",
          "int32", "uint64", "int64",  "float32", "float64"};
}

NumberType number_type(const std::string &name, const bool big_endian)
{
  const std::string bits = name.substr(name.find_first_of("123468"));
  return {name[0], static_cast<unsigned int>(std::stoul(bits) / 8), big_endian};
}

void require_exact(const std::vector<double> &values, const std::string &path)
{
  for (const double value : values)
    if (!(std::fabs(value) < 0x1p53))
      throw UserError(path + " holds a whole number of 2^53 = " + to_text(0x1p53) +
                      " or more, which is too large; save it as uint8");
}
} // namespace mesoslip
