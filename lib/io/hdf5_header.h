#ifndef mesoslip_io_hdf5_header_h
#define mesoslip_io_hdf5_header_h

#include "io/hdf5_internal.h"

#include <string>

namespace mesoslip
{
namespace hdf5
{
/**
 * Why the library may not be asked for the attributes of an open group or dataset of a
 * file that is only read; empty if it may. "is ...", "has ...": of one of its attributes.
 *
 * The library (1.10) believes the sizes in a damaged attribute and copies what lies
 * behind it in memory, as soon as it looks for any attribute of the object. So its header
 * is read here before: all attributes are numbers or texts, and lie where they should.
 */
std::string attribute_problem(const hid_t object);
} // namespace hdf5
} // namespace mesoslip

#endif
