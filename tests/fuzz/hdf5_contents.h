#ifndef mesoslip_tests_fuzz_hdf5_contents_h
#define mesoslip_tests_fuzz_hdf5_contents_h

#include "byte_edits.h"

#include <hdf5.h>

#include <vector>

namespace mesoslip_tests
{
/** A type of number, text, structure, list or reference; to be closed. */
hid_t some_type(Choices &choices);

/** A dataspace; id is to be closed. */
struct Space
{
  hid_t id           = -1;
  std::size_t values = 0; ///< 0 as well if there are too many to be written
  std::vector<hsize_t> extents;
};

/** Of rank 0 to 5 and sometimes far larger than a file, or without any value. */
Space some_space(Choices &choices);

/** Bytes for @p n values of any type but those that hold addresses. */
std::vector<char> some_values(Choices &choices, const hid_t type, const std::size_t n);

/** Whether values in memory are addresses, which arbitrary bytes are not. */
bool holds_addresses(const hid_t type);
} // namespace mesoslip_tests

#endif
