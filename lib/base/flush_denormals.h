#ifndef mesoslip_base_flush_denormals_h
#define mesoslip_base_flush_denormals_h

#include <cfenv>
#ifdef __x86_64__
#  include <xmmintrin.h>
#endif

namespace mesoslip
{
/**
 * Flushes subnormal numbers to zero during its lifetime. Values that decay along a line
 * otherwise become subnormal, which costs hundreds of cycles per operation. Does nothing
 * on processors other than x86-64 and ARM.
 */
class FlushDenormals
{
public:
  /** Sets the flags of this thread; the destructor restores them. */
  FlushDenormals()
  {
    std::fegetenv(&saved);
#if defined(__x86_64__)
    constexpr unsigned int flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
#elif defined(__aarch64__)
    constexpr unsigned long flush_to_zero = 1UL << 24;
    unsigned long control;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    asm volatile("msr fpcr, %0" : : "r"(control | flush_to_zero));
#endif
  }
  ~FlushDenormals()
  {
    std::fesetenv(&saved);
  }

private:
  std::fenv_t saved;
};
} // namespace mesoslip

#endif
