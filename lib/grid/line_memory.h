#ifndef mesoslip_grid_line_memory_h
#define mesoslip_grid_line_memory_h

#include <cstddef>
#include <cstdlib>
#include <vector>

namespace mesoslip
{
/**
 * At least @p bytes of memory that begin on a cache line. All pages of a large piece are
 * asked for at once: one by one, when first written, they take twice as long.
 * @throws std::bad_alloc
 */
void *line_memory(const std::size_t bytes);

/** An allocator of containers whose numbers begin on a cache line. */
template <typename Number>
struct LineAllocator
{
  using value_type = Number; ///< for the container

  LineAllocator() = default;

  /** Allocators of all types are equal. */
  template <typename Other>
  LineAllocator(const LineAllocator<Other> &)
  {
  }

  /** Memory for @p n numbers. */
  Number *allocate(const std::size_t n)
  {
    return static_cast<Number *>(line_memory(n * sizeof(Number)));
  }

  /** Returns it. */
  void deallocate(Number *memory, const std::size_t)
  {
    std::free(memory);
  }

  /** Each one can free what another has allocated. */
  friend bool operator==(const LineAllocator &, const LineAllocator &)
  {
    return true;
  }

  /** See operator==(). */
  friend bool operator!=(const LineAllocator &, const LineAllocator &)
  {
    return false;
  }
};

/** Numbers that begin on a cache line. */
template <typename Number>
using LineVector = std::vector<Number, LineAllocator<Number>>;
} // namespace mesoslip

#endif
