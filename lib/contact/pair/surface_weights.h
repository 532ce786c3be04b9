#ifndef mesoslip_contact_pair_surface_weights_h
#define mesoslip_contact_pair_surface_weights_h

#include <array>
#include <cstddef>
#include <vector>

namespace mesoslip
{
/** A sparse matrix by rows. */
struct SparseRows
{
  /** What a row has in a column. */
  struct Entry
  {
    unsigned int column; ///< its number
    double weight;       ///< the value
  };

  std::vector<std::size_t> start = {0}; ///< of each row in the entries and, last, of none
  std::vector<Entry> entries;           ///< of the rows, one after the other

  /** Number of rows. */
  std::size_t n_rows() const
  {
    return start.size() - 1;
  }

  /** Ends the row that entries were added to. */
  void end_row()
  {
    start.push_back(entries.size());
  }

  /** Row @p k times @p values, of which each column has @p n, one after the other. */
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

/** What each node of a contact meets of the nodes of the surface below it: a matrix W with rows of the sum one, so that W u is what
 * the surface below moves by under the nodes, and W^T f what forces f on the nodes are on that surface. */
class SurfaceWeights
{
public:
  SurfaceWeights() = default;

  /** W, of @p n_below columns. */
  SurfaceWeights(SparseRows weights, const std::size_t n_below)
    : rows(std::move(weights))
    , columns(rows.transposed(n_below))
  {
  }

  /** Whether each node has one partner of its own, so that no force reaches the nodes beside it. */
  bool are_partners() const
  {
    return rows.entries.size() == rows.n_rows();
  }

  /** Row @p k of W times @p values of the surface below. */
  double of(const double *values, const std::size_t k) const
  {
    return rows.times<1>(values, k)[0];
  }

  /** W^T times @p forces, @p n of each node, into those @p below. */
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

  /** For each node j below the sum over k of |W_kj|. */
  std::vector<double> reach() const;

  SparseRows rows;    ///< W
  SparseRows columns; ///< W^T
};
} // namespace mesoslip

#endif
