#ifndef mesoslip_tests_fuzz_hdf5_edits_h
#define mesoslip_tests_fuzz_hdf5_edits_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace mesoslip_tests
{
/**
 * The file that the fuzzer's input @p data makes of a @p valid HDF5 file. First byte,
 * modulo 4, 0: the rest is the file; 1: single bytes, runs and the length are changed
 * (edit_bytes()); else: its objects, through the library, which leaves a well-formed file
 * of wrong content: objects missing, exchanged, of other types and shapes (also far
 * larger than the file), linked in circles or to nowhere, other attributes and values.
 */
std::string
edited(const std::string &valid, const std::uint8_t *data, const std::size_t size);
} // namespace mesoslip_tests

#endif
