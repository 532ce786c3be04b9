#ifndef mesoslip_elasticity_brick_brick_kernel_h
#define mesoslip_elasticity_brick_brick_kernel_h

#include "elasticity/brick/coefficients.h"
#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between ordinary sources and the kernels of boxes of equal bricks, which are
 * compiled once for each instruction set (see kernel_variants.h). Plain structs only.
 *
 * The axes of a sweep are x (contiguous numbers), the rows of a plane, and the planes;
 * the caller maps them to the axes of the body. A field has one array per component, in
 * the order of these axes; rows are contiguous, and the rows of a plane follow one
 * another.
 *
 * Scratch rows, rows of cells and ghost planes are `stride` numbers long: node i is
 * number i + 1, cell c lies between the numbers c and c + 1. Cells 0 and n[0] lie across
 * a periodic side or have the phase without stiffness.
 */
namespace mesoslip::kernels
{
/** A constrained component of a node: its acceleration is zero. */
struct HeldNode
{
  std::uint32_t node;      ///< index of the node along the row
  std::uint32_t component; ///< component in the order of the sweep
};

/** The part of a box on one rank, and the data of a sweep over it. */
struct BrickSweep
{
  unsigned int n[3];  ///< distinct nodes along x, rows per plane, planes of this rank
  std::size_t stride; ///< length of rows in scratch memory
  bool periodic;      ///< whether x is periodic
  double ratio[2];    ///< cell edge along rows over edge along x, and over planes

  const std::size_t *plane_start; ///< index in a field of the first node of each plane

  /** Phases of the cells, [layer][row][stride]: layer k lies below plane k; there are
   * n[2] + 1 layers of n[1] - 1 rows. */
  const std::uint8_t *phase;
  const std::uint16_t *material; ///< material index, if too large for a byte
  bool has_layer_below;          ///< whether there are cells below the first plane
  bool has_layer_above;          ///< whether there are cells above the last plane
  unsigned int n_phases;         ///< number of phases; the last one is empty

  /**
   * Coefficients times volume / (16 edge_rows^2): [coefficient][256]; for materials
   * instead of phases [n_phases][n_of_material()].
   */
  const double *stiffness;

  unsigned int rows_at_once; ///< rows of cells per tile
  double *scratch;           ///< see scratch_size()
  double *carry;             ///< [n[2] + 1][12][stride], passed from tile to tile

  const double *below; ///< x + beta w, plane below the first: [n[1] + 1][3][stride]
  const double *above; ///< x + beta w, plane above the last: [n[1] + 1][3][stride]
};

/** State and constants of a time step. */
struct BrickStep
{
  double *u[3];           ///< displacement (m)
  double *w[3];           ///< velocity of the scheme (m/s)
  double dt;              ///< s
  double c_new;           ///< u += c_new w_(n+1) + c_old w_n (s)
  double c_old;           ///< see c_new
  double beta;            ///< damping C = alpha M + beta K (s)
  double alpha;           ///< damping C = alpha M + beta K (1/s)
  double acceleration[3]; ///< body acceleration (m/s^2), in the order of the sweep

  const double *const
    *inverse_mass; ///< inverse masses (1/kg) of each row of nodes, [plane][row]
  const std::uint32_t *held_begin; ///< begin of each row of nodes, and the end
  const HeldNode *held;            ///< by row, component, then node

  /**
   * Output: forces on the nodes of the first and the last row of all planes, which are
   * not advanced: [plane][3][n[0]] (N). If null, these rows are advanced like all others.
   */
  double *surface_force[2];
};

/** Product K x. */
struct BrickProduct
{
  const double *x[3]; ///< displacement (m)
  double *out[3];     ///< forces (N)
};

/** Size of BrickSweep::scratch, in numbers. */
constexpr std::size_t scratch_size(const std::size_t stride,
                                   const unsigned int rows_at_once)
{
  return stride * (15 + 12 * (std::size_t{rows_at_once} + 1)) + 64;
}

constexpr unsigned int n_brick_kinds = 8; ///< see BrickKernels

/**
 * Kernels of one instruction set. [0]: isotropic phases and cubes, [1]: isotropic, [2]:
 * orthotropic, [3]: general phases, [4]: general materials instead of phases; with mean
 * dilatation (coefficients.h) [5]: isotropic, [6]: general phases, [7]: general
 * materials.
 */
struct BrickKernels
{
  /** Advances the box by one time step. */
  void (*advance[n_brick_kinds])(const BrickSweep &sweep, const BrickStep &step);
  /** Computes the forces of a displacement. */
  void (*product[n_brick_kinds])(const BrickSweep &sweep, const BrickProduct &product);

  /** Copies node plane @p plane of x + beta w for other ranks: [n[1]][3][stride]. */
  void (*copy_plane)(const BrickSweep &sweep,
                     const double *const x[3],
                     const double *const w[3],
                     double beta,
                     unsigned int plane,
                     double *out);
};

#define MESOSLIP_DECLARE_BRICK_KERNELS(name) \
  namespace name                             \
  {                                          \
  BrickKernels brick_kernels();              \
  }
MESOSLIP_FOR_EACH_VARIANT(MESOSLIP_DECLARE_BRICK_KERNELS)
#undef MESOSLIP_DECLARE_BRICK_KERNELS
} // namespace mesoslip::kernels

#endif
