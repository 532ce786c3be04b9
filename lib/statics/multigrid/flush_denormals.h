#ifndef mesoslip_statics_multigrid_flush_denormals_h
#define mesoslip_statics_multigrid_flush_denormals_h

#ifdef __x86_64__
#  include <immintrin.h>
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
  FlushDenormals()
    : saved(control())
  {
#if defined(__x86_64__)
    constexpr unsigned int flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
    set_control(saved | flush_to_zero | denormals_are_zero);
#elif defined(__aarch64__)
    constexpr unsigned long flush_to_zero = 1UL << 24;
    set_control(saved | flush_to_zero);
#endif
  }
  ~FlushDenormals()
  {
    set_control(saved);
  }
  FlushDenormals(const FlushDenormals &)            = delete;
  FlushDenormals &operator=(const FlushDenormals &) = delete;

private:
#if defined(__x86_64__)
  using Control = unsigned int;
  static Control control()
  {
    return _mm_getcsr();
  }
  static void set_control(const Control value)
  {
    _mm_setcsr(value);
  }
#elif defined(__aarch64__)
  using Control = unsigned long;
  static Control control()
  {
    Control value;
    asm volatile("mrs %0, fpcr" : "=r"(value));
    return value;
  }
  static void set_control(const Control value)
  {
    asm volatile("msr fpcr, %0" : : "r"(value));
  }
#else
  using Control = unsigned int;
  static Control control()
  {
    return 0;
  }
  static void set_control(const Control)
  {
  }
#endif

  Control saved;
};
} // namespace mesoslip

#endif
