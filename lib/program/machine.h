#ifndef mesoslip_program_machine_h
#define mesoslip_program_machine_h

namespace mesoslip
{
/** Number of ranks on the machine of this rank, which share its memory. Collective. */
unsigned int ranks_of_this_machine();

/** Share of all ranks on the machine of this rank. Collective. */
double share_of_this_machine();
} // namespace mesoslip

#endif
