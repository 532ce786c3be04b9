#include "elasticity/instruction_set.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace mesoslip
{
std::string to_string(const InstructionSet isa)
{
  switch (isa)
    {
    case InstructionSet::x86_64:
      return "x86-64";
    case InstructionSet::x86_64_v3:
      return "x86-64-v3";
    case InstructionSet::x86_64_v4:
      return "x86-64-v4";
    default:
      return "automatic";
    }
}

std::vector<InstructionSet> available_instruction_sets()
{
  std::vector<InstructionSet> sets = {InstructionSet::x86_64};
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    sets.push_back(InstructionSet::x86_64_v3);
  if (sets.size() == 2 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512vl"))
    sets.push_back(InstructionSet::x86_64_v4);
  return sets;
}

namespace
{
InstructionSet from_environment(const std::vector<InstructionSet> &available)
{
  const char *name = std::getenv("MESOSLIP_ISA");
  if (name == nullptr || *name == '\0')
    return available.back();
  for (const InstructionSet isa :
       {InstructionSet::x86_64, InstructionSet::x86_64_v3, InstructionSet::x86_64_v4})
    if (to_string(isa) == name)
      return isa;
  throw std::runtime_error("MESOSLIP_ISA is '" + std::string(name) +
                           "'; use x86-64, x86-64-v3 or x86-64-v4");
}
} // namespace

InstructionSet resolve(const InstructionSet requested)
{
  const std::vector<InstructionSet> available = available_instruction_sets();
  const InstructionSet isa =
    requested == InstructionSet::automatic ? from_environment(available) : requested;
  if (std::find(available.begin(), available.end(), isa) == available.end())
    throw std::runtime_error("this processor cannot run the instruction set " +
                             to_string(isa));
  return isa;
}
} // namespace mesoslip
