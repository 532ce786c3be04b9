#ifndef mesoslip_statics_multigrid_kernels_kernels_h
#define mesoslip_statics_multigrid_kernels_kernels_h

#include "elasticity/kernel_variants.h"

#include <cstddef>

/**
 * Interface between the multigrid and its row kernels, which are compiled once for each
 * instruction set. Plain structures and pointers only: an inline function that both
 * sides instantiate could be taken from the wrong side by the linker.
 *
 * Rows start a cache line, lanes are the numbers in 64 bytes; `n` is a number of columns,
 * rounded up to whole vectors by the callers that say so. A node has 2 unknowns
 * (displacement) on the finest grid and 3 (displacement, rotation) on the others:
 * functions in arrays [2] are for 2 and 3.
 */
namespace mesoslip::multigrid
{
/** Numbers of the upper triangle of the matrix of a coarse cell: 4 nodes of 3 unknowns.
 */
constexpr unsigned int n_cell_entries = 78;

/**
 * As many neighbouring coarse cells as numbers fit in 64 bytes, and the fine cells they
 * are made of. A coarse cell is 2x2 fine cells, or fewer where the grid is not halved;
 * the fine nodes are [row][column] of a 3x3 patch of which the last row or column may be
 * missing. The lane is last; arrays of lanes come first, for alignment.
 */
template <typename Number>
struct alignas(64) Patch
{
  static constexpr unsigned int n = 64 / sizeof(Number); ///< lanes: numbers in 64 bytes

  /** Weights of the corners of the coarse cell for the fine nodes. */
  Number weight[3][3][4][n];

  /** x of the fine nodes from the left side, x[2] or x[1] being the right side. */
  Number x[3][n];

  /** Extents of the coarse cell. */
  Number width[n];
  Number height; ///< of the coarse cell

  /** y of the fine nodes from the lower side. */
  Number y[3];

  /** Number of fine cell rows, 1 or 2. */
  unsigned int n_rows;
};

/** What the matrix of a cell of the finest grid is made of. */
enum FinestCoefficient : unsigned int
{
  /** Stiffness times area of the cell. */
  d11,
  d12,
  d13,
  d22,
  d23,
  d33,
  /** Of the hourglass modes: x with x, x with y, y with y. */
  h11,
  h12,
  h22,
  n_finest_coefficients
};

/** Patch of the finest grid, whose cells are 1 wide. */
struct alignas(64) FinestPatch : Patch<double>
{
  /** Of fine cells [row][column]; zero where there is none. */
  alignas(64) double coefficient[2][2][n_finest_coefficients][n];

  /** 0 for held components of the fine nodes, else 1. */
  double free_x[3][3][n];
  double free_y[3][3][n]; ///< the same for the y component

  /** Energy (times 2) of unit difference of the nodal rotations from that of the cell. */
  double rotation_stiffness[n];

  double cell_height; ///< in widths of a cell
};

/** Patch of another grid: matrices of fine cells [row][column]; zero where none. */
struct alignas(64) CoarsePatch : Patch<double>
{
  /** Upper triangle of 12 x 12 numbers. */
  alignas(64) double matrix[2][2][n_cell_entries][n];
};

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
  north_west       = 15,
  north            = 24,
  north_east       = 33,
  n_stencil_arrays = 42
};

/** What restriction and prolongation between a fine and a coarse node row need. */
template <typename Number>
struct TransferRow
{
  /** Weight of coarse node I for the fine node at the same x. */
  const Number *even = nullptr;
  /** Weights of coarse nodes I and I + 1 for the middle node of cell I. */
  const Number *odd_left  = nullptr;
  const Number *odd_right = nullptr; ///< of coarse node I + 1
  /** Distances of the middle node from coarse nodes I and I + 1. */
  const Number *to_left  = nullptr;
  const Number *to_right = nullptr; ///< from coarse node I + 1
  /** y of the fine row minus y of the coarse row. */
  Number dy = 0;
};

/** Row kernels of one grid. */
template <typename Number>
struct GridKernels
{
  /**
   * r = b - A x on one node row of a coarse grid. @p a is array 0 of the row of the
   * stencil, @p below that of the row below, arrays @p stride apart; x holds components
   * of the row below, the row, the row above. n in whole vectors.
   */
  void (*stencil_residual)(unsigned int n,
                           const Number *a,
                           const Number *below,
                           std::size_t stride,
                           const Number *const x[9],
                           const Number *const b[3],
                           Number *const r[3]);

  /** Line solver, columns, n in whole vectors: y = r - L y_before (null: y = r), then
   *  r = D^-1 y. */
  void (*eliminate[2])(unsigned int n,
                       const Number *factor,
                       std::size_t stride,
                       const Number *const y_before[],
                       Number *const y[],
                       Number *const r[]);

  /** r -= L_next^T r_next (unless @p factor_next is null); x = omega r or x += omega r.
   */
  void (*substitute[2])(unsigned int n,
                        const Number *factor_next,
                        std::size_t stride,
                        const Number *const r_next[],
                        Number *const r[],
                        Number omega,
                        bool add,
                        Number *const x[]);

  /** Solves n block equations in as many lines as numbers fit in 64 bytes:
   * tile[column][component][lane], factor[column][entry][lane]. */
  void (*solve_tile[2])(unsigned int n, const Number *factor, Number *tile);

  /** tile[column * n_components][lane] from as many rows, all of one component. This and
   *  add_tile() may treat up to 3 columns beyond n like the others. */
  void (*load_tile)(unsigned int n,
                    unsigned int n_components,
                    const Number *const rows[],
                    Number *tile);

  /** rows += omega tile, for the first @p n_lanes rows. */
  void (*add_tile)(unsigned int n,
                   unsigned int n_components,
                   unsigned int n_lanes,
                   const Number *tile,
                   Number omega,
                   Number *const rows[]);

  /** even[i] = row[2 i], odd[i] = row[2 i + 1] for i < n. */
  void (*split)(unsigned int n, const Number *row, Number *even, Number *odd);

  /** row[2 i] += even[i], row[2 i + 1] += odd[i] for i < n. */
  void (*merge)(unsigned int n, const Number *even, const Number *odd, Number *row);

  /** coarse += P^T fine. fine: even and odd part of each component; n in whole vectors;
   *  reads column -1 of the odd parts and of their weights. */
  void (*restrict_row[2])(unsigned int n,
                          const TransferRow<Number> &row,
                          const Number *const even[],
                          const Number *const odd[],
                          Number *const coarse[3]);

  /** fine = P coarse or fine += P coarse; reads one column beyond n of the coarse row. */
  void (*prolongate_row[2])(unsigned int n,
                            const TransferRow<Number> &row,
                            bool add,
                            const Number *const coarse[3],
                            Number *const even[],
                            Number *const odd[]);

  /**
   * @name Vectors of the conjugate gradients and their preconditioner, n in whole vectors
   * @{
   */
  /** p = scale z + beta p */
  void (*direction)(std::size_t n, double scale, double beta, const Number *z, double *p);

  /** y = scale x */
  void (*scaled)(std::size_t n, double scale, const double *x, Number *y);

  /** r.z and q.z */
  void (*two_dots)(
    std::size_t n, const double *r, const double *q, const Number *z, double results[2]);

  /** r = b - r */
  void (*subtract_from)(std::size_t n, const Number *b, Number *r);
  /** @} */
};

/** All row kernels of one instruction set. */
struct Kernels
{
  GridKernels<float> single; ///< for grids in single precision
  GridKernels<double> twice; ///< for grids in double precision

  /** Matrices of 8 coarse cells, entries @p stride apart. */
  void (*galerkin_finest)(const FinestPatch &patch, double *out, std::size_t stride);

  /** From a grid that is coarse already. */
  void (*galerkin_coarse)(const CoarsePatch &patch, double *out, std::size_t stride);

  /** y = A x, a full symmetric matrix with rows of @p stride numbers. */
  void (*dense)(
    unsigned int n, const double *matrix, std::size_t stride, const double *x, double *y);

  /**
   * @name Vectors of the conjugate gradients, n in whole vectors
   * @{
   */
  /** A.b. */
  double (*dot)(std::size_t n, const double *a, const double *b);

  /** x += alpha p, r -= alpha q; r.r */
  double (*step)(
    std::size_t n, double alpha, const double *p, const double *q, double *x, double *r);
  /** @} */
};

#define MESOSLIP_DECLARE_TABLE(name) \
  namespace name                     \
  {                                  \
  const Kernels &kernels();          \
  }
MESOSLIP_FOR_EACH_VARIANT(MESOSLIP_DECLARE_TABLE)
#undef MESOSLIP_DECLARE_TABLE

/** The kernels for what this processor can run (see InstructionSet::automatic). */
const Kernels &kernels();

/** Those for grids of this precision: float, double. */
template <typename Number>
const GridKernels<Number> &grid_kernels()
{
  if constexpr (sizeof(Number) == sizeof(float))
    return kernels().single;
  else
    return kernels().twice;
}
} // namespace mesoslip::multigrid

#endif
