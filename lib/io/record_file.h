#ifndef mesoslip_io_record_file_h
#define mesoslip_io_record_file_h

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Records of n numbers each, appended to a plain file (native byte order) while a run
 * goes on. Unlike an HDF5 file it is readable whenever the process dies: records up to
 * the last complete one are there. Every failure is a UserError that names the file.
 */
class RecordFile
{
public:
  /** Begins anew. */
  RecordFile(const std::string &path, const std::size_t n_values);

  /**
   * Continues after the first @p n_records records; what follows is dropped.
   * @throws UserError if there are fewer.
   */
  RecordFile(const std::string &path,
             const std::size_t n_values,
             const std::size_t n_records);

  ~RecordFile();
  RecordFile(const RecordFile &)            = delete;
  RecordFile &operator=(const RecordFile &) = delete;

  /** @p values has as many numbers as a record. */
  void append(const std::vector<double> &values);

  /** Waits until everything is on the disk, so that a checkpoint may count on it. */
  void sync();

  /** The numbers of record @p record, from 0. @throws UserError. */
  std::vector<double> read(const std::size_t record) const;

  /** In the file now. */
  std::size_t n_records() const
  {
    return records;
  }

private:
  [[noreturn]] void fail(const std::string &what) const;
  void open_file(const int flags);

  const std::string path;
  const std::size_t n_values;
  std::size_t records = 0;
  int descriptor      = -1;
};
} // namespace mesoslip

#endif
