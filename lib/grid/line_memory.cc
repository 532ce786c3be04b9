#include "grid/line_memory.h"

#include <cstdint>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
constexpr std::size_t line = 64, large = 1 << 16;

// Only advice: where the system does not know it, pages come when they are written.
void make_pages_present(void *memory, const std::size_t bytes)
{
#ifdef MADV_POPULATE_WRITE
  const auto page            = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto address         = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (address + page - 1) / page * page;
  const std::uintptr_t end   = (address + bytes) / page * page;
  if (end > first)
    (void)madvise(static_cast<char *>(memory) + (first - address), end - first,
                  MADV_POPULATE_WRITE);
#else
  (void)memory;
  (void)bytes;
#endif
}
} // namespace

void *line_memory(const std::size_t bytes)
{
  const std::size_t whole_lines =
    std::max<std::size_t>((bytes + line - 1) / line, 1) * line;
  void *memory = std::aligned_alloc(line, whole_lines);
  if (memory == nullptr)
    throw std::bad_alloc();
  if (whole_lines >= large)
    make_pages_present(memory, whole_lines);
  return memory;
}
} // namespace mesoslip
