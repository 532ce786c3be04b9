#ifndef mesoslip_io_archive_h
#define mesoslip_io_archive_h

#include "io/errors.h"
#include "io/state_archive.h"

#include <boost/archive/binary_oarchive.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/stream.hpp>

#include <new>
#include <stdexcept>
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
 * Restores @p object. A serialize() may throw std::length_error when what it has loaded
 * does not fit together.
 * @throws UserError "<source>: ..." if @p bytes are no such state.
 */
template <typename T>
void load_state(const std::string &bytes, T &object, const std::string &source)
{
  const std::string damaged = source + " is damaged: the state in it cannot be read";
  try
    {
      StateBuffer buffer(bytes);
      StateArchive(buffer) >> object;
    }
  catch (const boost::archive::archive_exception &)
    {
      throw UserError(damaged);
    }
  catch (const std::length_error &)
    {
      throw UserError(damaged);
    }
  catch (const std::bad_alloc &)
    {
      throw UserError(damaged + ", or there is not enough memory for it");
    }
}
} // namespace mesoslip

#endif
