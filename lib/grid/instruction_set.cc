#include "grid/instruction_set.h"

#include "base/errors.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace mesoslip
{
namespace
{
/** Names in the order of InstructionSet. */
const char *const set_names[] = {"auto",
#ifdef __x86_64__
                                 "x86-64",
#else
                                 "generic",
#endif
                                 "x86-64-v3", "x86-64-v4"};
} // namespace

std::string to_string(const InstructionSet isa)
{
  return set_names[static_cast<unsigned int>(isa)];
}

std::vector<InstructionSet> available_instruction_sets()
{
  std::vector<InstructionSet> sets = {InstructionSet::baseline};
#ifdef __x86_64__
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    sets.push_back(InstructionSet::x86_64_v3);
  if (sets.size() == 2 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512vl"))
    sets.push_back(InstructionSet::x86_64_v4);
#endif
  return sets;
}

InstructionSet instruction_set(const std::string &name)
{
  std::string names;
  for (unsigned int k = 0; k < std::size(set_names); ++k)
    {
      if (set_names[k] == name)
        return static_cast<InstructionSet>(k);
      names += (k == 0 ? "" : ", ") + std::string(set_names[k]);
    }
  throw UserError("there is no instruction set '" + name +
                  "' on this kind of processor; use one of " + names);
}

InstructionSet resolve(const InstructionSet requested)
{
  const std::vector<InstructionSet> available = available_instruction_sets();
  InstructionSet isa                          = requested;
  const char *name                            = std::getenv("MESOSLIP_ISA");
  if (isa == InstructionSet::automatic && name != nullptr && *name != '\0')
    try
      {
        isa = instruction_set(name);
      }
    catch (const UserError &e)
      {
        throw UserError(std::string("MESOSLIP_ISA: ") + e.what());
      }
  if (isa == InstructionSet::automatic)
    return available.back();
  if (std::find(available.begin(), available.end(), isa) == available.end())
    throw UserError("this processor cannot run the instruction set " + to_string(isa) +
                    "; use auto (Performance/Instruction set, MESOSLIP_ISA)");
  return isa;
}
} // namespace mesoslip
