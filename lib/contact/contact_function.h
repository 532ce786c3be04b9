#ifndef mesoslip_contact_contact_function_h
#define mesoslip_contact_contact_function_h

#include "contact/contact_kernel.h"
#include "grid/instruction_set.h"

namespace mesoslip
{
/** The step of the contact row compiled for an instruction set; all give the same bits.
 *  Throws std::runtime_error if the processor lacks it. */
ContactFunction contact_function(const InstructionSet isa = InstructionSet::automatic);
} // namespace mesoslip

#endif
