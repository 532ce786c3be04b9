#ifndef mesoslip_base_archive_h
#define mesoslip_base_archive_h

#include "base/errors.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/stream.hpp>

#include <exception>
#include <string>

namespace mesoslip
{
/**
 * What the serialize() of @p object saves, bit by bit, for the same program on the same
 * kind of machine.
 */
template <typename T>
std::string save_state(const T &object)
{
  std::string bytes;
  {
    boost::iostreams::stream<boost::iostreams::back_insert_device<std::string>> out(
      boost::iostreams::back_inserter(bytes));
    boost::archive::binary_oarchive(out) << object;
  }
  return bytes;
}

/**
 * Restores @p object from the bytes that save_state() gave; whoever stores them in a file
 * stores a checksum with them. More may follow them.
 * @throws UserError "<source>: ..." if they are no such state.
 */
template <typename T>
void load_state(const std::string &bytes, T &object, const std::string &source)
{
  try
    {
      boost::iostreams::stream<boost::iostreams::array_source> in(bytes.data(),
                                                                  bytes.size());
      boost::archive::binary_iarchive(in) >> object;
    }
  catch (const std::exception &error)
    {
      throw UserError(source + " is damaged: the state in it cannot be read (" +
                      error.what() + ")");
    }
}
} // namespace mesoslip

#endif
