#include "mesh/gmsh/counts.h"

#include "base/errors.h"

#include <boost/iostreams/device/mapped_file.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string_view>

namespace mesoslip
{
namespace
{
/** The words of a section, separated by blanks and line ends, up to the next '$'. */
class GmshSection
{
public:
  GmshSection(const std::string &file,
              const std::string &name,
              const std::string_view text)
    : file(file)
    , name(name)
    , text(text)
  {
  }

  /** Whether the section has no further word. */
  bool ended()
  {
    at = std::min(text.find_first_not_of(blanks, at), text.size());
    return at == text.size() || text[at] == '$';
  }

  /** Skips @p n words. */
  void skip(const std::size_t n)
  {
    for (std::size_t k = 0; k < n; ++k)
      word();
  }

  /** The next word, a whole number; too large numbers are clamped to the largest long. */
  long whole()
  {
    const std::string_view found = word();
    long value                   = 0;
    const auto [end, code] =
      std::from_chars(found.data(), found.data() + found.size(), value);
    if (end != found.data() + found.size())
      fail("has '" + std::string(found) +
           "' where a whole number has to be, behind a wrong number of points or cells");
    return code == std::errc::result_out_of_range ? std::numeric_limits<long>::max()
                                                  : value;
  }

  /** The next word as a count. */
  std::size_t count()
  {
    const long value = whole();
    if (value < 0)
      fail("has " + std::to_string(value) +
           " where a number of points or cells has to be");
    return static_cast<std::size_t>(value);
  }

  /** Throws if the file is too short for @p n items with @p each words. */
  void require_room(const std::size_t n, const std::size_t each, const std::string &what)
  {
    if (n > (text.size() - at) / each)
      fail("says " + std::to_string(n) + " " + what + ", more than the file holds");
  }

  /** @throws UserError "FILE: $NAME WHAT; save the mesh again". */
  [[noreturn]] void fail(const std::string &what) const
  {
    throw UserError(file + ": $" + name + " " + what +
                    "; the file is damaged or was edited, save the mesh again in Gmsh's "
                    "format");
  }

private:
  std::string_view word()
  {
    if (ended())
      fail("ends before its last point or cell is complete");
    const std::size_t begin = at;
    at                      = std::min(text.find_first_of(blanks, at), text.size());
    return text.substr(begin, at - begin);
  }

  const std::string file, name, blanks = " \t\r\n\f\v";
  const std::string_view text;
  std::size_t at = 0;
};

/** Numbers of a section of a binary file, in this machine's byte order. */
class BinarySection
{
public:
  BinarySection(const std::string &file,
                const std::string &name,
                const std::string_view text)
    : file(file)
    , name(name)
    , text(text)
  {
  }

  /** The next number; a negative one becomes huge. */
  template <typename T>
  std::size_t number()
  {
    T value = 0;
    skip(1, sizeof value, "numbers");
    std::memcpy(&value, text.data() + at - sizeof value, sizeof value);
    return static_cast<std::size_t>(value);
  }

  /** The number in the first line, which is a text in format 2. */
  std::size_t line()
  {
    std::size_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    at = std::min(text.find('\n'), text.size() - 1) + 1;
    return value;
  }

  /** Skips @p n items of @p each bytes. */
  void skip(const std::size_t n, const std::size_t each, const std::string &what)
  {
    if (n > (text.size() - at) / each)
      fail("says " + std::to_string(n) + " " + what + ", more than the file holds");
    at += n * each;
  }

  /** Throws unless the section ends here, after the @p said items. */
  void require_end(const std::size_t said, const std::string &what)
  {
    at = std::min(text.find_first_not_of("\r\n", at), text.size());
    if (text.compare(at, name.size() + 4, "$End" + name) != 0)
      fail("does not end behind the " + std::to_string(said) + " " + what +
           " that it says");
  }

  /** See GmshSection::fail(). */
  [[noreturn]] void fail(const std::string &what) const
  {
    GmshSection(file, name, text).fail(what);
  }

private:
  const std::string file, name;
  const std::string_view text;
  std::size_t at = 0;
};

/** Number of corners of a cell of Gmsh's @p type; 0 if Gmsh has to look it up. */
std::size_t corners_of(const long type)
{
  constexpr std::array<std::size_t, 16> n = {
    {0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1}};
  return type > 0 && type < 16 ? n[static_cast<std::size_t>(type)] : 0;
}

/** Throws if counts differ: "41 points" against "42". */
template <typename Section>
void require_same(Section &section,
                  const std::size_t said,
                  const std::size_t found,
                  const std::string &what)
{
  if (said != found)
    section.fail("says " + std::to_string(said) + " " + what + " and has " +
                 std::to_string(found));
}

/** Format 2: Gmsh truncates point numbers to 32 bits. */
void require_point_number(const std::string &file, const long number)
{
  if (number < 0 || number > std::numeric_limits<int>::max())
    throw UserError(file + " has a point with the number " + std::to_string(number) +
                    "; let Gmsh renumber the mesh from 1 on, so that 32 bits hold it");
}

/** Format 2: a number and three coordinates per point. */
void check_points(GmshSection &section, const std::string &file)
{
  const std::size_t said = section.count();
  std::size_t found      = 0;
  for (; !section.ended(); ++found)
    {
      require_point_number(file, section.whole());
      section.skip(3);
    }
  require_same(section, said, found, "points");
}

/** Format 2: number, type and tags of a cell, and its corners. */
void check_cells(GmshSection &section, const std::string &file)
{
  const std::size_t said = section.count();
  std::size_t found      = 0;
  for (; !section.ended(); ++found)
    {
      section.whole();
      const std::size_t n = corners_of(section.whole());
      if (n == 0)
        return;
      section.skip(section.count());
      for (std::size_t k = 0; k < n; ++k)
        require_point_number(file, section.whole());
    }
  require_same(section, said, found, "cells");
}

/** Format 4: blocks of points or cells with four leading numbers; the third is the kind,
 * the last the number of items. */
void check_blocks(GmshSection &section, const bool cells, const bool of_4_0)
{
  const std::string what     = cells ? "cells" : "points";
  const std::size_t n_blocks = section.count(), said = section.count();
  section.skip(of_4_0 ? 0 : 2);
  std::size_t found = 0;
  for (std::size_t block = 0; block < n_blocks; ++block)
    {
      if (section.ended())
        section.fail("says " + std::to_string(n_blocks) + " blocks and has " +
                     std::to_string(block));
      const std::array<long, 2> place = {{section.whole(), section.whole()}};
      const long dimension = place[of_4_0 ? 1 : 0], kind = section.whole();
      const std::size_t n = section.count();
      const std::size_t each =
        cells ? 1 + corners_of(kind)
              : 4 + static_cast<std::size_t>(kind == 0 ? 0 : std::max(dimension, 0L));
      if (cells && each == 1)
        return;
      if (dimension < 0 || dimension > 3)
        section.fail("has a block of the dimension " + std::to_string(dimension) +
                     ", behind a wrong number of " + what);
      section.require_room(n, each, what + " in a block");
      section.skip(n * each);
      found += n;
    }
  if (!section.ended())
    section.fail("goes on behind the " + std::to_string(n_blocks) + " blocks and " +
                 std::to_string(said) + " " + what + " that it says");
  require_same(section, said, found, what);
}

/** Format 4.1, as check_blocks(). */
void check_binary_blocks(BinarySection &section, const bool cells)
{
  constexpr std::size_t word = sizeof(std::uint64_t);
  const std::string what     = cells ? "cells" : "points";
  const auto n_blocks        = section.number<std::uint64_t>(),
             said            = section.number<std::uint64_t>();
  section.skip(2, word, "numbers");
  std::size_t found = 0;
  for (std::size_t block = 0; block < n_blocks; ++block)
    {
      const auto dimension = section.number<int>();
      section.number<int>();
      const auto kind           = section.number<int>();
      const auto n              = section.number<std::uint64_t>();
      const std::size_t corners = corners_of(static_cast<long>(kind));
      if (cells && corners == 0)
        return;
      if (dimension > 3)
        section.fail("has a block of no dimension, behind a wrong number of " + what);
      section.skip(n, word * (cells ? 1 + corners : 4 + (kind == 0 ? 0 : dimension)),
                   what + " in a block");
      found += n;
    }
  section.require_end(said, what);
  require_same(section, said, found, what);
}

/** Format 2, as check_points() and check_cells(). */
void check_binary_list(BinarySection &section, const bool cells)
{
  const std::string what = cells ? "cells" : "points";
  const std::size_t said = section.line();
  if (!cells)
    section.skip(said, sizeof(int) + 3 * sizeof(double), what);
  for (std::size_t found = 0; cells && found < said;)
    {
      const std::size_t type = section.number<int>(), some = section.number<int>(),
                        tags    = section.number<int>();
      const std::size_t corners = corners_of(static_cast<long>(type));
      if (type > 1000 || tags > 1000) // Gmsh has 140 types
        section.fail("has less than the " + std::to_string(said) + " cells that it says");
      if (corners == 0 || some == 0)
        return;
      section.skip(some, sizeof(int) * (1 + tags + corners), what);
      found += some;
    }
  section.require_end(said, what);
}

/** The text after the line of @p name; empty if there is none. */
std::string_view behind_line(const std::string_view text, const std::string &name)
{
  const std::size_t at = text.find("\n$" + name);
  const std::size_t to =
    at == std::string_view::npos ? at : text.find('\n', at + name.size() + 2);
  return to == std::string_view::npos ? std::string_view() : text.substr(to);
}
} // namespace

void require_gmsh_counts(const std::string &file)
{
  const boost::iostreams::mapped_file_source map(file);
  const std::string_view text(map.data(), map.size());
  double version = 0.;
  int binary     = 0;
  if (std::sscanf(std::string(text.substr(0, 100)).c_str(), "$MeshFormat %lf %d",
                  &version, &binary) != 2 ||
      !(version >= 2. && version < 5.) || (version >= 3. && version < 4.))
    return;
  const bool of_2 = version < 3., of_4_0 = version == 4.;
  for (const bool cells : {false, true})
    {
      const std::string name      = cells ? "Elements" : "Nodes";
      const std::string_view rest = behind_line(text, name);
      if (binary != 0 && rest.size() > 1)
        {
          BinarySection section(file, name, rest.substr(1));
          if (of_2)
            check_binary_list(section, cells);
          else if (version == 4.1)
            check_binary_blocks(section, cells);
          continue;
        }
      GmshSection section(file, name, rest);
      if (rest.empty() || section.ended())
        continue;
      if (!of_2)
        check_blocks(section, cells, of_4_0);
      else if (cells)
        check_cells(section, file);
      else
        check_points(section, file);
    }
}
} // namespace mesoslip
