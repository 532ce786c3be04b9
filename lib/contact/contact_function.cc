#include "contact/contact_function.h"

namespace mesoslip
{
ContactFunction contact_function(const InstructionSet isa)
{
  using namespace contact_kernels;
  const ContactFunction functions[] = MESOSLIP_VARIANTS(advance);
  return variant(functions, isa);
}
} // namespace mesoslip
