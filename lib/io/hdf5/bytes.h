#ifndef mesoslip_io_hdf5_bytes_h
#define mesoslip_io_hdf5_bytes_h

#include <cstdint>
#include <string>
#include <vector>

// HDF5 files, byte by byte; for structure.cc.
namespace mesoslip
{
namespace hdf5
{
/** Thrown where a file is damaged. */
struct Damage
{
  std::string what; ///< "lies beyond the end": goes on after the name of something
};

/** Throws a Damage. */
inline void require(const bool holds, const char *what)
{
  if (!holds)
    throw Damage{what};
}

/** Of what the format allows, but is not read here. */
constexpr char other_kind[] = "is of a kind that no program here writes";

/** With which an HDF5 file begins. */
inline const std::string superblock_signature = "\x89HDF\r\n\x1a\n";

/** An address that stands for none. */
constexpr std::uint64_t undefined_address = ~std::uint64_t(0);

/** Bytes of a file, taken from the front; taking more than there are is a Damage. */
class Bytes
{
public:
  /** Of memory that outlives them. */
  Bytes(const unsigned char *begin, const std::size_t size);

  /** All of it. */
  explicit Bytes(const std::vector<unsigned char> &memory);
  explicit Bytes(std::vector<unsigned char> &&memory) = delete;

  /** How many there are. */
  std::size_t left() const
  {
    return size;
  }

  /** The next @p n. */
  Bytes take(const std::size_t n);

  /** Of the next @p n_bytes, at most 8, the least one first. */
  std::uint64_t number(const std::size_t n_bytes);

  /** A Damage unless the next ones are these. */
  void signature(const char *expected);

  /** Whether one of them is 0, the end of a text. */
  bool has_zero() const;

private:
  const unsigned char *begin;
  std::size_t size;
};

/** A file that is only read; addresses count from its superblock. */
class RawFile
{
public:
  /** One that cannot be read is empty. Behind a user block of signature_bytes the
   * superblock is there, otherwise at the begin. */
  explicit RawFile(const std::string &path);
  RawFile(const RawFile &)            = delete;
  RawFile &operator=(const RawFile &) = delete;
  ~RawFile();

  /** Position of the superblock: the base address that it should name. */
  std::uint64_t base() const
  {
    return start;
  }

  /** A Damage if they are not all in the file, or if the whole of it has been read many
   * times: something leads back to where it came from. */
  std::vector<unsigned char> read(const std::uint64_t address,
                                  const std::uint64_t n) const;

  /** A Damage unless they are in the file. */
  void require_inside(const std::uint64_t address, const std::uint64_t n) const;

private:
  int descriptor;
  std::uint64_t start = 0;
  /** From the superblock on. */
  std::uint64_t n_bytes        = 0;
  mutable std::uint64_t n_read = 0;
};
} // namespace hdf5
} // namespace mesoslip

#endif
