#include "base/version.h"
#include "io/checksum.h"
#include "io/hdf5/internal.h"
#include "io/hdf5_file.h"

namespace mesoslip
{
void Hdf5File::write_header(const std::string &format,
                            const int format_version,
                            const int dim,
                            const std::string &digest)
{
  write_attribute("/", "format", format);
  write_attribute("/", "format_version", format_version);
  write_attribute("/", "dim", dim);
  write_attribute("/", "program_version", std::string(version));
  write_attribute("/", "digest", digest);
}

Hdf5Header Hdf5File::check_header(const std::string &format,
                                  const int max_version,
                                  const int dim,
                                  const std::string &hint) const
{
  Hdf5Header header;
  if (!has_attribute("/", "format"))
    fail("is not a file of format " + format + ": it has no attribute 'format'", hint);
  header.format = read_attribute<std::string>("/", "format");
  if (header.format != format)
    fail("has the format " + header.format + " instead of " + format, hint);
  header.version = read_attribute<int>("/", "format_version");
  if (header.version < 1 || header.version > max_version)
    fail("has version " + std::to_string(header.version) + " of the format " + format +
         ", but this program knows versions 1 to " + std::to_string(max_version));
  header.dim = read_attribute<int>("/", "dim");
  if (dim != 0 && header.dim != dim)
    fail("is " + std::to_string(header.dim) + "D, but the run is " + std::to_string(dim) +
           "D",
         hint);
  header.program_version = read_attribute<std::string>("/", "program_version");
  header.digest          = read_attribute<std::string>("/", "digest");
  return header;
}

std::string Hdf5File::change_note(const std::string &program) const
{
  switch (signature)
    {
    case Signature::valid:
      return "";
    case Signature::broken:
      return file_path + " has changed since " + program +
             " wrote it, by an edit or by damage; its numbers are used as they are";
    case Signature::missing:
      break;
    }
  return file_path +
         " has no checksum, as an earlier version or another program wrote it: "
         "whether it is as " +
         program + " wrote it is not known; its numbers are used as they are";
}

void Hdf5File::require_unit(const std::string &dataset, const std::string &unit) const
{
  if (!has_attribute(dataset, "unit"))
    return;
  const auto found = read_attribute<std::string>(dataset, "unit");
  if (found != unit)
    fail("the dataset " + dataset + " has the unit '" + found + "' instead of '" + unit +
         "'; convert its numbers, or correct the attribute");
}
} // namespace mesoslip
