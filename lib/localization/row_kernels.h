#ifndef mesoslip_localization_row_kernels_h
#define mesoslip_localization_row_kernels_h

#include <cstddef>

namespace mesoslip
{
/**
 * @name Loops over one row of cells
 * Arrays that are written overlap no other. Vectorized by the compiler for three
 * instruction sets, the processor's being picked when the program starts.
 * @{
 */

/** Voigt components of a row: xx, yy, xy, one array each. */
struct ConstRow
{
  const double *xx; ///< first normal component
  const double *yy; ///< second normal component
  const double *xy; ///< shear (engineering for strains)
};

/** As ConstRow, to be written. */
struct Row
{
  double *xx; ///< first normal component
  double *yy; ///< second normal component
  double *xy; ///< shear (engineering for strains)

  /** The same arrays, read only. */
  operator ConstRow() const
  {
    return {xx, yy, xy};
  }
};

/**
 * Mean strain (engineering shear) of @p n bilinear cells between two rows of n + 1 nodes
 * whose displacements are stored as x, y, x, y, ...; @p hx and @p hy (m) are the sides
 * of a cell.
 */
void strain_row(const double *lower,
                const double *upper,
                const std::size_t n,
                const double hx,
                const double hy,
                const Row &strain);

/**
 * stress = M strain; M is 9 arrays at distances of @p stride, row-major: array 3 r + c
 * holds M(r, c) of all cells.
 */
void stress_row(const double *matrix,
                const std::size_t stride,
                const ConstRow &strain,
                const std::size_t n,
                const Row &stress);

/**
 * Adds the von Mises stress to @p sum, with sigma_zz = ratio (sigma_xx + sigma_yy);
 * @p work holds @p n numbers and is overwritten.
 */
void add_von_mises_row(const ConstRow &stress,
                       const double *ratio,
                       const std::size_t n,
                       double *work,
                       double *sum);

/** Running mean after the sample number 1 / @p inverse. */
void add_mean_row(const double *value,
                  const std::size_t n,
                  const double inverse,
                  double *mean);

/** Running mean and sum of squared deviations from it (Welford). */
void add_moments_row(const double *value,
                     const std::size_t n,
                     const double inverse,
                     double *mean,
                     double *squares);

/** target += weight source */
void add_scaled_row(const double *source,
                    const std::size_t n,
                    const double weight,
                    double *target);

/** target[i] = weight[2 i] source[first[i]] + weight[2 i + 1] source[first[i] + 1] */
void gather_pairs_row(const double *source,
                      const unsigned int *first,
                      const double *weight,
                      const std::size_t n,
                      double *target);
/** @} */
} // namespace mesoslip

#endif
