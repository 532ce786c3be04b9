#ifndef mesoslip_mesh_gmsh_msh_stream_h
#define mesoslip_mesh_gmsh_msh_stream_h

#include "base/errors.h"
#include "base/text.h"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace mesoslip
{
/** The values of a file, one after the other, in text or binary. */
class MshStream
{
public:
  /** Opens @p file, which has to be there. */
  explicit MshStream(const std::string &file)
    : file(file)
    , size(std::filesystem::file_size(file))
    , in(file, std::ios::binary)
  {
  }

  /** The next line that is not empty, without blanks at its ends; "" at the end. */
  std::string line()
  {
    std::string text;
    in >> std::ws;
    std::getline(in, text);
    return trimmed(text);
  }

  /** Passes over the rest of a line, behind which binary numbers may begin. */
  void end_line()
  {
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }

  /** The next number, separated by blanks in text. */
  template <typename T>
  T text_number()
  {
    T value = 0;
    if (!(in >> token))
      fail("it ends there");
    const char *begin        = token.data() + (token[0] == '+' ? 1 : 0),
               *end          = token.data() + token.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || stop != end)
      fail("'" + token + "' is not the number that belongs there");
    return value;
  }

  /** The next number, of type @p T in a binary file. */
  template <typename T>
  T number()
  {
    if (!binary)
      return text_number<T>();
    T value = 0;
    in.read(reinterpret_cast<char *>(&value), sizeof(T));
    if (!in)
      fail("it ends there");
    return value;
  }

  /** @p n if it may be a number of things with more than @p least bytes each. */
  std::size_t checked_count(const std::size_t n, const std::size_t least) const
  {
    if (n > size / least)
      fail(std::to_string(n) + " are more than the file can have");
    return n;
  }

  /** A number of things, see above. */
  std::size_t count(const std::size_t least)
  {
    return checked_count(number<std::size_t>(), least);
  }

  /** @throws UserError that names file and section and says @p what is wrong */
  [[noreturn]] void fail(const std::string &what) const
  {
    throw UserError(file + " is damaged in its section " + section + ": " + what +
                    "; save the mesh again with Gmsh");
  }

  const std::string file;              ///< its name
  const std::uintmax_t size;           ///< bytes
  bool binary         = false;         ///< whether number() is
  std::string section = "$MeshFormat"; ///< that is being read

private:
  std::ifstream in;
  std::string token;
};
} // namespace mesoslip

#endif
