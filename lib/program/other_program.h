#ifndef mesoslip_program_other_program_h
#define mesoslip_program_other_program_h

#include <string>

namespace mesoslip
{
class RawParameters;

/**
 * @throws UserError if the subsections of a .prm are those of another program than @p program.
 * They tell where at least one is of another program alone, and none of @p program alone.
 */
void refuse_file_of_other_program(const RawParameters &raw, const std::string &program);
} // namespace mesoslip

#endif
