#ifndef mesoslip_io_hdf5_tables_h
#define mesoslip_io_hdf5_tables_h

#include "io/hdf5/bytes.h"

#include <functional>
#include <string>
#include <vector>

// What groups and datasets in chunks refer to, "HDF5 File Format Specification Version
// 3.0", III. Each function throws a Damage.
namespace mesoslip
{
namespace hdf5
{
/** The names of a group's members ("local heap", III.D). */
class Names
{
public:
  /** Those that begin at @p address. */
  Names(const RawFile &file, const std::uint64_t address);

  /** The one that begins there. */
  std::string at(const std::uint64_t offset) const;

private:
  void check_free_blocks(std::uint64_t offset) const;

  std::vector<unsigned char> data;
  /** Texts that begin before this byte have an end. */
  std::size_t ends = 0;
};

/** A "version 1 B-tree" (III.A.1): of the members of a group, or of chunks. */
struct Tree
{
  std::uint64_t type;    ///< 0 or 1
  std::size_t key_bytes; ///< before each child, and after the last
  std::uint64_t most;    ///< children of a node
  /** For each key. */
  std::function<void(Bytes)> check_key;
  /** For each child of a leaf, with the key before it. */
  std::function<void(std::uint64_t, Bytes)> visit;
};

/** Calls check_key and visit for the tree that begins at @p root. */
void walk(const RawFile &file, const Tree &tree, const std::uint64_t root);
} // namespace hdf5
} // namespace mesoslip

#endif
