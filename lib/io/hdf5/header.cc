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

std::string Hdf5File::check_header(const std::string &format,
                                   const int max_version,
                                   const int dim,
                                   const std::string &hint) const
{
  if (!has_attribute("/", "format"))
    fail("is not a file of format " + format + ": it has no attribute 'format'", hint);
  const auto found = read_attribute<std::string>("/", "format");
  if (found != format)
    fail("has the format " + found + " instead of " + format, hint);
  const int file_version = read_attribute<int>("/", "format_version");
  if (file_version < 1 || file_version > max_version)
    fail("has version " + std::to_string(file_version) + " of the format " + format +
         ", but this program knows versions 1 to " + std::to_string(max_version));
  const int file_dim = read_attribute<int>("/", "dim");
  if (dim != 0 && file_dim != dim)
    fail("is " + std::to_string(file_dim) + "D, but the run is " + std::to_string(dim) +
           "D",
         hint);
  return read_attribute<std::string>("/", "digest");
}

std::string Hdf5File::change_note(const std::string &program) const
{
  if (signature == Signature::valid)
    return "";
  if (signature == Signature::broken)
    return file_path + " has changed since " + program +
           " wrote it, by an edit or by damage; its numbers are used as they are";
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
