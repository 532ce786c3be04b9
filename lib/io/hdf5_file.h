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

/** Matches any extent in an expected Shape. */
constexpr std::size_t any_extent = static_cast<std::size_t>(-1);

/** Result of comparing a file with its signature. */
enum class Signature
{
  missing, ///< no signature: the file is older, or of another program
  valid,   ///< the content is unchanged
  broken   ///< the content has changed
};

/** Number type of a dataset that is filled row by row. */
enum class StoredNumber
{
  float64,
  byte ///< whole numbers from 0 to 255
};

/** "[3][41][61][2]"; an any_extent prints as "[*]". */
std::string to_text(const Shape &shape);

/**
 * An identifier of the HDF5 library (hid_t), closed by the destructor; negative if there
 * is none.
 */
class Hdf5Handle
{
public:
  /** Takes ownership of @p identifier. */
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

  /** Closes the identifier; false if that fails. */
  bool close();

  /** The identifier for functions of the library. */
  operator std::int64_t() const
  {
    return id;
  }
  /** Whether there is an identifier. */
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
 * right name is complete. Only rank 0 writes files, except with ParallelRows.
 *
 * Types of values: double, float, int, unsigned int, std::int64_t, std::uint64_t,
 * std::uint8_t and std::string. Reading converts between number types, except floating
 * point to integer; numbers that are not finite and texts that are not UTF-8 are errors.
 * Texts are written with a fixed length and read with a fixed or a variable one. Names
 * are absolute paths ("/grid"); missing groups are created.
 *
 * Every failure is a UserError that names file and dataset. The @p hint of a reading
 * function is added when the object is missing: "was rve_homogenization run with KUBC?".
 * The first bytes of a file are a checksum of the rest (hdf5/internal.h), which open()
 * compares: see change_note(). Numbers that are not finite are not written:
 * NumericalFailure.
 * After a failure in writing (the disk is full) the file remains `<path>.part`, and a
 * completed file of that name is untouched; see writing_has_failed().
 */
class Hdf5File
{
public:
  /** Creates a new file; close() replaces an existing one of that name. */
  static Hdf5File create(const std::string &path);

  /** Opens for reading. */
  static Hdf5File open(const std::string &path, const std::string &hint = "");

  /** Opens a file for reading that rank 0 has already opened, without checking the
   * checksum again. */
  static Hdf5File open_too(const std::string &path);

  /**
   * Opens a file to continue writing: `<path>.part` as left by flush() or an
   * interruption, or a completed one, which becomes `<path>.part` again.
   * @throws UserError also if the process that wrote it was killed during flush() or
   * close().
   */
  static Hdf5File resume(const std::string &path, const std::string &hint = "");

  /**
   * Whether writing of any file has failed. The library crashes when it closes such a
   * file, at the latest in MPI_Finalize or exit: the process has to end with std::_Exit.
   */
  static bool writing_has_failed();

  /** Moves the open file. */
  Hdf5File(Hdf5File &&other) = default;
  ~Hdf5File();

  /** Writes buffers, closes, and gives a written file its final name. */
  void close();

  /**
   * Writes buffers. If the process dies later, having written only by write_row() since,
   * resume() accepts the file.
   */
  void flush();

  /** Waits until written data are on the disk. */
  void sync();

  /** flush(), then closes the file as `<path>.part`, for ParallelRows or resume(). */
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

  /** Shape of a dataset.
   * @throws UserError also if its numbers lie in another file (virtual datasets) that is
   * missing or too short. */
  Shape shape(const std::string &name, const std::string &hint = "") const;

  /** Whether a dataset holds floating point numbers. */
  bool is_floating(const std::string &name) const;

  /** Creates a group unless it exists. */
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

  /** T as for write_attribute().
   * @throws UserError if it is missing or of another type or number of values */
  template <typename T>
  T read_attribute(const std::string &object,
                   const std::string &name,
                   const std::string &hint = "") const;

  /** Whether the object exists and has the attribute. */
  bool has_attribute(const std::string &object, const std::string &name) const;

  /** Whether the header marks the file as a draft. */
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
  /** Writes @p data of this @p shape; replaces a dataset of the same name. */
  template <typename T>
  void write(const std::string &name, const Shape &shape, const std::vector<T> &data);

  /** Creates a dataset of numbers T of this shape, to be filled by ParallelRows or
   * write_row(). */
  template <typename T = double>
  void reserve(const std::string &name, const Shape &shape);

  /**
   * Creates a dataset of numbers to be filled with write_row(), or changes the number of
   * rows of an existing one; the first axis is the row. All its space is reserved at
   * once, so writing a row changes nothing else in the file. @p n_together short rows
   * form a chunk.
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
   * All values, row-major.
   * @throws UserError if the shape differs from @p expected (if not empty; any_extent
   * matches all) or values are not finite
   */
  template <typename T>
  std::vector<T> read(const std::string &name,
                      const Shape &expected   = {},
                      const std::string &hint = "") const;

  /** Reads a part of a dataset: @p count values from @p offset along each axis. */
  template <typename T>
  std::vector<T> read_block(const std::string &name,
                            const Shape &offset,
                            const Shape &count,
                            const std::string &hint = "") const;
  /** @} */

  /**
   * A sentence for the user if the file may differ from the one that @p program wrote
   * (its checksum differs or is missing); empty otherwise.
   */
  std::string change_note(const std::string &program) const;

  /** The checksum of the content if change_note() is not empty; else empty, as the digest
   * identifies the content. */
  std::string changed_content() const;

  /** @throws UserError if @p dataset has an attribute `unit` other than @p unit. */
  void require_unit(const std::string &dataset, const std::string &unit) const;

  /** Root attributes `format`, `format_version`, `dim`, `program_version`, `digest`. */
  void write_header(const std::string &format,
                    const int version,
                    const int dim,
                    const std::string &digest);

  /**
   * Checks that this is a @p format file of version 1 to @p max_version; @p dim 0
   * accepts any. @p hint says where such a file comes from.
   * @return the digest of the input that determines its content
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
  /** Result of the checksum of a file that was opened for reading. */
  Signature signature    = Signature::valid;
  int pending_exceptions = 0;
};
} // namespace mesoslip

#endif
