#include "contact/contact_function.h"

namespace mesoslip
{
ContactFunction contact_function(const InstructionSet isa)
{
  switch (resolve(isa))
    {
    case InstructionSet::x86_64_v4:
      return contact_kernels::x86_64_v4::advance;
    case InstructionSet::x86_64_v3:
      return contact_kernels::x86_64_v3::advance;
    default:
      return contact_kernels::x86_64::advance;
    }
}
} // namespace mesoslip
