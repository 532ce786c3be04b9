#ifndef mesoslip_io_hdf5_structure_h
#define mesoslip_io_hdf5_structure_h

#include <string>

namespace mesoslip
{
namespace hdf5
{
/**
 * What is wrong with the structure of an HDF5 file, "an attribute of /grid is longer than
 * its place"; empty if nothing.
 *
 * The library (1.10) believes what a file says of sizes and places: of a damaged one it
 * copies what lies behind in memory, or goes round in a circle until there is no more. So
 * the objects, attributes, groups and lists of chunks are gone through here before it
 * opens the file. Of the kinds that the format has those pass that are written here, and
 * by h5py unless asked for others; values of datasets are not looked at.
 */
std::string structure_problem(const std::string &path);
} // namespace hdf5
} // namespace mesoslip

#endif
