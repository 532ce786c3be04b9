#include "io/numpy_array.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <numeric>
#include <regex>

namespace mesoslip
{
namespace
{
constexpr std::size_t largest_header = 65536; // bytes; NumPy writes 128

std::uint64_t little_endian(const std::string &bytes, const std::size_t n)
{
  std::uint64_t value = 0;
  for (std::size_t k = n; k-- > 0;)
    value = value << 8U | static_cast<unsigned char>(bytes[k]);
  return value;
}

/** The dictionary that describes the array, as Python would print it. */
std::string dictionary_of(std::ifstream &in, const std::string &path, std::size_t &offset)
{
  const std::string broken = path + " is no array of NumPy; save one with numpy.save";
  std::string start(8, '\0');
  if (!in.read(start.data(), 8) || start.compare(0, 6, "\x93NUMPY") != 0)
    throw UserError(broken);
  std::string length(start[6] == 1 ? 2 : 4, '\0');
  in.read(length.data(), static_cast<std::streamsize>(length.size()));
  const std::uint64_t n = in ? little_endian(length, length.size()) : 0;
  if (n == 0 || n > largest_header)
    throw UserError(broken);
  std::string text(n, '\0');
  if (!in.read(text.data(), static_cast<std::streamsize>(n)))
    throw UserError(broken);
  offset = 8 + length.size() + n;
  return text;
}

/** Kind, order and length of a number: "<i4". */
void take_type(NumpyHeader &header, const std::string &type, const std::string &path)
{
  std::smatch part;
  if (!std::regex_match(type, part, std::regex("([<>|=])([biu])([1248])")))
    throw UserError(path + " holds numbers of the type '" + type +
                    "', but phases are whole numbers; save it as uint8");
  header.big_endian = part[1] == ">";
  header.is_signed  = part[2] == "i";
  header.bytes      = static_cast<unsigned int>(std::stoul(part[3]));
}

void take_shape(NumpyHeader &header, const std::string &list, const std::string &path)
{
  std::size_t n = 1;
  for (const std::string &item : split_list(list))
    {
      long extent;
      if (item.empty())
        continue; // behind the comma of "(5,)"
      if (!parse_number(item, extent) || extent < 0 ||
          (extent > 0 && n > std::numeric_limits<std::size_t>::max() / 16 / extent))
        throw UserError(path + " has the shape (" + list + "), which makes no sense");
      header.shape.push_back(extent);
      n *= extent;
    }
}

std::int64_t number_at(const std::string &bytes,
                       const std::size_t at,
                       const NumpyHeader &header,
                       const std::string &path)
{
  std::uint64_t value = 0;
  for (unsigned int k = 0; k < header.bytes; ++k)
    value = value << 8U | static_cast<unsigned char>(
                            bytes[at + (header.big_endian ? k : header.bytes - 1 - k)]);
  const unsigned int unused = 64 - 8 * header.bytes;
  if (header.is_signed)
    return static_cast<std::int64_t>(value << unused) >> unused;
  if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    throw UserError(path + " holds the number " + std::to_string(value) +
                    ", which is too large; save it as uint8");
  return static_cast<std::int64_t>(value);
}
} // namespace

std::size_t NumpyHeader::size() const
{
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

NumpyHeader read_numpy_header(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw UserError(path + " cannot be opened; check the name");
  NumpyHeader header;
  const std::string text = dictionary_of(in, path, header.offset);
  std::smatch type, order, shape;
  if (!std::regex_search(text, type, std::regex("'descr': *'([^']*)'")) ||
      !std::regex_search(text, order, std::regex("'fortran_order': *(True|False)")) ||
      !std::regex_search(text, shape, std::regex("'shape': *\\(([^)]*)\\)")))
    throw UserError(path + " is no array of single numbers; save one with numpy.save");
  take_type(header, type[1], path);
  take_shape(header, shape[1], path);
  header.fortran_order     = order[1] == "True";
  const std::uintmax_t has = std::filesystem::file_size(path) - header.offset;
  if (const std::uintmax_t needs = std::uintmax_t{header.bytes} * header.size();
      has != needs)
    throw UserError(path + " has " + std::to_string(has) + " bytes of numbers, not the " +
                    std::to_string(needs) + " that its header states; save it again");
  return header;
}

std::vector<std::int64_t> read_numpy(const std::string &path)
{
  const NumpyHeader header = read_numpy_header(path);
  const std::string bytes  = read_file(path);
  std::vector<std::int64_t> values(header.size());
  std::vector<std::size_t> index(header.shape.size(), 0);
  for (std::size_t k = 0; k < values.size(); ++k)
    {
      std::size_t at = k;
      if (header.fortran_order)
        {
          at = 0;
          for (std::size_t axis = index.size(); axis-- > 0;)
            at = at * header.shape[axis] + index[axis];
          for (std::size_t axis = index.size();
               axis-- > 0 && ++index[axis] == header.shape[axis];)
            index[axis] = 0;
        }
      values[k] = number_at(bytes, header.offset + at * header.bytes, header, path);
    }
  return values;
}
} // namespace mesoslip
