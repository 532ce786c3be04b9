#ifndef mesoslip_grid_instruction_set_h
#define mesoslip_grid_instruction_set_h

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * The row kernels are compiled once for each of these (kernel_variants.h) and chosen at
 * run time. They differ in the vector width and in the use of fused multiply-add, hence
 * in round-off; everything else that selects a path (ranks, temporal blocking) leaves
 * every bit as it is.
 */
enum class InstructionSet
{
  /** Best one the processor has, or the one named by the environment variable
   *  MESOSLIP_ISA. */
  automatic,
  /** What every processor of the family has, in vectors of 128 bits, without fused
   *  multiply-add: x86-64 (SSE2), on other processors "generic". */
  baseline,
  /** AVX2 and FMA, 256 bits; on x86-64 only. */
  x86_64_v3,
  /** AVX-512, 512 bits; on x86-64 only. */
  x86_64_v4
};

/** Name as understood by instruction_set() and MESOSLIP_ISA. */
std::string to_string(const InstructionSet isa);

/** What this processor can run, baseline first. */
std::vector<InstructionSet> available_instruction_sets();

/** By name; "auto" is `automatic`. @throws UserError when there is none of this name on
 *  processors of this family. */
InstructionSet instruction_set(const std::string &name);

/**
 * Replace `automatic` by a definite instruction set. @throws UserError when the requested one
 * (argument or MESOSLIP_ISA) is unknown or not available here.
 */
InstructionSet resolve(const InstructionSet requested);

/** The function for an instruction set, of a list made by MESOSLIP_VARIANTS. */
template <typename Function, std::size_t n>
Function variant(const Function (&functions)[n], const InstructionSet isa)
{
  return functions[static_cast<std::size_t>(resolve(isa)) - 1];
}
} // namespace mesoslip

#endif
