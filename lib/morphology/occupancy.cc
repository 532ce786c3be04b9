#include "morphology/occupancy.h"

#include <algorithm>
#include <bitset>

namespace mesoslip
{
namespace
{
constexpr unsigned int bits = 64;

std::size_t n_set(const std::uint64_t word)
{
  return std::bitset<bits>(word).count();
}
} // namespace

Occupancy::Occupancy(const unsigned int n_columns, const unsigned int n_rows)
  : columns(n_columns)
  , rows(n_rows)
  , words_per_column((n_rows + bits - 1) / bits)
  , words(words_per_column * n_columns, 0)
{
}

/** Calls function(index of the word, mask of the box) until it returns false. */
template <typename Function>
void Occupancy::for_each_word(const CellBox &box, const Function &function) const
{
  if (box.empty())
    return;
  const unsigned int first = box.y_begin / bits;
  const unsigned int last  = (box.y_end - 1) / bits;
  for (unsigned int x = box.x_begin; x < box.x_end; ++x)
    for (unsigned int w = first; w <= last; ++w)
      {
        std::uint64_t mask = ~std::uint64_t(0);
        if (w == first)
          mask &= ~std::uint64_t(0) << (box.y_begin % bits);
        if (w == last)
          mask &= ~std::uint64_t(0) >> (bits - 1 - (box.y_end - 1) % bits);
        if (!function(x * words_per_column + w, mask))
          return;
      }
}

bool Occupancy::is_free(const CellBox &box) const
{
  bool free = true;
  for_each_word(box, [&](const std::size_t i, const std::uint64_t mask) {
    free = (words[i] & mask) == 0;
    return free;
  });
  return free;
}

std::size_t Occupancy::n_free(const CellBox &box) const
{
  std::size_t n = 0;
  for_each_word(box, [&](const std::size_t i, const std::uint64_t mask) {
    n += n_set(~words[i] & mask);
    return true;
  });
  return n;
}

void Occupancy::mark(const CellBox &box)
{
  for_each_word(box, [&](const std::size_t i, const std::uint64_t mask) {
    taken += n_set(~words[i] & mask);
    words[i] |= mask;
    return true;
  });
}

CellBox Occupancy::widened(const CellBox &box,
                           const unsigned int x_gap,
                           const unsigned int y_gap) const
{
  return {box.x_begin - std::min(box.x_begin, x_gap),
          box.x_end + std::min(columns - box.x_end, x_gap),
          box.y_begin - std::min(box.y_begin, y_gap),
          box.y_end + std::min(rows - box.y_end, y_gap)};
}
} // namespace mesoslip
