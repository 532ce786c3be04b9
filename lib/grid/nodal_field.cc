#include "grid/nodal_field.h"

#include <deal.II/base/exceptions.h>

#include <cstdint>
#include <new>
#include <sys/mman.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
constexpr std::size_t cache_line = 64, large = 1 << 16;

// The call is advice only: if the system ignores it, pages are mapped at their first
// write.
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

void *internal::line_memory(const std::size_t bytes)
{
  const std::size_t whole_lines =
    std::max<std::size_t>((bytes + cache_line - 1) / cache_line, 1) * cache_line;
  void *memory = std::aligned_alloc(cache_line, whole_lines);
  if (memory == nullptr)
    throw std::bad_alloc();
  if (whole_lines >= large)
    make_pages_present(memory, whole_lines);
  return memory;
}

template <typename Number>
NodalField<Number>::NodalField(const unsigned int n_columns,
                               const unsigned int n_rows,
                               const unsigned int n_components,
                               const unsigned int ghost_rows)
  : components(n_components)
  , rows(n_rows)
  , columns(n_columns)
  , ghost_rows(ghost_rows)
  , array_stride(whole_vectors<Number>(n_columns + 1) + 2 * lanes<Number>)
{
  // An odd number of cache lines keeps equal columns off the same cache set.
  if ((array_stride / lanes<Number>) % 2 == 0)
    array_stride += lanes<Number>;
  data.resize((rows + 2 * std::size_t{ghost_rows}) * stride());
}

template <typename Number>
template <typename Other>
void NodalField<Number>::convert_from(const NodalField<Other> &other)
{
  const unsigned int n = columns + 2, end = whole_vectors<Number>(columns) + 1;
  const int ghosts = static_cast<int>(ghost_rows);
  for (int j = -ghosts; j < static_cast<int>(rows) + ghosts; ++j)
    for (unsigned int c = 0; c < components; ++c)
      {
        const Other *from = other.row(c, j) - 1;
        Number *to        = row(c, j) - 1;
        for (unsigned int i = 0; i < n; ++i)
          to[i] = static_cast<Number>(from[i]);
        for (unsigned int i = n; i < end; ++i)
          to[i] = 0;
      }
}

template <typename Number>
void NodalField<Number>::fill_ghosts(const bool x, const bool y)
{
  if (x)
    for (unsigned int j = 0; j < rows; ++j)
      for (unsigned int c = 0; c < components; ++c)
        {
          Number *p  = row(c, j);
          p[-1]      = p[columns - 1];
          p[columns] = p[0];
        }
  Assert(!y || ghost_rows > 0, dealii::ExcMessage("there are no rows to fill"));
  for (unsigned int c = 0; y && c < components; ++c)
    {
      std::copy_n(row(c, rows - 1) - 1, columns + 2, row(c, -1) - 1);
      std::copy_n(row(c, 0) - 1, columns + 2, row(c, rows) - 1);
    }
}

template class NodalField<float>;
template class NodalField<double>;
template void NodalField<float>::convert_from(const NodalField<float> &);
template void NodalField<float>::convert_from(const NodalField<double> &);
template void NodalField<double>::convert_from(const NodalField<float> &);
template void NodalField<double>::convert_from(const NodalField<double> &);
} // namespace mesoslip
