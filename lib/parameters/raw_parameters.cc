#include "parameters/raw_parameters.h"

#include "base/errors.h"
#include "base/text.h"
#include "parameters/parameters.h"

#include <boost/algorithm/string/trim_all.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** Folder of a file; "." if its name has none. */
std::string folder_of(const std::string &file)
{
  const std::string parent = fs::path(file).parent_path().string();
  return parent.empty() ? "." : parent;
}

/** The text up to the first #; "\#" is kept as "#". */
std::string without_comment(const std::string &line)
{
  std::string text;
  for (const char c : line)
    if (c != '#')
      text += c;
    else if (!text.empty() && text.back() == '\\')
      text.back() = '#';
    else
      break;
  return text;
}

/** A line without comment, with single blanks between words. */
std::string cleaned(const std::string &line)
{
  return boost::algorithm::trim_fill_copy(without_comment(line), " ",
                                          std::locale::classic());
}

/** Reads the lines of a .prm and of its includes, and collects the assignments. */
class Parser
{
public:
  explicit Parser(const RawParameters::Reader &reader)
    : text_of(reader)
  {
  }

  std::vector<RawParameters::Entry> entries, sections;
  std::vector<std::string> files; ///< files read so far
  std::string text;               ///< without the include lines

  void read(const std::string &content, const std::string &name)
  {
    if (content.find('\0') != std::string::npos)
      throw UserError(name +
                      " is not a text file, but a parameter file (.prm) is needed");
    Source source{name, std::istringstream(plain_lines(content))};
    files.push_back(name);
    Source *const outer      = std::exchange(here, &source);
    const std::size_t n_open = open.size();
    files_open.push_back(name);
    std::string raw;
    while (next_line(raw))
      if (const std::string line = cleaned(raw); !line.empty())
        read_line(line, raw, n_open);
      else
        text += raw + "\n";
    if (open.size() > n_open)
      throw UserError(open.back().second + ": the subsection '" + open.back().first +
                      "' has no 'end'");
    files_open.pop_back();
    here = outer;
  }

private:
  static constexpr std::size_t most_files = 1000;

  struct Source
  {
    std::string file;
    std::istringstream lines;
    unsigned int first_line = 0;
    unsigned int last_line  = 0;
  };

  void
  read_line(const std::string &line, const std::string &raw, const std::size_t n_open)
  {
    if (!is_utf8(line))
      fail("the line is not UTF-8; save the file in that encoding");
    const std::string word = line.substr(0, line.find(' '));
    const std::string rest =
      line.size() > word.size() ? line.substr(word.size() + 1) : "";
    if (word == "subsection" || word == "SUBSECTION")
      enter(rest);
    else if (word == "end" || word == "END")
      leave(rest, n_open);
    else if (word == "set" || word == "SET")
      set(without_comment(raw));
    else if (word == "include" || word == "INCLUDE")
      {
        text += "# " + line + "\n";
        include(rest);
        return;
      }
    else
      fail("'" + line.substr(0, 60) +
           "' is not understood; lines are 'set Key = value', 'subsection Name', 'end', "
           "'include file' or '# comment'");
    text += raw + "\n";
  }

  std::string position() const
  {
    return here->file + ":" + std::to_string(here->first_line);
  }

  [[noreturn]] void fail(const std::string &what) const
  {
    throw UserError(position() + ": " + what);
  }

  /** Reads a logical line: a backslash at the end continues it. */
  bool next_line(std::string &line)
  {
    line.clear();
    here->first_line = here->last_line + 1;
    std::string piece;
    bool any = false;
    while (std::getline(here->lines, piece))
      {
        any = true;
        ++here->last_line;
        while (!piece.empty() && piece.back() == ' ')
          piece.pop_back();
        if (piece.empty() || piece.back() != '\\')
          {
            line += piece;
            return true;
          }
        line += piece.substr(0, piece.size() - 1);
      }
    return any;
  }

  std::string prefix() const
  {
    std::string path;
    for (const auto &section : open)
      path += section.first + "/";
    return path;
  }

  void check_name(const std::string &name, const char *kind) const
  {
    if (name.empty())
      fail(std::string("a ") + kind + " has no name");
    if (name.find('/') != std::string::npos)
      fail(std::string("the ") + kind + " '" + name +
           "' contains '/', which names cannot");
  }

  void enter(const std::string &name)
  {
    check_name(name, "subsection");
    const std::string path = prefix() + name;
    if (known_sections.insert(path).second)
      sections.push_back({path, "", here->first_line, here->file});
    open.emplace_back(name, position());
  }

  void leave(const std::string &rest, const std::size_t n_open)
  {
    if (!rest.empty())
      fail("nothing may follow 'end', found '" + rest + "'");
    if (open.size() == n_open)
      fail("'end' without an open subsection");
    open.pop_back();
  }

  void include(const std::string &name)
  {
    if (name.empty())
      fail("'include' names no file");
    const std::string file =
      (fs::path(folder_of(here->file)) / name).lexically_normal().string();
    for (const std::string &known : files_open)
      if (fs::path(known).lexically_normal() == file)
        fail(file + " includes itself");
    if (files.size() > most_files)
      fail("more than " + std::to_string(most_files) + " files are included");
    std::string content;
    try
      {
        content = text_of(file);
      }
    catch (const UserError &error)
      {
        fail(std::string("'include': ") + error.what());
      }
    read(content, file);
  }

  void set(const std::string &raw)
  {
    const auto equals = raw.find('=');
    if (equals == std::string::npos)
      fail("'" + cleaned(raw) + "' has no '='; write 'set Key = value'");
    const std::string left = cleaned(raw.substr(0, equals));
    const std::string key  = left.size() > 4 ? left.substr(4) : "";
    check_name(key, "key");
    const std::string path = prefix() + key;
    const auto [first, is_new] =
      first_set.emplace(path, std::pair(here->file, here->first_line));
    const auto &[file, line] = first->second;
    if (!is_new)
      fail(path + " is set again; " +
           (file != here->file ? file + ":" + std::to_string(line) + " has set it already"
            : line == here->first_line
              ? "the file is included twice"
              : "line " + std::to_string(line) + " has set it already"));
    entries.push_back(
      {path, trimmed(raw.substr(equals + 1)), here->first_line, here->file});
  }

  const RawParameters::Reader &text_of;
  Source *here = nullptr;
  std::vector<std::string> files_open;
  std::vector<std::pair<std::string, std::string>> open; ///< names and where they begin
  std::map<std::string, std::pair<std::string, unsigned int>> first_set;
  std::set<std::string> known_sections;
};
} // namespace

RawParameters RawParameters::parse(const std::string &text,
                                   const std::string &file,
                                   const Reader &reader)
{
  Parser parser(reader);
  parser.read(text, file);

  RawParameters raw;
  raw.all_entries = parser.entries;
  raw.sections    = parser.sections;
  raw.all_files   = parser.files;
  raw.all_lines   = parser.text;
  return raw;
}

void RawParameters::override_with(const std::string &assignment)
{
  const auto equals      = assignment.find('=');
  const std::string path = trimmed(assignment.substr(0, equals));
  if (equals == std::string::npos || path.empty())
    throw UserError("--set '" + assignment + "': write --set 'Section/Key=value'");
  const Entry entry = {path, trimmed(assignment.substr(equals + 1)), 0, ""};
  const auto old    = std::find_if(all_entries.begin(), all_entries.end(),
                                   [&](const Entry &e) { return e.path == path; });
  if (old != all_entries.end())
    *old = entry;
  else
    all_entries.push_back(entry);
}

const RawParameters::Entry *RawParameters::find(const std::string &path) const
{
  for (const Entry &entry : all_entries)
    if (entry.path == path)
      return &entry;
  return nullptr;
}

std::string RawParameters::origin(const Entry &entry)
{
  return entry.line == 0 ? "--set '" + entry.path + "=" + entry.value + "'"
                         : entry.file + ":" + std::to_string(entry.line);
}

std::string RawParameters::folder(const Entry &entry)
{
  return folder_of(entry.file);
}

bool Range::contains(const double x) const
{
  return (lower_exclusive ? x > lower : x >= lower) &&
         (upper_exclusive ? x < upper : x <= upper) && has_usable_size(x);
}

std::string Range::text() const
{
  const bool below = lower != -std::numeric_limits<double>::max();
  const bool above = upper != std::numeric_limits<double>::max();
  if (below && above)
    return std::string("in ") + (lower_exclusive ? "(" : "[") + to_text(lower) + ", " +
           to_text(upper) + (upper_exclusive ? ")" : "]");
  if (below)
    return (lower_exclusive ? "> " : ">= ") + to_text(lower);
  return above ? (upper_exclusive ? "< " : "<= ") + to_text(upper) : "";
}
} // namespace mesoslip
