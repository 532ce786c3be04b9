#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "io/drafts.h"
#include "io/hdf5/internal.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

// Inlines the library's functions, so that no library has to be linked.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace mesoslip
{
namespace
{
/** First line of a file that is temporarily inconsistent. */
constexpr char unfinished[] = "unfinished";
constexpr char flushed[]    = "flushed";

/** Once true, no file is closed any more: the library (1.10) crashes when it closes a
 * file that it cannot write to, also in its own exit handlers. */
std::atomic<bool> writing_failed{false};

/** File access properties: closing a file closes all its objects. Also silences the
 * library, as our messages replace its own. */
Hdf5Handle access_properties()
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  // The oldest layout for the content, which HDF5 2 no longer selects by default: all
  // releases read it, and groups have no times, so that equal results are equal files.
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  return access;
}

/** MATLAB files of versions 5 to 7 begin with these letters; version 7.3 is HDF5 after
 * this header. */
bool starts_with_matlab(const std::string &path)
{
  std::string start(6, ' ');
  std::ifstream(path, std::ios::binary).read(start.data(), 6);
  return start == "MATLAB";
}

hid_t open_file(const std::string &path, const unsigned int mode)
{
  const Hdf5Handle access = access_properties();
  if (H5Fis_hdf5(path.c_str()) == 0)
    throw UserError(path +
                    (starts_with_matlab(path)
                       ? " is a MATLAB file of a version before 7.3, no HDF5 file; save "
                         "it again with save(..., '-v7.3')"
                       : " is not an HDF5 file"));
  const hid_t file = H5Fopen(path.c_str(), mode, access);
  if (file < 0)
    throw UserError(path +
                    " cannot be opened: it is truncated, damaged, foreign, or being "
                    "written by another program");
  return file;
}

constexpr char method[] = "xxh3-128";

/** The checksum as 32 hexadecimal digits (canonical form). */
std::string hex(const XXH128_hash_t &hash)
{
  char text[33];
  std::snprintf(text, sizeof(text), "%016" PRIx64 "%016" PRIx64, hash.high64, hash.low64);
  return text;
}

/** Checksum of all bytes after the line. */
std::string checksum_of_rest(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  in.seekg(signature_bytes);
  // A piece stays in the cache between reading and checksum.
  std::vector<char> piece(1 << 18);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  errno = 0;
  do
    {
      in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      XXH3_128bits_update(&state, piece.data(), static_cast<std::size_t>(in.gcount()));
    }
  while (in);
  if (in.bad())
    throw UserError(path + ": cannot be read (" + system_message() + ")");
  return hex(XXH3_128bits_digest(&state));
}
} // namespace

void write_first_line(const std::string &path, const std::string &line)
{
  errno = 0;
  std::fstream out(path, std::ios::binary | std::ios::in | std::ios::out);
  out << line << '\n';
  out.close();
  if (!out || line.size() >= signature_bytes)
    throw UserError(path + ": cannot be written (" + system_message() + ")");
}

std::string first_line(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  std::string head(signature_bytes, '\0');
  in.read(head.data(), signature_bytes);
  const std::size_t end = head.find('\n');
  return in && end != std::string::npos ? head.substr(0, end) : "";
}

void sign_file(const std::string &path, const std::string &format)
{
  write_first_line(path, format + " " + method + " " + checksum_of_rest(path));
}

Signature check_signature(const std::string &path)
{
  std::istringstream line(first_line(path));
  std::string format, name, checksum;
  if (!(line >> format >> name >> checksum) || name != method)
    return Signature::missing;
  return checksum_of_rest(path) == checksum ? Signature::valid : Signature::broken;
}

std::string to_text(const Shape &shape)
{
  if (shape.empty())
    return "scalar";
  std::string text;
  for (const std::size_t extent : shape)
    text += "[" + (extent == any_extent ? "*" : std::to_string(extent)) + "]";
  return text;
}

void hdf5::note_failed_writing()
{
  writing_failed = true;
}

bool Hdf5Handle::close()
{
  const std::int64_t owned = std::exchange(id, -1);
  return owned < 0 || writing_failed || H5Idec_ref(owned) >= 0;
}

Hdf5File::Hdf5File(const std::string &path, const std::int64_t file, const bool write)
  : file_path(path)
  , file(file)
  , writable(write)
  , pending_exceptions(std::uncaught_exceptions())
{
}

Hdf5File::~Hdf5File()
{
  if (file.valid() && writable && !writing_failed &&
      std::uncaught_exceptions() == pending_exceptions)
    try
      {
        close();
      }
    catch (const std::exception &)
      {
        // A failed file stays <path>.part; call close() to see errors.
      }
}

Hdf5File Hdf5File::create(const std::string &path)
{
  const Hdf5Handle access = access_properties(), creation(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_userblock(creation, signature_bytes);
  const std::string part = path + ".part";
  const hid_t file       = H5Fcreate(part.c_str(), H5F_ACC_TRUNC, creation, access);
  if (file < 0)
    throw UserError(part +
                    ": cannot be created; does its folder exist, may it be written to, "
                    "and does no other program use the file?");
  return Hdf5File(path, file, true);
}

Hdf5File Hdf5File::open(const std::string &path, const std::string &hint)
{
  require_readable_file("", path, hint);
  Hdf5File file(path, open_file(path, H5F_ACC_RDONLY), false);
  file.signature = check_signature(path);
  return file;
}

Hdf5File Hdf5File::open_too(const std::string &path)
{
  return Hdf5File(path, open_file(path, H5F_ACC_RDONLY), false);
}

Hdf5File Hdf5File::resume(const std::string &path, const std::string &hint)
{
  const std::string part = path + ".part";
  if (!std::filesystem::exists(part))
    {
      require_readable_file("", path, hint);
      H5Fclose(open_file(path, H5F_ACC_RDONLY)); // renamed only if it is good
      if (check_signature(path) == Signature::broken)
        throw UserError(path +
                        " has changed since it was written, by an edit or by damage, and "
                        "is not gone on with" +
                        (hint.empty() ? "" : "; " + hint));
      std::filesystem::rename(path, part);
    }
  if (first_line(part) == unfinished)
    throw UserError(part +
                    ": its program was killed while it wrote the file, which "
                    "cannot be gone on with; " +
                    hint);
  Hdf5File file(path, open_file(part, H5F_ACC_RDWR), true);
  if (!DraftMark::is_set() && file.is_draft())
    throw UserError(part + " is a draft, which no run goes on with; " + hint);
  return file;
}

std::string Hdf5File::changed_content() const
{
  return signature == Signature::valid ? "" : checksum_of_rest(file_path);
}

bool Hdf5File::writing_has_failed()
{
  return writing_failed;
}

void Hdf5File::flush()
{
  write_first_line(file_path + ".part", unfinished);
  if (H5Fflush(file, H5F_SCOPE_LOCAL) < 0)
    fail_writing("cannot be written");
  write_first_line(file_path + ".part", flushed);
}

void Hdf5File::sync()
{
  void *descriptor = nullptr;
  if (H5Fget_vfd_handle(file, H5P_DEFAULT, &descriptor) < 0 ||
      fsync(*static_cast<const int *>(descriptor)) != 0)
    fail_writing("cannot be written");
}

void Hdf5File::leave()
{
  flush();
  write_first_line(file_path + ".part", unfinished);
  if (!file.close())
    fail_writing("cannot be written");
  write_first_line(file_path + ".part", flushed);
}

void Hdf5File::close()
{
  if (!file.valid())
    return;
  if (!writable)
    {
      file.close();
      return;
    }
  const std::string part   = file_path + ".part";
  const std::string format = has_attribute("/", "format")
                               ? read_attribute<std::string>("/", "format")
                               : "mesoslip";
  write_first_line(part, unfinished);
  if (H5Fflush(file, H5F_SCOPE_LOCAL) < 0 || !file.close())
    fail_writing("cannot be written");
  sign_file(part, format);
  std::error_code code;
  std::filesystem::rename(part, file_path, code);
  if (code)
    fail("cannot be given its name (" + code.message() + ")");
}

void Hdf5File::fail(const std::string &what, const std::string &hint) const
{
  throw UserError(file_path + ": " + what + (hint.empty() ? "" : "; " + hint));
}

void Hdf5File::fail_writing(const std::string &what)
{
  writing_failed = true;
  fail(what + " (is the disk full?)");
}

bool Hdf5File::exists(const std::string &name) const
{
  if (name == "/")
    return true;
  // A group has to exist before the library is asked for its members.
  for (std::size_t slash = 0; slash != std::string::npos;)
    {
      slash = name.find('/', slash + 1);
      if (H5Lexists(file, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0)
        return false;
    }
  return true;
}

std::vector<std::string> Hdf5File::list(const std::string &group,
                                        const std::string &hint) const
{
  const Hdf5Handle object = open_object(group, hint);
  const auto add          = [](hid_t, const char *name, const H5L_info_t *,
                      void *names) -> herr_t {
    static_cast<std::vector<std::string> *>(names)->push_back(name);
    return 0;
  };
  std::vector<std::string> names;
  if (H5Literate(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names) < 0)
    fail(group + " is not a group, or is damaged", hint);
  if (!std::all_of(names.begin(), names.end(), is_utf8))
    fail("the name of a member of " + group + " is not UTF-8", hint);
  return names;
}

Hdf5Handle Hdf5File::open_object(const std::string &name, const std::string &hint) const
{
  if (!exists(name))
    fail(name + " is missing", hint);
  Hdf5Handle object(H5Oopen(file, name.c_str(), H5P_DEFAULT));
  if (!object.valid())
    fail(name + " cannot be opened: the file is damaged, or it is a link to what is gone",
         hint);
  return object;
}
} // namespace mesoslip
