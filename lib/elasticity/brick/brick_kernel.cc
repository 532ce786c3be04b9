// The kernels of boxes of bricks of one instruction set. Compiled once for each set, see
// kernel_variants.h.
#include "elasticity/brick/brick_kernel.h"

#if defined(__x86_64__)
#  include <immintrin.h>
#endif

namespace mesoslip::kernels::MESOSLIP_VARIANT
{
namespace
{
#include "elasticity/simd.h"
//
#include "elasticity/brick/brick_impl.h"
//
#include "elasticity/brick/layer_impl.h"
//
#include "elasticity/brick/rows_impl.h"
//
#include "elasticity/brick/finish_impl.h"
//
#include "elasticity/brick/sweep_impl.h"
} // namespace

BrickKernels brick_kernels()
{
  return {
    {advance<n_cubes>, advance<n_isotropic>, advance<n_orthotropic>, advance<n_general>},
    {multiply<n_cubes>, multiply<n_isotropic>, multiply<n_orthotropic>,
     multiply<n_general>},
    copy_plane};
}
} // namespace mesoslip::kernels::MESOSLIP_VARIANT
