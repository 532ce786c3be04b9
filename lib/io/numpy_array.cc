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

/** The dictionary that describes the array, in Python syntax. */
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
    throw UserError(path + " ends within its header; it was not written or copied whole");
  offset = 8 + length.size() + n;
  return text;
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
  if (!parse_numpy_type(type[1], header.type))
    throw UserError(
      path + " holds numbers of the type '" + std::string(type[1]) +
      "', which is not read; save whole numbers as uint8, others as float32");
  take_shape(header, shape[1], path);
  header.fortran_order     = order[1] == "True";
  const std::uintmax_t has = std::filesystem::file_size(path) - header.offset;
  if (const std::uintmax_t needs = std::uintmax_t{header.type.bytes} * header.size();
      has != needs)
    throw UserError(path + " has " + std::to_string(has) + " bytes of numbers, not the " +
                    std::to_string(needs) + " that its header states; save it again");
  return header;
}
} // namespace mesoslip
