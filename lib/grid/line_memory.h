#ifndef mesoslip_grid_line_memory_h
#define mesoslip_grid_line_memory_h

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>

namespace mesoslip
{
/** Returns to the system what line_memory() took. */
struct FreeLineMemory
{
  /** Null is fine. */
  void operator()(void *memory) const
  {
    std::free(memory);
  }
};

/** Numbers that begin on a cache line. */
template <typename Number>
using LineArray = std::unique_ptr<Number[], FreeLineMemory>;

/**
 * At least @p bytes of memory that begin on a cache line. All pages of a large piece are
 * asked for at once: one by one, when first written, they take twice as long.
 * @throws std::bad_alloc
 */
void *line_memory(const std::size_t bytes);

/** @p n zeros that begin on a cache line. */
template <typename Number>
LineArray<Number> line_zeros(const std::size_t n)
{
  LineArray<Number> numbers(static_cast<Number *>(line_memory(n * sizeof(Number))));
  std::fill_n(numbers.get(), n, Number(0));
  return numbers;
}
} // namespace mesoslip

#endif
