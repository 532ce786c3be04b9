#ifndef mesoslip_program_other_program_h
#define mesoslip_program_other_program_h

#include <string>

namespace mesoslip
{
class RawParameters;

/**
 * @throws UserError if the subsections of a .prm belong to a program other than
 * @p program: at least one belongs only to the other program, and none only to
 * @p program.
 */
void refuse_file_of_other_program(const RawParameters &raw, const std::string &program);
} // namespace mesoslip

#endif
