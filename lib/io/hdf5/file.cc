#include "io/hdf5_file.h"

#include "io/checksum.h"
#include "io/errors.h"
#include "io/hdf5/internal.h"
#include "io/hdf5/structure.h"
#include "io/parameters.h"
#include "io/text.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>

namespace mesoslip
{
using hdf5::Handle;

std::string to_text(const Shape &shape)
{
  if (shape.empty())
    return "scalar";
  std::string text;
  for (const std::size_t extent : shape)
    text += "[" + (extent == any_extent ? "*" : std::to_string(extent)) + "]";
  return text;
}

namespace hdf5
{
namespace
{
std::atomic<bool> abandoned_files{false};
}

void abandon()
{
  abandoned_files = true;
}

bool abandoned()
{
  return abandoned_files;
}
} // namespace hdf5

namespace
{
/** Our messages replace the library's. */
void silence_library()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
} // namespace

Hdf5File::Hdf5File(const std::string &path)
  : file_path(path)
  , pending_exceptions(std::uncaught_exceptions())
{
  silence_library();
}

Hdf5File::Hdf5File(Hdf5File &&other) noexcept
  : file_path(std::move(other.file_path))
  , file(other.file)
  , writable(other.writable)
  , signature(other.signature)
  , broken(other.broken)
  , pending_exceptions(other.pending_exceptions)
  , extendables(std::move(other.extendables))
{
  other.file = -1;
  other.extendables.clear();
}

Hdf5File &Hdf5File::operator=(Hdf5File &&other) noexcept
{
  if (this == &other)
    return *this;
  release();
  file_path          = std::move(other.file_path);
  file               = other.file;
  writable           = other.writable;
  signature          = other.signature;
  broken             = other.broken;
  pending_exceptions = other.pending_exceptions;
  extendables        = std::move(other.extendables);
  other.file         = -1;
  other.extendables.clear();
  return *this;
}

Hdf5File::~Hdf5File()
{
  if (file >= 0 && writable && !broken &&
      std::uncaught_exceptions() == pending_exceptions)
    try
      {
        close();
      }
    catch (const std::exception &)
      {
        // Left as <path>.part; whoever needs to know calls close().
      }
  release();
}

Hdf5File Hdf5File::create(const std::string &path)
{
  Hdf5File result(path);
  const std::string part = path + ".part";
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_userblock(creation, signature_bytes);
  result.file     = H5Fcreate(part.c_str(), H5F_ACC_TRUNC, creation, access);
  result.writable = true;
  if (result.file < 0)
    throw UserError(part +
                    ": cannot be created; does its folder exist, may it be written to, "
                    "and does no other program use the file?");
  return result;
}

Hdf5File
Hdf5File::open_as(const std::string &path, const std::string &disk_name, const bool write)
{
  const hdf5::CrashGuard guard(disk_name);
  Hdf5File result(path);
  if (H5Fis_hdf5(disk_name.c_str()) == 0)
    throw UserError(disk_name + " is not an HDF5 file");
  const std::string problem = write ? "" : hdf5::structure_problem(disk_name);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  if (problem.empty())
    result.file =
      H5Fopen(disk_name.c_str(), write ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access);
  result.writable = write;
  if (result.file < 0)
    throw UserError(disk_name +
                    " cannot be opened: it is truncated, damaged, foreign, or being "
                    "written by another program" +
                    (problem.empty() ? "" : " (" + problem + ")"));
  return result;
}

Hdf5File Hdf5File::open(const std::string &path, const std::string &hint)
{
  require_readable_file("", path, hint);
  Hdf5File file  = open_as(path, path, false);
  file.signature = check_signature(path);
  return file;
}

Hdf5File Hdf5File::resume(const std::string &path, const std::string &hint)
{
  const std::string part = path + ".part";
  if (!std::filesystem::exists(part))
    {
      require_readable_file("", path, hint);
      std::filesystem::rename(path, part);
    }
  return open_as(path, part, true);
}

void Hdf5File::release() noexcept
{
  if (!hdf5::abandoned())
    {
      for (auto &[name, target] : extendables)
        H5Dclose(target.dataset);
      if (file >= 0)
        H5Fclose(file);
    }
  extendables.clear();
  file = -1;
}

void Hdf5File::flush()
{
  require_writable();
  for (auto &[name, target] : extendables)
    write_buffer(name, target);
  if (H5Fflush(file, H5F_SCOPE_LOCAL) < 0)
    fail_writing("cannot be written");
}

void Hdf5File::close()
{
  if (file < 0)
    return;
  if (writable)
    flush();
  const std::string format = writable && has_attribute("/", "format")
                               ? read_attribute<std::string>("/", "format")
                               : "mesoslip";
  for (auto &[name, target] : extendables)
    H5Dclose(target.dataset);
  extendables.clear();
  const bool closed = H5Fclose(file) >= 0;
  file              = -1;
  if (!writable)
    return;
  if (!closed)
    fail_writing("cannot be completed");
  sign_file(file_path + ".part", format);
  std::error_code code;
  std::filesystem::rename(file_path + ".part", file_path, code);
  if (code)
    fail("cannot be given its name (" + code.message() + ")");
}

void Hdf5File::fail(const std::string &what, const std::string &hint) const
{
  throw UserError(file_path + ": " + what + (hint.empty() ? "" : "; " + hint));
}

void Hdf5File::fail_writing(const std::string &what)
{
  broken = true;
  hdf5::abandon();
  fail(what + " (is the disk full?)");
}

bool Hdf5File::writing_has_failed()
{
  return hdf5::abandoned();
}

void Hdf5File::require_writable() const
{
  if (file < 0 || !writable)
    throw std::logic_error(file_path + " is not open for writing");
}

bool Hdf5File::is_member(const std::string &name) const
{
  if (H5Lexists(file, name.c_str(), H5P_DEFAULT) <= 0)
    return false;
  H5L_info_t link;
  if (H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT) < 0)
    fail(name + " cannot be found: the file is damaged");
  if (link.type != H5L_TYPE_HARD)
    fail(name + " is a link by name, which may lead to another file and is not followed; "
                "copy what it stands for into this file");
  return true;
}

bool Hdf5File::link_exists(const std::string &name) const
{
  // Every group on the way has to exist before the library may be asked for the next.
  for (std::size_t slash = name.find('/', 1); slash != std::string::npos;
       slash             = name.find('/', slash + 1))
    if (!is_member(name.substr(0, slash)))
      return false;
  return is_member(name);
}

bool Hdf5File::exists(const std::string &name) const
{
  const hdf5::CrashGuard guard(file_path);
  return name == "/" ||
         (link_exists(name) && H5Oexists_by_name(file, name.c_str(), H5P_DEFAULT) > 0);
}

std::vector<std::string> Hdf5File::list(const std::string &group,
                                        const std::string &hint) const
{
  const hdf5::CrashGuard guard(file_path);
  const Handle object(open_object(group, hint));
  if (H5Iget_type(object) != H5I_GROUP)
    fail(group + " is not a group", hint);
  const auto add = [](hid_t, const char *name, const H5L_info_t *,
                      void *names) -> herr_t {
    static_cast<std::vector<std::string> *>(names)->push_back(name);
    return 0;
  };
  std::vector<std::string> names;
  if (H5Literate(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names) < 0)
    fail("the group " + group + " cannot be read", hint);
  for (const std::string &name : names)
    if (!is_utf8(name))
      fail("the name of a member of " + group + " is not UTF-8", hint);
  return names;
}

void Hdf5File::create_group(const std::string &name)
{
  require_writable();
  if (exists(name))
    return;
  const Handle links(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  const Handle group(H5Gcreate2(file, name.c_str(), links, H5P_DEFAULT, H5P_DEFAULT));
  if (!group.valid())
    fail_writing("the group " + name + " cannot be created");
}

void Hdf5File::remove(const std::string &name)
{
  const auto open = extendables.find(name);
  if (open != extendables.end())
    {
      H5Dclose(open->second.dataset);
      extendables.erase(open);
    }
  if (link_exists(name) && H5Ldelete(file, name.c_str(), H5P_DEFAULT) < 0)
    fail_writing("the dataset " + name + " cannot be replaced");
}

Hdf5File::Id Hdf5File::open_object(const std::string &name, const std::string &hint) const
{
  if (!exists(name))
    fail(name + " is missing", hint);
  Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT));
  if (!object.valid())
    fail(name + " cannot be opened: the file is damaged", hint);
  return object.release();
}
} // namespace mesoslip
