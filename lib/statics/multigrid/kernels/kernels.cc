#include "statics/multigrid/kernels/kernels.h"

#include "elasticity/kernel_variants.h"
#include "grid/instruction_set.h"

namespace mesoslip::multigrid
{
const Kernels &kernels()
{
  using Tables                 = const Kernels &(*)();
  const Tables tables[]        = MESOSLIP_VARIANTS(kernels);
  static const Kernels &chosen = variant(tables, InstructionSet::automatic)();
  return chosen;
}
} // namespace mesoslip::multigrid
