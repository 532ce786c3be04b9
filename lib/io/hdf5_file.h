#ifndef mesoslip_io_hdf5_file_h
#define mesoslip_io_hdf5_file_h

#include "io/checksum.h"

#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace mesoslip
{
/** Extents of an n-dimensional array, slowest axis first; empty for a scalar. */
using Shape = std::vector<std::size_t>;

/** Stands for "any" in an expected Shape. */
constexpr std::size_t any_extent = static_cast<std::size_t>(-1);

/** "[3][41][61][2]"; an any_extent prints as "[*]". */
std::string to_text(const Shape &shape);

/** The root attributes of an exchange file. */
struct Hdf5Header
{
  std::string format;          ///< "mesoslip-rve" and the like
  int version = 0;             ///< of the format, from 1
  int dim     = 0;             ///< of the problem
  std::string program_version; ///< of the program that wrote it
  std::string digest;          ///< of what determines the content
};

/**
 * One HDF5 file. A file being written has the name `<path>.part` until close() (or the
 * destructor, unless an exception is under way) gives it its name, so that a file of the
 * right name is complete. Only rank 0 opens files.
 *
 * Number types: double, float, int, unsigned int, std::int64_t, std::uint64_t,
 * std::uint8_t; lists of strings have functions of their own. Reading converts between
 * number types, except floating point to integer; numbers that are not finite are errors.
 * Names are absolute paths ("/grid"); missing groups are created.
 *
 * Nothing outside the file is read: links by name (soft, external), external storage and
 * virtual datasets are errors.
 *
 * Every failure is a UserError that names file and dataset. The @p hint of a reading
 * function is added when the object is missing: "was rve_homogenization run with KUBC?".
 * The first bytes of a file are a checksum of the others (checksum.h), which open()
 * compares. Numbers that are not finite are not written: NumericalFailure.
 * After a failure in writing (the disk is full) the file remains `<path>.part`, and a
 * completed file of that name is untouched; see writing_has_failed().
 */
class Hdf5File
{
public:
  /** Begins a new file, replacing one of that name when closed. */
  static Hdf5File create(const std::string &path);

  /** Opens for reading. */
  static Hdf5File open(const std::string &path, const std::string &hint = "");

  /**
   * Continues a file: `<path>.part`, as an interruption leaves it, or a completed one.
   * truncate_rows() drops what was appended after a checkpoint.
   */
  static Hdf5File resume(const std::string &path, const std::string &hint = "");

  /**
   * Whether the writing of any file has failed. The library crashes when it closes such a
   * file, at the latest in MPI_Finalize or exit: the process has to end with std::_Exit.
   */
  static bool writing_has_failed();

  /** Moves the open file. */
  Hdf5File(Hdf5File &&other) noexcept;

  /** Moves the open file. */
  Hdf5File &operator=(Hdf5File &&other) noexcept;
  Hdf5File(const Hdf5File &) = delete;
  ~Hdf5File();

  /** Writes what is buffered, closes, and gives a written file its final name. */
  void close();

  /** Writes what is buffered to the disk, so that a checkpoint may rely on it. */
  void flush();

  /** The final name. */
  const std::string &path() const
  {
    return file_path;
  }

  /** Whether a group or dataset exists. */
  bool exists(const std::string &name) const;

  /** Names of the members of a group, sorted. */
  std::vector<std::string> list(const std::string &group,
                                const std::string &hint = "") const;

  /** Extents of a dataset; rows still buffered count. */
  Shape shape(const std::string &name, const std::string &hint = "") const;

  /** Does nothing if it exists. */
  void create_group(const std::string &name);

  /**
   * @name Attributes of a group or dataset
   * @{
   */
  /** T: std::string, a number, or std::vector of numbers or strings. */
  template <typename T>
  void
  write_attribute(const std::string &object, const std::string &name, const T &value);

  /** T as for write_attribute(); missing or of another type: an error. */
  template <typename T>
  T read_attribute(const std::string &object,
                   const std::string &name,
                   const std::string &hint = "") const;

  /** False as well when there is no such object. */
  bool has_attribute(const std::string &object, const std::string &name) const;

  /** Attribute `unit` of a dataset: SI symbols, "-" for pure numbers. */
  void write_unit(const std::string &dataset, const std::string &unit)
  {
    write_attribute(dataset, "unit", unit);
  }
  /** @} */

  /**
   * @name Whole datasets; writing replaces one of the same name
   * @{
   */
  /** @p data has as many numbers as @p shape says. @p compression: 0 (off) to 9. */
  template <typename T>
  void write(const std::string &name,
             const Shape &shape,
             const std::vector<T> &data,
             const unsigned int compression = 0);

  /** @p data holds as many numbers as the shape says. */
  template <typename T>
  void write(const std::string &name,
             const Shape &shape,
             const T *data,
             const unsigned int compression = 0);

  /** A list of texts, [n]. */
  void write_strings(const std::string &name, const std::vector<std::string> &strings);

  /**
   * All values, row-major. A dataset of another shape than @p expected (if not empty;
   * any_extent matches all) or with values that are not finite is an error.
   */
  template <typename T>
  std::vector<T> read(const std::string &name,
                      const Shape &expected   = {},
                      const std::string &hint = "") const;

  /** The list that write_strings() wrote. */
  std::vector<std::string> read_strings(const std::string &name,
                                        const std::string &hint = "") const;

  /** Part of a dataset: @p count values from @p offset along each axis. */
  template <typename T>
  std::vector<T> read_block(const std::string &name,
                            const Shape &offset,
                            const Shape &count,
                            const std::string &hint = "") const;
  /** @} */

  /**
   * @name Datasets that grow along the first axis
   * @{
   */
  /**
   * Creates an empty dataset [0][row_shape...], or continues one of the same shape in a
   * resumed file. Short rows are buffered and written some thousand at a time.
   * @p compression: 0 (off) to 9.
   */
  template <typename T>
  void create_extendable(const std::string &name,
                         const Shape &row_shape,
                         const unsigned int compression = 0);

  /** Appends @p n_rows rows; T is the type it was created with. */
  template <typename T>
  void append(const std::string &name, const T *data, const std::size_t n_rows = 1);

  /** Appends one number to a dataset [steps]. */
  template <typename T,
            typename = typename std::enable_if<std::is_arithmetic<T>::value>::type>
  void append(const std::string &name, const T value)
  {
    append(name, &value, 1);
  }

  /** Keeps the first @p n_rows rows only. */
  void truncate_rows(const std::string &name, const std::size_t n_rows);
  /** @} */

  /**
   * A sentence for the user if the file is not known to be as @p program wrote it (its
   * checksum differs or is missing); empty otherwise.
   */
  std::string change_note(const std::string &program) const;

  /** @throws UserError if the attribute `unit` of @p dataset is there and another one. */
  void require_unit(const std::string &dataset, const std::string &unit) const;

  /** Root attributes `format`, `format_version`, `dim`, `program_version`, `digest`. */
  void write_header(const std::string &format,
                    const int version,
                    const int dim,
                    const std::string &digest);

  /**
   * Checks that this is a @p format file of version 1 to @p max_version; @p dim 0
   * accepts any. @p hint says where such a file comes from.
   */
  Hdf5Header check_header(const std::string &format,
                          const int max_version,
                          const int dim           = 0,
                          const std::string &hint = "") const;

private:
  /** HDF5's hid_t, so that its header stays out of ours. */
  using Id = std::int64_t;

  /** An extendable dataset with rows that wait to be written. */
  struct Extendable
  {
    Id dataset              = -1;
    Id type                 = -1;
    std::size_t row_bytes   = 0;
    std::size_t buffer_rows = 1;
    /** On the disk. */
    std::size_t rows = 0;
    Shape row_shape;
    std::vector<char> buffer;

    std::size_t buffered_rows() const
    {
      return buffer.size() / row_bytes;
    }
  };

  explicit Hdf5File(const std::string &path);
  static Hdf5File
  open_as(const std::string &path, const std::string &disk_name, const bool write);

  [[noreturn]] void fail(const std::string &what, const std::string &hint = "") const;
  [[noreturn]] void fail_writing(const std::string &what);
  void require_writable() const;
  bool is_member(const std::string &name) const;
  bool link_exists(const std::string &name) const;
  Id open_object(const std::string &name, const std::string &hint) const;
  Id open_dataset(const std::string &name, const std::string &hint) const;
  Id open_attribute(const std::string &object,
                    const std::string &name,
                    const std::string &hint) const;
  void check_storage(const std::string &name, const Id dataset) const;
  Shape shape_of(const std::string &name, const Id dataset) const;
  void check_type(const std::string &name, const Id dataset, const Id type) const;
  void check_size(const std::string &name, const Id dataset, const Shape &extents) const;
  template <typename T>
  void check_finite(const std::string &name, const std::vector<T> &data) const;

  void remove(const std::string &name);
  void write_raw(const std::string &name,
                 const Shape &shape,
                 const Id type,
                 const void *data,
                 const unsigned int compression);
  void write_string_attribute(const std::string &object,
                              const std::string &name,
                              const std::vector<std::string> &values,
                              const bool scalar);
  void write_raw_attribute(const std::string &object,
                           const std::string &name,
                           const Id type,
                           const void *values,
                           const std::size_t n,
                           const bool scalar);
  Extendable &extendable(const std::string &name, const Id type);
  Extendable &open_extendable(const std::string &name, const Id type);
  void append_raw(const std::string &name,
                  const Id type,
                  const void *data,
                  const std::size_t n_rows);
  void write_rows(const std::string &name,
                  Extendable &target,
                  const void *data,
                  const std::size_t n_rows);
  void write_buffer(const std::string &name, Extendable &target);
  void release() noexcept;

  std::string file_path;
  Id file       = -1;
  bool writable = false;
  /** Of a file that was opened for reading. */
  Signature signature = Signature::valid;
  /** Writing failed: the file is closed without getting its name. */
  bool broken            = false;
  int pending_exceptions = 0;
  std::map<std::string, Extendable> extendables;
};
} // namespace mesoslip

#endif
