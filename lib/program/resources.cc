#include "program/resources.h"

#include "base/errors.h"
#include "base/files.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <unistd.h>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** The folder itself, or the nearest one above that exists. */
fs::path existing_part(const std::string &folder)
{
  std::error_code ignored;
  fs::path path = fs::absolute(folder).lexically_normal();
  while (!fs::exists(path, ignored) && path.has_relative_path())
    path = path.parent_path();
  return path;
}
} // namespace

std::string bytes_text(const double bytes)
{
  constexpr std::array<const char *, 7> units = {
    {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"}};
  double value     = bytes;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < units.size(); ++unit)
    value /= 1000.;
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g %s", value, units[unit]);
  return text;
}

void require_memory(const ResourceNeed &need)
{
  const double present = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                         static_cast<double>(sysconf(_SC_PAGESIZE));
  if (present > 0. && !(need.bytes <= present))
    throw UserError("the run needs about " + bytes_text(need.bytes) +
                    " of memory, but the machine has " + bytes_text(present) + "; " +
                    need.remedy);
}

void require_disk(const std::string &folder, const ResourceNeed &need)
{
  const fs::path path = existing_part(folder);
  std::error_code code;
  if (!fs::is_directory(path, code))
    throw UserError("the output folder " + folder + " cannot be created: " +
                    path.string() + " is not a folder; give another one with --output");
  if (access(path.c_str(), W_OK | X_OK) != 0)
    throw UserError("the output folder " + folder +
                    " cannot be written to: " + path.string() + " (" + system_message() +
                    "); give another one with --output");
  const fs::space_info space = fs::space(path, code);
  if (!code && !(need.bytes <= static_cast<double>(space.available)))
    throw UserError("the results take about " + bytes_text(need.bytes) +
                    ", but the disk of the output folder " + folder + " has only " +
                    bytes_text(static_cast<double>(space.available)) + " free; " +
                    need.remedy + ", or give another folder with --output");
}
} // namespace mesoslip
