#ifndef mesoslip_tests_benchmarks_vector_units_h
#define mesoslip_tests_benchmarks_vector_units_h

#include <algorithm>
#include <ctime>
#include <limits>
#include <map>
#include <string>

namespace mesoslip
{
#ifdef __x86_64__
#  define MESOSLIP_TWELVE(op) \
    op(4) op(5) op(6) op(7) op(8) op(9) op(10) op(11) op(12) op(13) op(14) op(15)
#  define MESOSLIP_SIX(one, other)                                                      \
    one(4) other(5) one(6) other(7) one(8) other(9) one(10) other(11) one(12) other(13) \
      one(14) other(15)
#  define MESOSLIP_FMA(k) "vfmadd231pd %%zmm0, %%zmm1, %%zmm" #  k "\n\t"
#  define MESOSLIP_ADD(k) "vaddpd %%zmm0, %%zmm" #  k ", %%zmm" #  k "\n\t"
#  define MESOSLIP_LOAD(k) "vmovapd 64*" #  k "(%0), %%zmm" #  k "\n\t"
#  define MESOSLIP_STORE(k) "vmovapd %%zmm" #  k ", 64*" #  k "(%0)\n\t"
#  define MESOSLIP_CYCLE(k) "add $1, %%rax\n\t"
#  define MESOSLIP_UNIT(text)                                                         \
    [](double *memory, const unsigned int times) {                                    \
      for (unsigned int n = 0; n < times; ++n)                                        \
        asm volatile(text                                                             \
                     :                                                                \
                     : "r"(memory)                                                    \
                     : "memory", "rax", "cc", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", \
                       "xmm9", "xmm10", "xmm11", "xmm12", "xmm13", "xmm14", "xmm15"); \
    }

/** Instructions on vectors of 512 bits, independent of one another, a nanosecond of the
 * processor's time, by kind; `cycle` are additions of which each needs the last one, one a
 * cycle. */
inline double instructions_per_ns(const std::string &kind)
{
  using Loop                              = void (*)(double *, unsigned int);
  const std::map<std::string, Loop> loops = {
    {"fma", MESOSLIP_UNIT(MESOSLIP_TWELVE(MESOSLIP_FMA))},
    {"add", MESOSLIP_UNIT(MESOSLIP_TWELVE(MESOSLIP_ADD))},
    {"mixed", MESOSLIP_UNIT(MESOSLIP_SIX(MESOSLIP_FMA, MESOSLIP_ADD))},
    {"load", MESOSLIP_UNIT(MESOSLIP_TWELVE(MESOSLIP_LOAD))},
    {"store", MESOSLIP_UNIT(MESOSLIP_TWELVE(MESOSLIP_STORE))},
    {"cycle", MESOSLIP_UNIT(MESOSLIP_TWELVE(MESOSLIP_CYCLE))}};
  alignas(64) double memory[8 * 16] = {};
  constexpr unsigned int times = 4000000, in_loop = 12;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int k = 0; k < 9; ++k)
    {
      const std::clock_t begin = std::clock();
      loops.at(kind)(memory, times);
      least = std::min(least, double(std::clock() - begin) / CLOCKS_PER_SEC);
    }
  return 1e-9 * times * in_loop / least;
}
#  undef MESOSLIP_TWELVE
#  undef MESOSLIP_SIX
#  undef MESOSLIP_FMA
#  undef MESOSLIP_ADD
#  undef MESOSLIP_LOAD
#  undef MESOSLIP_STORE
#  undef MESOSLIP_CYCLE
#  undef MESOSLIP_UNIT
#endif
} // namespace mesoslip

#endif
