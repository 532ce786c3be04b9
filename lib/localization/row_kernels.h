#ifndef mesoslip_localization_row_kernels_h
#define mesoslip_localization_row_kernels_h

#include <array>
#include <cstddef>

namespace mesoslip
{
/** Strain of a row of cells: arrays of xx, yy and xy (engineering shear). */
using StrainRow = std::array<const double *, 3>;

/**
 * @name Loops over one row of cells
 * Arrays that are written overlap no other. Vectorized by the compiler for three
 * instruction sets, the processor's being picked when the program starts.
 * @{
 */

/**
 * Mean strain (engineering shear) of @p n bilinear cells between two rows of n + 1 nodes
 * whose displacements are stored as x, y, x, y, ...; the factors are 1/2 over the sides of
 * a cell (1/m).
 */
void strain_row(const double *lower,
                const double *upper,
                const std::size_t n,
                const double x_factor,
                const double y_factor,
                double *xx,
                double *yy,
                double *xy);

/**
 * stress = M strain (e0, e1, e2); M is 9 arrays at distances of @p stride, row-major: array
 * 3 r + c holds M(r, c) of all cells.
 */
void stress_row(const double *matrix,
                const std::size_t stride,
                const double *e0,
                const double *e1,
                const double *e2,
                const std::size_t n,
                double *s0,
                double *s1,
                double *s2);

/**
 * Adds the von Mises stress to @p sum, with sigma_zz = ratio (sigma_xx + sigma_yy);
 * @p work holds @p n numbers and is overwritten.
 */
void add_von_mises_row(const double *xx,
                       const double *yy,
                       const double *xy,
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
