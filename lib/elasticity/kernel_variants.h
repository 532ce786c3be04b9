#ifndef mesoslip_elasticity_kernel_variants_h
#define mesoslip_elasticity_kernel_variants_h

/**
 * The kernels of rows are compiled from one source once for each instruction set of the
 * processor family, each time in a namespace of its own (cmake/MesoslipTargets.cmake
 * defines MESOSLIP_VARIANT for all but the baseline). Macros only: an inline function
 * that several variants instantiate could be taken from the wrong one by the linker, so
 * kernels keep the standard library out.
 *
 * MESOSLIP_FOR_EACH_VARIANT(DO) expands DO(namespace) for each variant,
 * MESOSLIP_VARIANTS(f) lists the functions f of all of them in the order of
 * InstructionSet.
 */
#if defined(__x86_64__)
#  define MESOSLIP_FOR_EACH_VARIANT(DO) DO(baseline) DO(x86_64_v3) DO(x86_64_v4)
#  define MESOSLIP_VARIANTS(f)                \
    {                                         \
      baseline::f, x86_64_v3::f, x86_64_v4::f \
    }
#else
#  define MESOSLIP_FOR_EACH_VARIANT(DO) DO(baseline)
#  define MESOSLIP_VARIANTS(f) \
    {                          \
      baseline::f              \
    }
#endif

#ifndef MESOSLIP_VARIANT
#  define MESOSLIP_VARIANT baseline
#endif

#endif
