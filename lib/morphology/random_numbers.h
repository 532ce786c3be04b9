#ifndef mesoslip_morphology_random_numbers_h
#define mesoslip_morphology_random_numbers_h

#include <cstdint>
#include <random>

namespace mesoslip
{
/**
 * Random numbers that are the same on every machine. The standard fixes the mersenne
 * twister but not the distributions, so the mapping to numbers is our own.
 */
class RandomNumbers
{
public:
  /** The same @p seed gives the same numbers on every machine. */
  explicit RandomNumbers(const std::uint64_t seed)
    : engine(seed)
  {
  }

  /** Uniform in [0, 1), a multiple of 2^-53. */
  double unit()
  {
    return static_cast<double>(engine() >> 11) * 0x1p-53;
  }

  /** Uniform in [lower, upper). */
  double between(const double lower, const double upper)
  {
    return lower + unit() * (upper - lower);
  }

  /** Uniform among first, ..., last. */
  long whole(const long first, const long last)
  {
    return first + static_cast<long>(unit() * static_cast<double>(last - first + 1));
  }

private:
  std::mt19937_64 engine;
};
} // namespace mesoslip

#endif
