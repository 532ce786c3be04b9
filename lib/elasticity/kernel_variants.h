#ifndef mesoslip_elasticity_kernel_variants_h
#define mesoslip_elasticity_kernel_variants_h

/**
 * Row kernels are compiled from one source once for each instruction set of the processor
 * family, each in its own namespace (cmake/MesoslipTargets.cmake defines MESOSLIP_VARIANT
 * for all but the baseline). Macros only: the linker could take an inline function
 * instantiated by several variants from the wrong one; kernels therefore avoid the
 * standard library.
 *
 * MESOSLIP_FOR_EACH_VARIANT(DO) expands DO(namespace) for each variant,
 * MESOSLIP_VARIANTS(f) lists the functions f of all variants in the order of
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
