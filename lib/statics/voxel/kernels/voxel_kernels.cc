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
#include "statics/voxel/kernels/flat_impl.h"
//
#include "statics/voxel/kernels/vectors_impl.h"

#define MESOSLIP_KINDS(Material, Number, kind, ...)                              \
  {                                                                              \
    sweep<Number, Material<Number, Cells::isotropic __VA_ARGS__>, Sweep::kind>,  \
      sweep<Number, Material<Number, Cells::cubes __VA_ARGS__>, Sweep::kind>,    \
      sweep<Number, Material<Number, Cells::general __VA_ARGS__>, Sweep::kind>,  \
      flat_sweep<Number, Material<Number, Cells::flat __VA_ARGS__>, Sweep::kind> \
  }
#define MESOSLIP_MATERIALS(Number, kind)                                       \
  {                                                                            \
    nullptr, nullptr, sweep<Number, OfMaterials<Number>, Sweep::kind>, nullptr \
  }
#define MESOSLIP_SOURCES(kind)                                                        \
  {                                                                                   \
    MESOSLIP_KINDS(Stored, float, kind, ),                                            \
      MESOSLIP_KINDS(OfPhases, float, kind, , true),                                  \
      MESOSLIP_KINDS(OfPhases, float, kind, , false), MESOSLIP_MATERIALS(float, kind) \
  }

const Kernels &kernels()
{
  static const Kernels table = {MESOSLIP_SOURCES(product),
                                MESOSLIP_SOURCES(residual),
                                MESOSLIP_SOURCES(chebyshev),
                                {{nullptr, nullptr, nullptr, nullptr},
                                 MESOSLIP_KINDS(OfPhases, double, outer, , true),
                                 MESOSLIP_KINDS(OfPhases, double, outer, , false),
                                 MESOSLIP_MATERIALS(double, outer)},
                                few_phases,
                                first_step,
                                combine,
                                dot,
                                mixed_dot,
                                step};
  return table;
}
#undef MESOSLIP_SOURCES
#undef MESOSLIP_MATERIALS
#undef MESOSLIP_KINDS
} // namespace mesoslip::voxel::MESOSLIP_VARIANT
