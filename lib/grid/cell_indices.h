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
/**
 * View of phases or materials of cells in memory of the caller, with one or two bytes
 * each.
 */
class CellView
{
public:
  /** View of one byte per cell. */
  template <typename Allocator>
  explicit CellView(const std::vector<std::uint8_t, Allocator> &id)
    : bytes(id.data())
    , n(id.size())
  {
  }

  /** View of two bytes per cell. */
  template <typename Allocator>
  explicit CellView(const std::vector<std::uint16_t, Allocator> &id)
    : words(id.data())
    , n(id.size())
  {
  }

  /** Index of cell @p k. */
  unsigned int operator[](const std::size_t k) const
  {
    return bytes != nullptr ? bytes[k] : words[k];
  }

  /** Number of cells. */
  std::size_t size() const
  {
    return n;
  }

  /** View of @p count cells from cell @p first on. */
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
 * Index of each cell in the format of the kernels: one byte each, or two if one is too
 * small for the largest index.
 */
class CellIndices
{
public:
  CellIndices() = default;

  /** @p n indices equal to @p largest, the upper bound of all indices. */
  CellIndices(const std::size_t n, const std::size_t largest)
  {
    if (is_wide(largest))
      wide.assign(n, static_cast<std::uint16_t>(largest));
    else
      narrow.assign(n, static_cast<std::uint8_t>(largest));
  }

  /** Restores the indices from text() of another rank. */
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

  /** Index of cell @p k. */
  unsigned int operator[](const std::size_t k) const
  {
    return wide.empty() ? narrow[k] : wide[k];
  }

  /** Sets the index of cell @p k. */
  void set(const std::size_t k, const unsigned int index)
  {
    if (wide.empty())
      narrow[k] = static_cast<std::uint8_t>(index);
    else
      wide[k] = static_cast<std::uint16_t>(index);
  }

  /** View of all indices; valid during the lifetime of this object. */
  CellView view() const
  {
    return wide.empty() ? CellView(narrow) : CellView(wide);
  }

  /** All indices as bytes to be sent to another rank. */
  std::string text() const
  {
    if (wide.empty())
      return {narrow.begin(), narrow.end()};
    std::string bytes(wide.size() * sizeof(std::uint16_t), '\0');
    std::memcpy(bytes.data(), wide.data(), bytes.size());
    return bytes;
  }

  /** Indices of one byte; null if they have two. */
  const std::uint8_t *bytes() const
  {
    return wide.empty() ? narrow.data() : nullptr;
  }

  /** Indices of two bytes; null if they have one. */
  const std::uint16_t *words() const
  {
    return wide.empty() ? nullptr : wide.data();
  }

private:
  LineVector<std::uint8_t> narrow; ///< narrow or wide is empty
  LineVector<std::uint16_t> wide;
};
} // namespace mesoslip

#endif
