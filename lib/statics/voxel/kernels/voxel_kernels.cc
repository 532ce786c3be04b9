// The kernels of the voxel solver for one instruction set, and their table. Compiled once
// for each set, see kernel_variants.h.
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
#include "elasticity/brick/apart_impl.h"
//
#include "elasticity/brick/layer_impl.h"
//
#include "statics/voxel/kernels/sweep_impl.h"
//
#include "statics/voxel/kernels/flat_impl.h"
//
#include "statics/voxel/kernels/vectors_impl.h"

#define MESOSLIP_SWEEP(Material, Number, kind, kind_of_cells, ...) \
  sweep<Number, Material<Number, Cells::kind_of_cells __VA_ARGS__>, Sweep::kind>
#define MESOSLIP_FLAT_SWEEP(Material, Number, kind, kind_of_cells, ...) \
  flat_sweep<Number, Material<Number, Cells::kind_of_cells __VA_ARGS__>, Sweep::kind>
#define MESOSLIP_APART(Material, Number, kind, ...)                     \
  MESOSLIP_SWEEP(Material, Number, kind, isotropic_apart, __VA_ARGS__), \
    MESOSLIP_SWEEP(Material, Number, kind, general_apart, __VA_ARGS__), \
    MESOSLIP_FLAT_SWEEP(Material, Number, kind, flat_apart, __VA_ARGS__)
#define MESOSLIP_KINDS(Material, Number, kind, ...)               \
  MESOSLIP_SWEEP(Material, Number, kind, isotropic, __VA_ARGS__), \
    MESOSLIP_SWEEP(Material, Number, kind, cubes, __VA_ARGS__),   \
    MESOSLIP_SWEEP(Material, Number, kind, general, __VA_ARGS__), \
    MESOSLIP_FLAT_SWEEP(Material, Number, kind, flat, __VA_ARGS__)
// Separate kernels for few phases with mean dilatation do not pay off: these look up any
// number.
#define MESOSLIP_OF_PHASES(Number, kind)              \
  {MESOSLIP_KINDS(OfPhases, Number, kind, , true),    \
   MESOSLIP_APART(OfPhases, Number, kind, , false)},  \
  {                                                   \
    MESOSLIP_KINDS(OfPhases, Number, kind, , false),  \
      MESOSLIP_APART(OfPhases, Number, kind, , false) \
  }
#define MESOSLIP_MATERIALS(Number, kind)                                             \
  {                                                                                  \
    nullptr, nullptr, MESOSLIP_SWEEP(OfMaterials, Number, kind, general, ), nullptr, \
      nullptr, MESOSLIP_SWEEP(OfMaterials, Number, kind, general_apart, ), nullptr   \
  }
#define MESOSLIP_SOURCES(kind)                                                      \
  {                                                                                 \
    {MESOSLIP_KINDS(Stored, float, kind, ), MESOSLIP_APART(Stored, float, kind, )}, \
      MESOSLIP_OF_PHASES(float, kind), MESOSLIP_MATERIALS(float, kind)              \
  }

const Kernels &kernels()
{
  static const Kernels table = {MESOSLIP_SOURCES(product),
                                MESOSLIP_SOURCES(residual),
                                MESOSLIP_SOURCES(chebyshev),
                                {{}, // for stored coefficients
                                 MESOSLIP_OF_PHASES(double, outer),
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
#undef MESOSLIP_OF_PHASES
#undef MESOSLIP_KINDS
#undef MESOSLIP_APART
#undef MESOSLIP_FLAT_SWEEP
#undef MESOSLIP_SWEEP
} // namespace mesoslip::voxel::MESOSLIP_VARIANT
