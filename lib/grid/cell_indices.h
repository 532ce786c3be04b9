#ifndef mesoslip_grid_cell_indices_h
#define mesoslip_grid_cell_indices_h

#include "grid/nodal_field.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace mesoslip
{
/** Phases or materials of cells that are stored elsewhere, in one byte each or in two. */
class CellView
{
public:
  /** Of a byte each. */
  template <typename Allocator>
  explicit CellView(const std::vector<std::uint8_t, Allocator> &id)
    : bytes(id.data())
    , n(id.size())
  {
  }

  /** Of two bytes each. */
  template <typename Allocator>
  explicit CellView(const std::vector<std::uint16_t, Allocator> &id)
    : words(id.data())
    , n(id.size())
  {
  }

  /** Of cell @p k. */
  unsigned int operator[](const std::size_t k) const
  {
    return bytes != nullptr ? bytes[k] : words[k];
  }

  /** Number of cells. */
  std::size_t size() const
  {
    return n;
  }

  /** @p count of them from number @p first on. */
  CellView part(const std::size_t first, const std::size_t count) const
  {
    CellView some = *this;
    if (bytes != nullptr)
      some.bytes += first;
    else
      some.words += first;
    some.n = count;
    return some;
  }

private:
  const std::uint8_t *bytes  = nullptr;
  const std::uint16_t *words = nullptr;
  std::size_t n              = 0;
};

/**
 * A number for each cell as kernels read them: in a byte each or, where these are too small
 * for the largest, in two.
 */
class CellIndices
{
public:
  CellIndices() = default;

  /** @p n times @p largest, above which no index is. */
  CellIndices(const std::size_t n, const std::size_t largest)
  {
    if (is_wide(largest))
      wide.assign(n, static_cast<std::uint16_t>(largest));
    else
      narrow.assign(n, static_cast<std::uint8_t>(largest));
  }

  /** What text() of those of another rank was. */
  CellIndices(const std::string &text, const std::size_t largest)
  {
    if (is_wide(largest))
      wide.resize(text.size() / sizeof(std::uint16_t));
    else
      narrow.resize(text.size());
    std::memcpy(is_wide(largest) ? static_cast<void *>(wide.data()) : narrow.data(),
                text.data(), text.size());
  }

  /** Whether indices up to @p largest take two bytes. */
  static bool is_wide(const std::size_t largest)
  {
    return largest > 255;
  }

  /** Number @p k. */
  unsigned int operator[](const std::size_t k) const
  {
    return wide.empty() ? narrow[k] : wide[k];
  }

  /** Sets number @p k. */
  void set(const std::size_t k, const unsigned int index)
  {
    if (wide.empty())
      narrow[k] = static_cast<std::uint8_t>(index);
    else
      wide[k] = static_cast<std::uint16_t>(index);
  }

  /** All of them, as long as these live. */
  CellView view() const
  {
    return wide.empty() ? CellView(narrow) : CellView(wide);
  }

  /** All of them, for another rank. */
  std::string text() const
  {
    if (wide.empty())
      return {narrow.begin(), narrow.end()};
    std::string bytes(wide.size() * sizeof(std::uint16_t), '\0');
    std::memcpy(bytes.data(), wide.data(), bytes.size());
    return bytes;
  }

  /** Those of a byte; null if they take two. */
  const std::uint8_t *bytes() const
  {
    return wide.empty() ? narrow.data() : nullptr;
  }

  /** Those of two bytes; null if they take one. */
  const std::uint16_t *words() const
  {
    return wide.empty() ? nullptr : wide.data();
  }

private:
  LineVector<std::uint8_t> narrow; ///< one of them is empty
  LineVector<std::uint16_t> wide;
};
} // namespace mesoslip

#endif
