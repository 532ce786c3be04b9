// Kernels of boxes of bricks for one instruction set. Compiled once for each set, see
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
#include "elasticity/brick/apart_impl.h"
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
  return {{advance<OfPhases<n_cubes>>, advance<OfPhases<n_isotropic>>,
           advance<OfPhases<n_orthotropic>>, advance<OfPhases<n_general>>,
           advance<OfMaterials<n_general>>, advance<OfPhases<n_isotropic_apart>>,
           advance<OfPhases<n_general_apart>>, advance<OfMaterials<n_general_apart>>},
          {multiply<OfPhases<n_cubes>>, multiply<OfPhases<n_isotropic>>,
           multiply<OfPhases<n_orthotropic>>, multiply<OfPhases<n_general>>,
           multiply<OfMaterials<n_general>>, multiply<OfPhases<n_isotropic_apart>>,
           multiply<OfPhases<n_general_apart>>, multiply<OfMaterials<n_general_apart>>},
          copy_plane};
}
} // namespace mesoslip::kernels::MESOSLIP_VARIANT
