#include "statics/multigrid/kernels/kernels.h"

#include "elasticity/kernel_variants.h"
#include "grid/instruction_set.h"

namespace mesoslip
{
namespace multigrid
{
const Kernels &kernels()
{
  using Tables                 = const Kernels &(*)();
  const Tables tables[]        = MESOSLIP_VARIANTS(kernels);
  static const Kernels &chosen = variant(tables, InstructionSet::automatic)();
  return chosen;
}

template <>
const GridKernels<float> &grid_kernels<float>()
{
  return kernels().single;
}

template <>
const GridKernels<double> &grid_kernels<double>()
{
  return kernels().twice;
}
} // namespace multigrid
} // namespace mesoslip
