#ifndef mesoslip_elasticity_instruction_set_h
#define mesoslip_elasticity_instruction_set_h

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The row kernels are compiled once for each of these and chosen at run time. They differ
 * in the vector width and in the use of fused multiply-add, hence in round-off;
 * everything else that selects a path (ranks, wavefront) leaves every bit as it is.
 */
enum class InstructionSet
{
  /** Best one the processor has, or the one named by the environment variable
   *  MESOSLIP_ISA (x86-64, x86-64-v3, x86-64-v4). */
  automatic,
  /** SSE2, 128 bits, no fused multiply-add. */
  x86_64,
  /** AVX2 and FMA, 256 bits. */
  x86_64_v3,
  /** AVX-512, 512 bits. */
  x86_64_v4
};

/** Name as understood by MESOSLIP_ISA. */
std::string to_string(const InstructionSet isa);

/** What this processor can run, baseline first. */
std::vector<InstructionSet> available_instruction_sets();

/**
 * Replace `automatic` by a definite instruction set. Throws std::runtime_error when the
 * requested one (argument or MESOSLIP_ISA) is unknown or not available here.
 */
InstructionSet resolve(const InstructionSet requested);
} // namespace mesoslip

#endif
