#ifndef mesoslip_io_hdf5_messages_h
#define mesoslip_io_hdf5_messages_h

#include "io/hdf5/bytes.h"

#include <cstdint>

// Messages in object headers, "HDF5 File Format Specification Version 3.0", IV.A.2. Each
// function throws a Damage about the message that it is given.
namespace mesoslip
{
namespace hdf5
{
/** Type numbers of the messages that matter here. */
enum class Message : std::uint64_t
{
  link_info      = 0x02,
  datatype       = 0x03,
  link           = 0x06,
  layout         = 0x08,
  attribute      = 0x0c,
  continuation   = 0x10,
  symbol_table   = 0x11,
  attribute_info = 0x15
};

/** A number or a text, of fixed or variable length, which lies in its place. */
void check_attribute(Bytes message);

/** Numbers are those of machines of today; types of which nothing is read may be any. */
void check_dataset_type(Bytes message);

/** The links of the group are in its header. */
void check_link_info(Bytes message);

/** Address of the object, undefined_address for a link by name. */
std::uint64_t linked_object(Bytes message);

/** Of a dataset in chunks: the tree that lists them, and length of its keys. */
struct ChunkTree
{
  std::uint64_t address = undefined_address; ///< undefined_address: no chunks
  std::size_t key_bytes = 0;                 ///< Tree::key_bytes
};

/** From the layout of a dataset; none for one that is not in chunks. */
ChunkTree chunk_tree(Bytes layout);
} // namespace hdf5
} // namespace mesoslip

#endif
