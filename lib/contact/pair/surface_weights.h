#ifndef mesoslip_contact_pair_surface_weights_h
#define mesoslip_contact_pair_surface_weights_h

#include <array>
#include <cstddef>
#include <vector>

namespace mesoslip
{
/** A sparse matrix stored by rows. */
struct SparseRows
{
  /** A matrix entry in a row. */
  struct Entry
  {
    unsigned int column; ///< column index
    double weight;       ///< value of the entry
  };

  std::vector<std::size_t> start = {0}; ///< first entry of each row, and the end
  std::vector<Entry> entries;           ///< entries, row after row

  /** Number of rows. */
  std::size_t n_rows() const
  {
    return start.size() - 1;
  }

  /** Ends the current row. */
  void end_row()
  {
    start.push_back(entries.size());
  }

  /** Row @p k times @p values, which have @p n numbers per column. */
  template <int n>
  std::array<double, n> times(const double *values, const std::size_t k) const
  {
    std::array<double, n> sum = {};
    const Entry *const end    = entries.data() + start[k + 1];
    for (const Entry *entry = entries.data() + start[k]; entry != end; ++entry)
      for (int c = 0; c < n; ++c)
        sum[c] += entry->weight * values[n * entry->column + c];
    return sum;
  }

  /** The transposed matrix, which has @p n_columns rows. */
  SparseRows transposed(const std::size_t n_columns) const;
};

/**
 * Interpolation from the surface below to the nodes of a contact: a matrix W with row
 * sums of one. W u are the displacements of the surface below at the nodes; W^T f are the
 * forces on that surface from nodal forces f.
 */
class SurfaceWeights
{
public:
  SurfaceWeights() = default;

  /** W with @p n_below columns. */
  SurfaceWeights(SparseRows weights, const std::size_t n_below)
    : rows(std::move(weights))
    , columns(rows.transposed(n_below))
  {
  }

  /**
   * Whether each node has exactly one partner, so that forces do not affect neighbours.
   */
  bool are_partners() const
  {
    return rows.entries.size() == rows.n_rows();
  }

  /** Row @p k of W times @p values of the surface below. */
  double of(const double *values, const std::size_t k) const
  {
    return rows.times<1>(values, k)[0];
  }

  /** Writes W^T times @p forces, @p n per node, to @p below. */
  template <int n>
  void spread(const std::vector<double> &forces, std::vector<double> &below) const
  {
    for (std::size_t j = 0; j < columns.n_rows(); ++j)
      {
        const std::array<double, n> sum = columns.times<n>(forces.data(), j);
        for (int c = 0; c < n; ++c)
          below[n * j + c] = sum[c];
      }
  }

  /** For each node j below: the sum over k of |W_kj|. */
  std::vector<double> reach() const;

  SparseRows rows;    ///< W
  SparseRows columns; ///< W^T
};
} // namespace mesoslip

#endif
