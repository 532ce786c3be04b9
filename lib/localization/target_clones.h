#ifndef mesoslip_localization_target_clones_h
#define mesoslip_localization_target_clones_h

/**
 * Before a loop over one row of cells: the compiler vectorizes it for three instruction sets,
 * of which that of the processor is picked when the program starts.
 */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#  define MESOSLIP_CLONES \
    __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#  define MESOSLIP_CLONES
#endif

#endif
