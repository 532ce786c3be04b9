#ifndef mesoslip_base_flush_denormals_h
#define mesoslip_base_flush_denormals_h

#include <cfenv>
#ifdef __x86_64__
#  include <xmmintrin.h>
#endif

namespace mesoslip
{
/**
 * Numbers below the range of single precision count as zero while this lives: what decays
 * along a line would otherwise spend hundreds of cycles an operation on being denormal.
 * On processors other than x86-64 and ARM it does nothing.
 */
class FlushDenormals
{
public:
  /** From now on. */
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
