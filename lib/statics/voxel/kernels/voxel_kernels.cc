// The kernels of the solver on voxels of one instruction set, and their table. Compiled
// once for each set, see kernel_variants.h.
#include "elasticity/kernel_variants.h"
#include "statics/voxel/kernels/kernels.h"

#if defined(__x86_64__)
#  include <immintrin.h>
#endif

namespace mesoslip::voxel::MESOSLIP_VARIANT
{
#include "elasticity/simd.h"
//
#include "elasticity/brick/brick_impl.h"
//
#include "elasticity/brick/layer_impl.h"
//
#include "statics/voxel/kernels/sweep_impl.h"
//
#include "statics/voxel/kernels/vectors_impl.h"

const Kernels &kernels()
{
  static const Kernels table = {
    {sweep<float, Stored<float, n_isotropic>, Sweep::product>,
     sweep<float, Stored<float, n_general>, Sweep::product>},
    {sweep<float, Stored<float, n_isotropic>, Sweep::residual>,
     sweep<float, Stored<float, n_general>, Sweep::residual>},
    {sweep<float, Stored<float, n_isotropic>, Sweep::chebyshev>,
     sweep<float, Stored<float, n_general>, Sweep::chebyshev>},
    {sweep<double, OfPhases<double, n_isotropic>, Sweep::outer>,
     sweep<double, OfPhases<double, n_general>, Sweep::outer>},
    combine,
    first_step,
    dot,
    mixed_dot,
    step};
  return table;
}
} // namespace mesoslip::voxel::MESOSLIP_VARIANT
