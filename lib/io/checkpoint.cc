#include "io/checkpoint.h"

#include "base/errors.h"
#include "base/files.h"

#include <boost/crc.hpp>

#include <filesystem>
#include <utility>

namespace mesoslip
{
namespace
{
/** What the first line of a file says of the state behind it, but for size and CRC. */
std::string heading(const CheckpointHeader &header)
{
  const std::uint16_t one = 1;
  const bool little       = *reinterpret_cast<const unsigned char *>(&one) == 1;
  return "mesoslip-checkpoint of " + header.kind + ", " + std::to_string(header.dim) +
         "D, layout " + std::to_string(header.version) + ", " +
         (little ? "little" : "big") + " endian";
}

/** Size and CRC of the state, as the first line ends. */
std::string checksum(const std::vector<std::string> &pieces)
{
  boost::crc_32_type crc;
  std::size_t size = 0;
  for (const std::string &piece : pieces)
    {
      crc.process_bytes(piece.data(), piece.size());
      size += piece.size();
    }
  return ": " + std::to_string(size) + " bytes, CRC-32 " + std::to_string(crc.checksum());
}
} // namespace

void write_checkpoint(const std::string &path,
                      const CheckpointHeader &header,
                      const std::vector<std::string> &pieces)
{
  std::vector<std::string> all = {heading(header) + checksum(pieces) + "\n"};
  all.insert(all.end(), pieces.begin(), pieces.end());
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

std::string read_checkpoint(const std::string &path, const CheckpointHeader &expected)
{
  if (!std::filesystem::exists(path))
    throw UserError(path + ": there is no checkpoint to resume from");
  std::vector<std::string> pieces = {read_file(path)};
  std::string &content            = pieces.front();
  const std::string line          = content.substr(0, content.find('\n'));
  const std::string wanted = heading(expected), found = line.substr(0, line.find(':'));
  if (line.rfind("mesoslip-checkpoint ", 0) != 0)
    throw UserError(path + " is not a checkpoint of this version of mesoslip");
  if (found != wanted)
    throw UserError(path + " is a " + found + ", but this run needs a " + wanted);
  content.erase(0, line.size() + 1);
  const std::string now = checksum(pieces);
  if (wanted + now != line)
    throw UserError(path + " is truncated or damaged: the state was written as" +
                    line.substr(wanted.size() + 1) + " and has" + now.substr(1));
  return std::move(content);
}
} // namespace mesoslip
