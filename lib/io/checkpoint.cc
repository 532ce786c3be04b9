#include "io/checkpoint.h"

#include "base/errors.h"
#include "base/files.h"

#include <boost/crc.hpp>
#include <boost/version.hpp>

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

namespace mesoslip
{
namespace
{
/** First line of a file: describes the state, without size and CRC. Archives of different
 * Boost releases are incompatible. */
std::string heading(const std::string &kind)
{
  const std::uint16_t one = 1;
  const bool little       = *reinterpret_cast<const unsigned char *>(&one) == 1;
  return "mesoslip-checkpoint of " + kind + ", Boost " + BOOST_LIB_VERSION + ", " +
         (little ? "little" : "big") + " endian";
}

/** Size and CRC of the state: the end of the first line. */
std::string checksum(const std::string &state)
{
  boost::crc_32_type crc;
  crc.process_bytes(state.data(), state.size());
  return ": " + std::to_string(state.size()) + " bytes, CRC-32 " +
         std::to_string(crc.checksum());
}
} // namespace

void write_checkpoint(const std::string &path, const std::string &kind, std::string state)
{
  std::vector<std::string> all = {heading(kind) + checksum(state) + "\n"};
  all.push_back(std::move(state));
  try
    {
      write_file(path, all, true);
    }
  catch (const UserError &error)
    {
      throw UserError(std::string(error.what()) +
                      "; the previous checkpoint, if any, is kept");
    }
}

std::string read_checkpoint(const std::string &path, const std::string &kind)
{
  if (!std::filesystem::exists(path))
    throw UserError(path + ": there is no checkpoint to resume from");
  std::string content      = read_file(path);
  const std::string line   = content.substr(0, content.find('\n'));
  const std::string wanted = heading(kind), found = line.substr(0, line.find(':'));
  if (line.rfind("mesoslip-checkpoint ", 0) != 0)
    throw UserError(path + " is not a checkpoint of this version of mesoslip");
  if (found != wanted)
    throw UserError(path + " is a " + found + ", but this run needs a " + wanted);
  content.erase(0, line.size() + 1);
  const std::string now = checksum(content);
  if (wanted + now != line)
    throw UserError(path + " is truncated or damaged: it was written with" +
                    line.substr(wanted.size() + 1) + ", and now has" + now.substr(1) +
                    "; start again without --resume");
  return content;
}
} // namespace mesoslip
