#ifndef mesoslip_elasticity_multigrid_kernels_h
#define mesoslip_elasticity_multigrid_kernels_h

#include "elasticity/multigrid/patch.h"

#include <cstddef>

/**
 * Interface between the multigrid and its row kernels, which are compiled once for each
 * instruction set. Plain structures and pointers only: an inline function that both
 * sides instantiate could be taken from the wrong side by the linker.
 *
 * Rows are floats that start a cache line; `n` is a number of columns, rounded up to
 * whole vectors by the callers that say so. A node has 2 unknowns (displacement) on the
 * finest grid and 3 (displacement, rotation) on the others: functions in arrays [2] are
 * for 2 and 3.
 */
namespace mesoslip
{
namespace multigrid
{
/** Distinct numbers of the blocks of a node: of its diagonal block (upper triangle). */
constexpr unsigned int n_diagonal_entries(const unsigned int n_components)
{
  return n_components * (n_components + 1) / 2;
}

/** Numbers that a factorized line keeps for a node: multiplier and inverse pivot. */
constexpr unsigned int n_factor_entries(const unsigned int n_components)
{
  return n_components * n_components + n_diagonal_entries(n_components);
}

/** Arrays of a 9-point stencil of 3x3 blocks, half of it by symmetry. */
enum StencilArray : unsigned int
{
  /** Upper triangle of the block of the node with itself. */
  centre = 0,
  /** Node and its right neighbour; [row][column] with the column the neighbour's. */
  east = 6,
  /** Upper left, upper and upper right neighbour. */
  north_west      = 15,
  north           = 24,
  north_east      = 33,
  n_stencil_arrays = 42
};

/** What restriction and prolongation between a fine and a coarse node row need. */
struct TransferRow
{
  /** Weight of coarse node I for the fine node at the same x. */
  const float *even = nullptr;
  /** Weights of coarse nodes I and I + 1 for the middle node of cell I. */
  const float *odd_left  = nullptr;
  const float *odd_right = nullptr;
  /** Distances of the middle node from coarse nodes I and I + 1. */
  const float *to_left  = nullptr;
  const float *to_right = nullptr;
  /** y of the fine row minus y of the coarse row. */
  float dy = 0.F;
};

struct Kernels
{
  /**
   * r = b - A x on one node row of a coarse grid. @p a is array 0 of the row of the
   * stencil, @p below that of the row below, arrays @p stride apart; x holds components
   * of the row below, the row, the row above. n in whole vectors.
   */
  void (*stencil_residual)(unsigned int n,
                           const float *a,
                           const float *below,
                           std::size_t stride,
                           const float *const x[9],
                           const float *const b[3],
                           float *const r[3]);

  /** Line solver, columns, n in whole vectors: y = r - L y_before (null: y = r), then
   *  r = D^-1 y. */
  void (*eliminate[2])(unsigned int n,
                       const float *factor,
                       std::size_t stride,
                       const float *const y_before[],
                       float *const y[],
                       float *const r[]);

  /** r -= L_next^T r_next (unless @p factor_next is null); x = omega r or x += omega r. */
  void (*substitute[2])(unsigned int n,
                        const float *factor_next,
                        std::size_t stride,
                        const float *const r_next[],
                        float *const r[],
                        float omega,
                        bool add,
                        float *const x[]);

  /** Solves n block equations in each of 16 lines at once: tile[column][component][16],
   *  factor[column][entry][16]. */
  void (*solve_tile[2])(unsigned int n, const float *factor, float *tile);

  /** tile[column * n_components][16] from 16 rows, all of one component. This and
   *  add_tile() may treat up to 3 columns beyond n like the others. */
  void (*load_tile)(unsigned int n,
                    unsigned int n_components,
                    const float *const rows[16],
                    float *tile);

  /** rows += omega tile, for the first @p n_lanes rows. */
  void (*add_tile)(unsigned int n,
                   unsigned int n_components,
                   unsigned int n_lanes,
                   const float *tile,
                   float omega,
                   float *const rows[16]);

  /** even[i] = row[2 i], odd[i] = row[2 i + 1] for i < n. */
  void (*split)(unsigned int n, const float *row, float *even, float *odd);

  /** row[2 i] += even[i], row[2 i + 1] += odd[i] for i < n. */
  void (*merge)(unsigned int n, const float *even, const float *odd, float *row);

  /** coarse += P^T fine. fine: even and odd part of each component; n in whole vectors;
   *  reads column -1 of the odd parts and of their weights. */
  void (*restrict_row[2])(unsigned int n,
                          const TransferRow &row,
                          const float *const even[],
                          const float *const odd[],
                          float *const coarse[3]);

  /** fine = P coarse or fine += P coarse; reads one column beyond n of the coarse row. */
  void (*prolongate_row[2])(unsigned int n,
                            const TransferRow &row,
                            bool add,
                            const float *const coarse[3],
                            float *const even[],
                            float *const odd[]);

  /** Matrices of 16 coarse cells, entries @p stride apart. */
  void (*galerkin_finest)(const FinestPatch &patch, float *out, std::size_t stride);
  void (*galerkin_coarse)(const CoarsePatch &patch, float *out, std::size_t stride);

  /** y = A x, a full symmetric matrix with rows of @p stride floats. */
  void (*dense)(unsigned int n,
                const float *matrix,
                std::size_t stride,
                const float *x,
                float *y);

  /** @name Vectors of the conjugate gradients, n in whole vectors @{ */
  double (*dot)(std::size_t n, const double *a, const double *b);

  /** x += alpha p, r -= alpha q; r.r */
  double (*step)(std::size_t n,
                 double alpha,
                 const double *p,
                 const double *q,
                 double *x,
                 double *r);

  /** p = scale z + beta p */
  void (*direction)(std::size_t n, double scale, double beta, const float *z, double *p);

  /** y = scale x */
  void (*narrow)(std::size_t n, double scale, const double *x, float *y);

  /** r.z and q.z */
  void (*two_dots)(std::size_t n,
                   const double *r,
                   const double *q,
                   const float *z,
                   double results[2]);

  /** r = b - r */
  void (*subtract_from)(std::size_t n, const float *b, float *r);
  /** @} */
};

namespace x86_64
{
const Kernels &kernels();
}
namespace x86_64_v3
{
const Kernels &kernels();
}
namespace x86_64_v4
{
const Kernels &kernels();
}

/** The kernels for what this processor can run (see InstructionSet::automatic). */
const Kernels &kernels();
} // namespace multigrid
} // namespace mesoslip

#endif
