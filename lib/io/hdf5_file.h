#ifndef mesoslip_io_hdf5_file_h
#define mesoslip_io_hdf5_file_h

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** Extents of an n-dimensional array, slowest axis first; empty for a scalar. */
using Shape = std::vector<std::size_t>;

/** Stands for "any" in an expected Shape. */
constexpr std::size_t any_extent = static_cast<std::size_t>(-1);

/** What the line at the begin of a file says of the bytes after it. */
enum class Signature
{
  missing, ///< there is none: the file is older, or of another program
  valid,   ///< they are those that were signed
  broken   ///< they have changed
};

/** How a dataset that is filled row by row keeps its numbers. */
enum class StoredNumber
{
  float64,
  byte ///< whole numbers from 0 to 255
};

/** "[3][41][61][2]"; an any_extent prints as "[*]". */
std::string to_text(const Shape &shape);

/**
 * An identifier of the HDF5 library (its hid_t), which is closed at the end of its life;
 * negative if there is none.
 */
class Hdf5Handle
{
public:
  /** Owns @p identifier from now on. */
  explicit Hdf5Handle(const std::int64_t identifier = -1)
    : id(identifier)
  {
  }
  /** Takes over the identifier of @p other. */
  Hdf5Handle(Hdf5Handle &&other) noexcept
    : id(std::exchange(other.id, -1))
  {
  }
  /** Exchanges the identifiers. */
  Hdf5Handle &operator=(Hdf5Handle &&other) noexcept
  {
    std::swap(id, other.id);
    return *this;
  }
  ~Hdf5Handle()
  {
    close();
  }

  /** Closes what the identifier stands for; false if that fails. */
  bool close();

  /** The identifier, as the functions of the library take it. */
  operator std::int64_t() const
  {
    return id;
  }
  /** Whether it stands for anything. */
  bool valid() const
  {
    return id >= 0;
  }

private:
  std::int64_t id;
};

/**
 * One HDF5 file. A file being written has the name `<path>.part` until close() (or the
 * destructor, unless an exception is under way) gives it its name, so that a file of the
 * right name is complete. Only rank 0 writes files, but for ParallelRows.
 *
 * Types of values: double, float, int, unsigned int, std::int64_t, std::uint64_t,
 * std::uint8_t and std::string. Reading converts between number types, except floating
 * point to integer; numbers that are not finite and texts that are not UTF-8 are errors.
 * Texts are written with a fixed length and read with a fixed or a variable one.
 * Names are absolute paths ("/grid"); missing groups are created.
 *
 * Every failure is a UserError that names file and dataset. The @p hint of a reading
 * function is added when the object is missing: "was rve_homogenization run with KUBC?".
 * The first bytes of a file are a checksum of the others (hdf5/internal.h), which open()
 * compares: see change_note(). Numbers that are not finite are not written:
 * NumericalFailure.
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

  /** Opens for reading what rank 0 has opened, without comparing the checksum once more. */
  static Hdf5File open_too(const std::string &path);

  /**
   * Opens a file for more to be written: `<path>.part` as flush() or an interruption has
   * left it, or a completed one, which becomes `<path>.part` again.
   * @throws UserError also if the process that wrote it was killed during flush() or
   * close().
   */
  static Hdf5File resume(const std::string &path, const std::string &hint = "");

  /**
   * Whether the writing of any file has failed. The library crashes when it closes such a
   * file, at the latest in MPI_Finalize or exit: the process has to end with std::_Exit.
   */
  static bool writing_has_failed();

  /** Moves the open file. */
  Hdf5File(Hdf5File &&other) = default;
  ~Hdf5File();

  /** Writes what is buffered, closes, and gives a written file its final name. */
  void close();

  /**
   * Writes what is buffered, so that a process that dies after it, and writes only
   * write_row() before it does, leaves a file that resume() takes.
   */
  void flush();

  /** Waits until what was written is on the disk. */
  void sync();

  /** flush(), and closes the file as `<path>.part`, for ParallelRows or resume(). */
  void leave();

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

  /** Extents of a dataset. @throws UserError also if numbers of it lie in another file, as those of
   * virtual datasets do, which is not there or too short. */
  Shape shape(const std::string &name, const std::string &hint = "") const;

  /** Whether a dataset holds floating point numbers. */
  bool is_floating(const std::string &name) const;

  /** Does nothing if it exists. */
  void create_group(const std::string &name);

  /** Removes a group or dataset, if it exists. */
  void remove(const std::string &name);

  /**
   * @name Attributes of a group or dataset
   * @{
   */
  /** T: a type of values, a std::vector of it, or a std::array of two numbers. */
  template <typename T>
  void
  write_attribute(const std::string &object, const std::string &name, const T &value);

  /** T as for write_attribute(); missing or of another type or number: an error. */
  template <typename T>
  T read_attribute(const std::string &object,
                   const std::string &name,
                   const std::string &hint = "") const;

  /** False as well when there is no such object. */
  bool has_attribute(const std::string &object, const std::string &name) const;

  /** Whether the header says that it is a draft. */
  bool is_draft() const;

  /** Attribute `unit` of a dataset: SI symbols, "-" for pure numbers. */
  void write_unit(const std::string &dataset, const std::string &unit)
  {
    write_attribute(dataset, "unit", unit);
  }
  /** @} */

  /**
   * @name Datasets
   * @{
   */
  /** Writes @p data, as many values as the shape says; replaces one of the same name. */
  template <typename T>
  void write(const std::string &name, const Shape &shape, const std::vector<T> &data);

  /** Creates a dataset of numbers T of this shape for ParallelRows or write_row() to fill. */
  template <typename T = double>
  void reserve(const std::string &name, const Shape &shape);

  /**
   * Creates a dataset of numbers to be filled with write_row(), or gives one that exists
   * another number of rows; its first axis counts the rows. All its
   * space is reserved at once, so that writing a row changes nothing else in the file.
   * Short rows are kept together, @p n_together of them.
   */
  void reserve_rows(const std::string &name,
                    const Shape &shape,
                    const std::size_t n_together = 1,
                    const StoredNumber stored    = StoredNumber::float64);

  /** Writes whole rows from number @p row on of a dataset made by reserve() or reserve_rows(). */
  template <typename T = double>
  void
  write_row(const std::string &name, const std::size_t row, const std::vector<T> &values);

  /**
   * All values, row-major. A dataset of another shape than @p expected (if not empty;
   * any_extent matches all) or with values that are not finite is an error.
   */
  template <typename T>
  std::vector<T> read(const std::string &name,
                      const Shape &expected   = {},
                      const std::string &hint = "") const;

  /** Part of a dataset: @p count values from @p offset along each axis. */
  template <typename T>
  std::vector<T> read_block(const std::string &name,
                            const Shape &offset,
                            const Shape &count,
                            const std::string &hint = "") const;
  /** @} */

  /**
   * A sentence for the user if the file is not known to be as @p program wrote it (its
   * checksum differs or is missing); empty otherwise.
   */
  std::string change_note(const std::string &program) const;

  /** The checksum of the bytes where change_note() has something to say; else empty, as the digest tells the content. */
  std::string changed_content() const;

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
   * @return the digest of what determines its content
   */
  std::string check_header(const std::string &format,
                           const int max_version,
                           const int dim           = 0,
                           const std::string &hint = "") const;

private:
  Hdf5File(const std::string &path, const std::int64_t file, const bool write);

  [[noreturn]] void fail(const std::string &what, const std::string &hint = "") const;
  [[noreturn]] void fail_writing(const std::string &what);
  Hdf5Handle open_object(const std::string &name, const std::string &hint) const;
  Hdf5Handle open_dataset(const std::string &name, const std::string &hint) const;
  void require_numbers(const Hdf5Handle &dataset, const std::string &name) const;
  Shape shape_of(const Hdf5Handle &object, const std::string &text) const;
  template <typename T>
  std::vector<T> read_values(const Hdf5Handle &object,
                             const std::string &text,
                             const Shape &shape,
                             const Hdf5Handle *selection = nullptr) const;
  std::string file_path;
  Hdf5Handle file;
  bool writable = false;
  /** What the checksum said of a file that was opened for reading. */
  Signature signature    = Signature::valid;
  int pending_exceptions = 0;
};
} // namespace mesoslip

#endif
