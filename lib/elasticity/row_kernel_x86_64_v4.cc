// Compiled for x86-64-v4, see instruction_sets.cmake. Keep the standard library out.
#include "elasticity/row_kernel.h"

#include <immintrin.h>

namespace mesoslip
{
namespace kernels
{
namespace x86_64_v4
{
#include "elasticity/simd.h"
//
#include "elasticity/row_kernel_impl.h"
//
#include "elasticity/row_kernel_select.h"
} // namespace x86_64_v4
} // namespace kernels
} // namespace mesoslip
