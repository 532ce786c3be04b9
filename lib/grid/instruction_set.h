#ifndef mesoslip_grid_instruction_set_h
#define mesoslip_grid_instruction_set_h

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Instruction sets of the row kernels, which are compiled once for each set
 * (kernel_variants.h) and chosen at run time. Results differ by round-off, because of the
 * vector width and fused multiply-add. Ranks and temporal blocking do not change a bit.
 */
enum class InstructionSet
{
  /**
   * The best set of this processor, or the value of the environment variable
   * MESOSLIP_ISA.
   */
  automatic,
  /**
   * The common set of the processor family, 128-bit vectors without fused multiply-add:
   * x86-64 (SSE2), on other processors "generic".
   */
  baseline,
  /** AVX2 and FMA, 256 bits; x86-64 only. */
  x86_64_v3,
  /** AVX-512, 512 bits; x86-64 only. */
  x86_64_v4
};

/** Name as understood by instruction_set() and MESOSLIP_ISA. */
std::string to_string(const InstructionSet isa);

/** Instruction sets of this processor, baseline first. */
std::vector<InstructionSet> available_instruction_sets();

/**
 * Instruction set by name; "auto" is `automatic`. @throws UserError for an unknown name
 * on this processor family
 */
InstructionSet instruction_set(const std::string &name);

/**
 * Replaces `automatic` by a definite instruction set. @throws UserError if the requested
 * set (argument or MESOSLIP_ISA) is unknown or not available here
 */
InstructionSet resolve(const InstructionSet requested);

/** The function for an instruction set, from a list made by MESOSLIP_VARIANTS. */
template <typename Function, std::size_t n>
Function variant(const Function (&functions)[n], const InstructionSet isa)
{
  return functions[static_cast<std::size_t>(resolve(isa)) - 1];
}
} // namespace mesoslip

#endif
