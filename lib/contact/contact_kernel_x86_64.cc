// Compiled for x86-64, see contact_kernel.cmake. Keep the standard library out.
#include "contact/contact_kernel.h"

#include <cstdint>
#include <immintrin.h>

namespace mesoslip
{
namespace contact_kernels
{
namespace x86_64
{
#include "elasticity/simd.h"
//
#include "contact/contact_kernel_impl.h"
} // namespace x86_64
} // namespace contact_kernels
} // namespace mesoslip
