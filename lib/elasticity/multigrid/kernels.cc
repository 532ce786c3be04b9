#include "elasticity/multigrid/kernels.h"

#include "elasticity/instruction_set.h"

namespace mesoslip
{
namespace multigrid
{
namespace
{
const Kernels &choose()
{
  switch (resolve(InstructionSet::automatic))
    {
    case InstructionSet::x86_64_v4:
      return x86_64_v4::kernels();
    case InstructionSet::x86_64_v3:
      return x86_64_v3::kernels();
    default:
      return x86_64::kernels();
    }
}
} // namespace

const Kernels &kernels()
{
  static const Kernels &chosen = choose();
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
