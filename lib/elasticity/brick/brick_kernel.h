#ifndef mesoslip_elasticity_brick_brick_kernel_h
#define mesoslip_elasticity_brick_brick_kernel_h

#include "elasticity/brick/coefficients.h"
#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between the ordinary sources and the kernels of boxes of equal bricks, which are
 * compiled once for each instruction set (see kernel_variants.h). Plain structures only.
 *
 * The axes of a sweep are x (neighbouring numbers), the rows of a plane, and the planes;
 * which axes of the body these are is the caller's. A field has one array for each
 * component, in the order of these axes, in which a row of nodes is contiguous and the rows
 * of a plane follow one another.
 *
 * Scratch rows, rows of cells and ghost planes are `stride` numbers long: node i is number
 * i + 1, cell c lies between the numbers c and c + 1, so that cells 0 and n[0] are those
 * across a periodic side, or of the phase without stiffness.
 */
namespace mesoslip::kernels
{
/** A component of a node whose acceleration is zero. */
struct HeldNode
{
  std::uint32_t node;      ///< along the row
  std::uint32_t component; ///< in the order of the sweep
};

/** One rank's part of a box, and a sweep over it. */
struct BrickSweep
{
  unsigned int n[3];  ///< distinct nodes along x, rows of a plane, planes of this rank
  std::size_t stride; ///< of rows in scratch memory
  bool periodic;      ///< in x
  double ratio[2]; ///< edges of a cell: along the rows' axis over x, and over the planes'

  const std::size_t *plane_start; ///< of each plane: place of its first node in a field

  /** Phases of the cells, [layer][row][stride]: layer k lies below plane k; there are
   * n[2] + 1 layers of n[1] - 1 rows. */
  const std::uint8_t *phase;
  const std::uint16_t *material; ///< instead of these, where they are too many for a byte
  bool has_layer_below;          ///< whether there are cells below the first plane
  bool has_layer_above;          ///< and above the last one
  unsigned int n_phases;         ///< with that without stiffness, the last one

  /** Times volume / (16 edge_rows^2): [coefficient][256], of materials instead of phases
   * [n_phases][n_of_material()]. */
  const double *stiffness;

  unsigned int rows_at_once; ///< rows of cells of a tile
  double *scratch;           ///< see scratch_size()
  double *carry;             ///< [n[2] + 1][12][stride], between the tiles

  const double *below; ///< x + beta w in the plane below the first: [n[1] + 1][3][stride]
  const double *above; ///< the same above the last
};

/** What a sweep advances. */
struct BrickStep
{
  double *u[3];           ///< displacement (m)
  double *w[3];           ///< velocity of the scheme (m/s)
  double dt;              ///< s
  double c_new;           ///< u += c_new w_(n+1) + c_old w_n (s)
  double c_old;           ///< see c_new
  double beta;            ///< of the damping C = alpha M + beta K (s)
  double alpha;           ///< likewise (1/s)
  double acceleration[3]; ///< of the body (m/s^2), in the order of the sweep

  const double *const *inverse_mass; ///< of each row of nodes, [plane][row] (m/kg)
  const std::uint32_t *held_begin;   ///< of each row of nodes, and the end
  const HeldNode *held;              ///< row by row, by component, then node

  /** Forces on the nodes of the first and the last row of all planes, which are not
   * advanced: [plane][3][n[0]] (N); or null: they are as all others. */
  double *surface_force[2];
};

/** K x of a sweep. */
struct BrickProduct
{
  const double *x[3]; ///< displacement (m)
  double *out[3];     ///< forces (N)
};

/** Numbers in BrickSweep::scratch. */
constexpr std::size_t scratch_size(const std::size_t stride,
                                   const unsigned int rows_at_once)
{
  return stride * (15 + 12 * (std::size_t{rows_at_once} + 1)) + 64;
}

constexpr unsigned int n_brick_kinds = 8; ///< see BrickKernels

/** Kernels of one instruction set; [0]: isotropic phases and cubes, [1]: isotropic, [2]:
 * orthotropic, [3]: any ones, [4]: any materials instead of phases; apart (coefficients.h) [5]:
 * isotropic, [6]: any ones, [7]: any materials. */
struct BrickKernels
{
  /** One time step of the box. */
  void (*advance[n_brick_kinds])(const BrickSweep &sweep, const BrickStep &step);
  /** Forces of a displacement. */
  void (*product[n_brick_kinds])(const BrickSweep &sweep, const BrickProduct &product);

  /** Node plane @p plane of x + beta w, for other ranks: [n[1]][3][stride]. */
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
