#include "io/record_file.h"

#include "io/errors.h"
#include "io/files.h"

#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
/** Transfers @p n bytes with pread or pwrite, however many pieces that takes. */
template <typename Transfer>
bool transfer_all(const Transfer &transfer, std::size_t n, off_t offset)
{
  std::size_t done = 0;
  while (done < n)
    {
      const ssize_t some = transfer(done, n - done, offset + static_cast<off_t>(done));
      if (some < 0 && errno == EINTR)
        continue;
      if (some <= 0)
        return false;
      done += static_cast<std::size_t>(some);
    }
  return true;
}
} // namespace

RecordFile::RecordFile(const std::string &file_path, const std::size_t values)
  : path(file_path)
  , n_values(values)
{
  open_file(O_CREAT | O_TRUNC);
}

RecordFile::RecordFile(const std::string &file_path,
                       const std::size_t values,
                       const std::size_t n_records)
  : path(file_path)
  , n_values(values)
  , records(n_records)
{
  open_file(0);
  struct stat status    = {};
  const off_t wanted    = static_cast<off_t>(records * n_values * sizeof(double));
  const bool complete   = fstat(descriptor, &status) == 0 && status.st_size >= wanted;
  const bool shortened  = complete && ftruncate(descriptor, wanted) == 0;
  const std::string why = system_message();
  if (shortened)
    return;
  close(descriptor);
  if (!complete)
    fail("has fewer than the " + std::to_string(records) +
         " records it had at the checkpoint; start again without --resume");
  fail("cannot be shortened (" + why + ")");
}

RecordFile::~RecordFile()
{
  close(descriptor);
}

void RecordFile::fail(const std::string &what) const
{
  throw UserError(path + ": " + what);
}

void RecordFile::open_file(const int flags)
{
  descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC | flags, 0666);
  if (descriptor < 0)
    fail("cannot be opened (" + system_message() + ")");
}

void RecordFile::append(const std::vector<double> &values)
{
  if (values.size() != n_values)
    throw std::logic_error(path + ": a record of another length");
  const std::size_t n   = n_values * sizeof(double);
  const auto *bytes     = reinterpret_cast<const char *>(values.data());
  const auto write_some = [&](const std::size_t done, const std::size_t left,
                              const off_t at) {
    return pwrite(descriptor, bytes + done, left, at);
  };
  if (!transfer_all(write_some, n, static_cast<off_t>(records * n)))
    fail("cannot be written (" + system_message() + ")");
  ++records;
}

void RecordFile::sync()
{
  if (fsync(descriptor) != 0)
    fail("cannot be written (" + system_message() + ")");
}

std::vector<double> RecordFile::read(const std::size_t record) const
{
  std::vector<double> values(n_values);
  const std::size_t n  = n_values * sizeof(double);
  auto *bytes          = reinterpret_cast<char *>(values.data());
  const auto read_some = [&](const std::size_t done, const std::size_t left,
                             const off_t at) {
    return pread(descriptor, bytes + done, left, at);
  };
  if (!transfer_all(read_some, n, static_cast<off_t>(record * n)))
    fail("cannot be read (" + system_message() + ")");
  return values;
}
} // namespace mesoslip
