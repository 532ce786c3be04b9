#ifndef mesoslip_statics_multigrid_kernels_patch_h
#define mesoslip_statics_multigrid_kernels_patch_h

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
} // namespace mesoslip::multigrid

#endif
