#ifndef mesoslip_statics_voxel_kernels_kernels_h
#define mesoslip_statics_voxel_kernels_kernels_h

#include "elasticity/brick/coefficients.h"
#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between the voxel solver and its kernels, which are compiled once for each
 * instruction set. Plain structures and pointers only, see kernel_variants.h.
 *
 * A field has n[0] x n[1] x n[2] nodes, numbered from 1, and one ghost node at either
 * end of each axis: numbers 0 and n + 1. Cell number c lies between the nodes c and c +
 * 1, so there are n + 1 of them; cells outside the body have no stiffness. Rows along x
 * are `stride` numbers long and start a cache line; a field is [n[2] + 2][n[1] +
 * 2][3][stride].
 *
 * Flat cells (VoxelGrid::flat) have one row of nodes and of cells per plane, no ghosts
 * along y, and only the components along x and z: [n[2] + 2][2][stride]. Stiffness,
 * strain and stress are then times volume / (4 h_y^2), 2 h_y and volume / (2 h_y).
 */
namespace mesoslip::voxel
{
/** Kind of all cells of a grid. */
enum class Cells : unsigned int
{
  isotropic,       ///< n_isotropic coefficients
  cubes,           ///< isotropic, with equal edges
  general,         ///< n_general coefficients
  flat,            ///< n_plane coefficients, see VoxelGrid::flat
  isotropic_apart, ///< n_isotropic_apart coefficients
  general_apart,   ///< n_general_apart
  flat_apart       ///< n_plane_apart
};
constexpr unsigned int n_cells_kinds = 7; ///< see Cells

/** Whether cells are VoxelGrid::flat. */
constexpr bool is_flat(const Cells cells)
{
  return cells == Cells::flat || cells == Cells::flat_apart;
}

/** Coefficients stored per cell. */
constexpr unsigned int n_stored(const Cells cells)
{
  constexpr unsigned int n[n_cells_kinds] = {
    n_isotropic,       n_isotropic,     n_general,    n_plane,
    n_isotropic_apart, n_general_apart, n_plane_apart};
  return n[static_cast<unsigned int>(cells)];
}

/** Coefficients per phase in tables. */
constexpr unsigned int n_in_table(const Cells cells)
{
  return cells == Cells::cubes ? n_cubes : n_stored(cells);
}

/** Source of the stiffness of the cells in a sweep. */
enum class Source : unsigned int
{
  stored,     ///< coefficients of each cell
  few_phases, ///< table by phase of the cell, at most Kernels::few_phases entries
  phases,     ///< table by phase, up to 256 entries
  materials   ///< table with the numbers of a material together; general cells only
};
constexpr unsigned int n_sources = 4; ///< see Source

/** Work rows (of nodes or cells) of a sweep: [...][stride] */
constexpr unsigned int n_work_rows = 27;

/** Use of the forces K x in a sweep over all nodes. */
enum class Sweep : unsigned int
{
  product,   ///< out = K x; sum: x.K x
  residual,  ///< out = b - K x
  chebyshev, ///< d = keep d + step D^-1 (b - K x), x += d
  outer      ///< out = - K x with added strain and stress; sum: its square
};

/** Arguments of a sweep. Stiffness is the cell's stiffness times its volume over 16
 * h_y^2. */
template <typename Number>
struct SweepArguments
{
  unsigned int n[3];       ///< nodes
  std::size_t stride;      ///< length of a row
  bool periodic;           ///< periodic in x
  Number ratio[2];         ///< h_y / h_x, h_y / h_z
  Number *x;               ///< ghosts set; changed by chebyshev
  const Number *stiffness; ///< [n[2] + 1][n[1] + 1][n_stored][stride], if stored
  /** If not stored, the phases of cells [n[2] + 1][n[1] + 1][stride]. */
  const std::uint8_t *phase;
  const std::uint16_t *material; ///< used by Source::materials instead
  /** Coefficients by phase and, for outer, last 1 for phases and 0 outside the body:
   * [n_in_table + 1][256]; for materials [][n_of_material()]. */
  const Number *table;
  const float *b;           ///< right-hand side
  const float *inverse;     ///< D^-1: [n[2] + 2][n[1] + 2][n_diagonals][stride]
  unsigned int n_diagonals; ///< number of components, or 1 if all have the same
  float *d;                 ///< last increment of x
  float *out;               ///< result, zero in ghosts along x
  double *exact;            ///< result of outer in double precision, or null
  float keep;               ///< see chebyshev
  float step;               ///< see chebyshev
  bool x_is_d;              ///< chebyshev: x is its own last increment, d is not read
  bool is_last;             ///< chebyshev: d is not needed
  Number *work;             ///< n_work_rows rows, and a plane of [n[1] + 1][6][stride]
  /** @name For outer only
   * @{
   */
  Number strain[6]; ///< added strain (Voigt), times 4 h_y
  Number stress[6]; ///< added stress (Voigt), times volume over 4 h_y
  /** @} */
};

/** All kernels of one instruction set. */
struct Kernels
{
  /** A sweep for each Source and Cells. */
  template <typename Number>
  using Sweeps = double (*[n_sources][n_cells_kinds])(const SweepArguments<Number> &);

  Sweeps<float> product;   ///< see Sweep
  Sweeps<float> residual;  ///< see Sweep
  Sweeps<float> chebyshev; ///< see Sweep
  Sweeps<double> outer;    ///< see Sweep; null for stored coefficients
  unsigned int few_phases; ///< largest number of phases for Source::few_phases

  /** x = a D^-1 b, the first Chebyshev step from zero, for @p n_rows rows of
   * @p n_components; D^-1 as in SweepArguments. */
  void (*first_step)(std::size_t n_rows,
                     std::size_t stride,
                     unsigned int n_components,
                     unsigned int n_diagonals,
                     float a,
                     const float *inverse,
                     const float *b,
                     float *x);

  /**
   * @name Vectors of n numbers, n in whole cache lines
   * @{
   */
  /** y = a x + b y */
  void (*combine)(std::size_t n, float a, const float *x, float b, float *y);

  /** x.y */
  double (*dot)(std::size_t n, const float *x, const float *y);

  /** x.y */
  double (*mixed_dot)(std::size_t n, const float *x, const double *y);

  /** u += a p, r -= a q; r.r */
  double (*step)(
    std::size_t n, float a, const float *p, const float *q, double *u, float *r);
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
} // namespace mesoslip::voxel

#endif
