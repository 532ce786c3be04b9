#ifndef mesoslip_program_machine_h
#define mesoslip_program_machine_h

namespace mesoslip
{
/** How many of all ranks run on the machine of this one, which share its memory.
 *  Collective. */
unsigned int ranks_of_this_machine();

/** Share of all ranks that runs on the machine of this one. Collective. */
double share_of_this_machine();
} // namespace mesoslip

#endif
