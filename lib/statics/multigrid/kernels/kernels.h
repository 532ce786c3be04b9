#ifndef mesoslip_statics_multigrid_kernels_kernels_h
#define mesoslip_statics_multigrid_kernels_kernels_h

#include "elasticity/kernel_variants.h"

#include <cstddef>

/**
 * Interface between the multigrid and its row kernels, which are compiled once for each
 * instruction set. Plain structures and pointers only: an inline function that both
 * sides instantiate could be taken from the wrong side by the linker.
 *
 * Rows start a cache line, lanes are the numbers in 64 bytes; `n` is a number of
 * columns, which callers round up to whole vectors where documented. A node has 2
 * unknowns (displacement) on the finest grid and 3 (displacement, rotation) on coarse
 * grids: functions in arrays [2] are for 2 and 3.
 */
namespace mesoslip::multigrid
{
/** Entries of the upper triangle of a coarse cell's matrix: 4 nodes with 3 unknowns. */
constexpr unsigned int n_cell_entries = 78;

/**
 * A group of neighbouring coarse cells, one per lane (numbers in 64 bytes), with their
 * fine cells. A coarse cell is 2x2 fine cells, or fewer where the grid is not halved;
 * the fine nodes are [row][column] of a 3x3 patch whose last row or column may be
 * missing. The lane is the last index; arrays of lanes come first, for alignment.
 */
template <typename Number>
struct alignas(64) Patch
{
  static constexpr unsigned int n = 64 / sizeof(Number); ///< lanes: numbers in 64 bytes

  /** Weights of the corners of the coarse cell for the fine nodes. */
  Number weight[3][3][4][n];

  /** x of the fine nodes from the left side; x[2] or x[1] is the right side. */
  Number x[3][n];

  /** Width of the coarse cell. */
  Number width[n];
  Number height; ///< height of the coarse cell

  /** y of the fine nodes from the lower side. */
  Number y[3];

  /** Number of fine cell rows, 1 or 2. */
  unsigned int n_rows;
};

/** Coefficients of the matrix of a cell of the finest grid. */
enum FinestCoefficient : unsigned int
{
  /** Stiffness times area of the cell. */
  d11,
  d12,
  d13,
  d22,
  d23,
  d33,
  /** Hourglass modes: x with x, x with y, y with y. */
  h11,
  h12,
  h22,
  n_finest_coefficients
};

/** Patch of the finest grid, whose cells are 1 wide. */
struct alignas(64) FinestPatch : Patch<double>
{
  /** Per fine cell [row][column]; zero for missing cells. */
  alignas(64) double coefficient[2][2][n_finest_coefficients][n];

  /** 0 for constrained components of the fine nodes, else 1. */
  double free_x[3][3][n];
  double free_y[3][3][n]; ///< the same for the y component

  /** Twice the energy of a unit difference between the nodal rotations and the rotation
   * of the cell. */
  double rotation_stiffness[n];

  double cell_height; ///< in cell widths
};

/** Patch of a coarse grid: matrices of fine cells [row][column]; zero for missing
 * cells. */
struct alignas(64) CoarsePatch : Patch<double>
{
  /** Upper triangle of 12 x 12 numbers. */
  alignas(64) double matrix[2][2][n_cell_entries][n];
};

/** Distinct entries of the diagonal block of a node (upper triangle). */
constexpr unsigned int n_diagonal_entries(const unsigned int n_components)
{
  return n_components * (n_components + 1) / 2;
}

/** Numbers stored per node of a factorized line: multiplier and inverse pivot. */
constexpr unsigned int n_factor_entries(const unsigned int n_components)
{
  return n_components * n_components + n_diagonal_entries(n_components);
}

/** Arrays of a 9-point stencil of 3x3 blocks, half of it by symmetry. */
enum StencilArray : unsigned int
{
  /** Upper triangle of the block of the node with itself. */
  centre = 0,
  /** Node with its right neighbour; [row][column] with the neighbour's column. */
  east = 6,
  /** Upper left, upper and upper right neighbour. */
  north_west       = 15,
  north            = 24,
  north_east       = 33,
  n_stencil_arrays = 42
};

/** Data of restriction and prolongation between a fine and a coarse node row. */
template <typename Number>
struct TransferRow
{
  /** Weight of coarse node I for the fine node at the same x. */
  const Number *even = nullptr;
  /** Weights of coarse nodes I and I + 1 for the middle node of cell I. */
  const Number *odd_left  = nullptr;
  const Number *odd_right = nullptr; ///< weight of coarse node I + 1
  /** Distances of the middle node from coarse nodes I and I + 1. */
  const Number *to_left  = nullptr;
  const Number *to_right = nullptr; ///< distance from coarse node I + 1
  /** y of the fine row minus y of the coarse row. */
  Number dy = 0;
};

/** Row kernels of one grid. */
template <typename Number>
struct GridKernels
{
  /**
   * r = b - A x on one node row of a coarse grid. @p a is array 0 of this row of the
   * stencil, @p below array 0 of the row below, arrays @p stride apart; x holds
   * components of the row below, the row, the row above. n in whole vectors.
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

  /** Solves n block equations in all lanes of 64 bytes at once, one line per lane:
   * tile[column][component][lane], factor[column][entry][lane]. */
  void (*solve_tile[2])(unsigned int n, const Number *factor, Number *tile);

  /** Fills tile[column * n_components][lane] from rows of one component, one row per
   * lane. This function and add_tile() may process up to 3 columns beyond n. */
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
  GridKernels<float> single; ///< kernels in single precision
  GridKernels<double> twice; ///< kernels in double precision

  /** Matrices of 8 coarse cells, entries @p stride apart. */
  void (*galerkin_finest)(const FinestPatch &patch, double *out, std::size_t stride);

  /** Like galerkin_finest(), from a coarse grid. */
  void (*galerkin_coarse)(const CoarsePatch &patch, double *out, std::size_t stride);

  /** y = A x, a full symmetric matrix with rows of @p stride numbers. */
  void (*dense)(
    unsigned int n, const double *matrix, std::size_t stride, const double *x, double *y);

  /**
   * @name Vectors of the conjugate gradients, n in whole vectors
   * @{
   */
  /** Dot product a.b. */
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

/** The kernels for this processor (see InstructionSet::automatic). */
const Kernels &kernels();

/** The kernels for a precision: float, double. */
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
