#ifndef mesoslip_elasticity_row_kernel_h
#define mesoslip_elasticity_row_kernel_h

#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between the ordinary sources and the row kernels, which are compiled once for
 * each instruction set. Plain structures and pointers only: an inline function that both
 * sides instantiate could be taken from the wrong side by the linker.
 *
 * The mathematics. For a cell with lower and upper nodal values z, dx and s are the
 * horizontal difference and sum of a node row, and (for each component)
 *
 *     e = dx_lower + dx_upper = 2 hx dz/dx,   d = s_upper - s_lower = 2 hy dz/dy,
 *     g = dx_upper - dx_lower                                       (hourglass)
 *
 * With A = sigma_xx hy/2 (x component; sigma_xy hy/2 for y), B = sigma_xy hx/2
 * (sigma_yy hx/2), G = k g the four nodes of a cell receive
 *
 *     lower: -(A - G) - B | (A - G) - B      upper: -(A + G) + B | (A + G) + B
 *
 * so the force on node i of a row, with P = A - G of the cells above, Q = A + G of the
 * cells below and B' = B_below - B_above, is [P + Q + B'](cell i-1) - [P + Q - B'](cell
 * i). Q, B of one cell row are handed on in four row buffers. Forces are kept multiplied
 * by 2/hx (x component) and 2/hy (y), which makes sigma_xy serve both components.
 */
namespace mesoslip::kernels
{
/** Order of the coefficients of a phase, see Coefficients in row_sweep.cc. */
enum CoefficientIndex
{
  c11,
  c12,
  c22,
  c33,
  gx,
  gy,
  c13,
  c23,
  gxy,
  n_coefficients
};

/** How the kernel finds the coefficients of a cell. */
enum class MaterialVariant
{
  homogeneous,
  /** Two phases: blend by a mask. */
  two,
  /** Phases whose coefficients fit into one vector register: table lookup. */
  one_register,
  /** Phases whose coefficients fit into two vector registers. */
  two_registers,
  /** Up to 256: gather. */
  any
};

/** Rows of the table of stiffnesses, the largest number of phases. */
constexpr unsigned int n_table_rows = 256;

/** Constants of a sweep. */
template <typename Number>
struct Constants
{
  /** coefficient[k][c]: coefficient k of phase c. */
  alignas(64) Number coefficient[n_coefficients][n_table_rows];

  /** Cells in a row. */
  unsigned int n_cells = 0;

  bool periodic = false; ///< the last node is the periodic copy of the first

  /** hx / hy */
  Number ratio = 0;

  /** Damping: z = u + beta w. */
  Number beta = 0;

  /** u += c_new w_new + c_old w_old */
  Number c_new = 0;
  Number c_old = 0; ///< factor of the old w

  /** Internal force = scale times stored force: hx/2, hy/2. */
  Number scale_x = 0;
  Number scale_y = 0; ///< hy/2, y component

  /** Body acceleration, and the same times 2/hx, 2/hy for scaled forces. */
  Number gravity_x        = 0;
  Number gravity_y        = 0; ///< m/s^2
  Number scaled_gravity_x = 0; ///< times 2/hx
  Number scaled_gravity_y = 0; ///< times 2/hy

  /** Damping alpha M: alpha, and the same times 2/hx, 2/hy. */
  Number alpha          = 0; ///< 1/s
  Number scaled_alpha_x = 0; ///< times 2/hx
  Number scaled_alpha_y = 0; ///< times 2/hy
};

/** Rows of one kernel call: n node rows and the cell rows above them. */
template <typename Number>
struct Rows
{
  /**
   * Lowest of the n + 1 node rows of the state (w is unused without damping, gravity and
   * step).
   */
  Number *ux         = nullptr;
  Number *uy         = nullptr; ///< displacement (m)
  Number *wx         = nullptr; ///< velocity of the scheme (m/s)
  Number *wy         = nullptr; ///< velocity of the scheme (m/s)
  std::size_t stride = 0;       ///< numbers from one row of the state to the next

  /** Q (x, y), sigma_xy and scaled sigma_yy of the cell row below; in and out. */
  Number *qx  = nullptr;
  Number *qy  = nullptr; ///< Q, y component
  Number *sxy = nullptr; ///< scaled sigma_xy
  Number *syy = nullptr; ///< scaled sigma_yy

  /** Output of a storing kernel. */
  Number *fx           = nullptr;
  Number *fy           = nullptr; ///< y component
  std::size_t f_stride = 0;       ///< numbers from one row of forces to the next

  /** -dt / mass, times scale, of a stepping kernel: w += factor * force. */
  const Number *factor_x    = nullptr;
  const Number *factor_y    = nullptr; ///< y component
  std::size_t factor_stride = 0;       ///< numbers from one row to the next

  /** Lumped mass; only for mass-proportional forces. */
  const Number *mass      = nullptr;
  std::size_t mass_stride = 0; ///< numbers from one row to the next

  /** Phases of the lowest cell row. */
  const std::uint8_t *phases = nullptr;
  std::size_t phase_stride   = 0; ///< numbers from one cell row to the next
};

/** A kernel: advances the nodes of a row, or computes their forces. */
template <typename Number>
using RowFunction = void (*)(const Constants<Number> &, const Rows<Number> &);

/** Criteria to choose a kernel. */
struct Choice
{
  unsigned int n_phases = 1;     ///< 1 + the largest phase of a cell; 1: homogeneous
  bool anisotropic      = false; ///< with D13 and D23
  bool damping          = false; ///< C = beta K
  bool gravity          = false; ///< body acceleration or damping alpha M

  /** Result: how coefficients are found. */
  MaterialVariant material = MaterialVariant::homogeneous;
};

/** Kernels for one choice; index [0]: one node row, [1]: `rows_at_once` node rows. */
template <typename Number>
struct Kernels
{
  /** Advances the state in place; in single precision only with the term of damping. */
  RowFunction<Number> step[2] = {nullptr, nullptr};

  /** Stores internal forces. */
  RowFunction<Number> store[2] = {nullptr, nullptr};

  /** Stores the forces that remain in the buffers (top row). */
  RowFunction<Number> finish = nullptr;

  unsigned int rows_at_once = 1; ///< node rows per call

  /** Mean strains of the cells between two node rows (double only). */
  void (*strain)(const double *lower,
                 const double *upper,
                 std::size_t component_offset,
                 unsigned int n_cells,
                 double half_inverse_hx,
                 double half_inverse_hy,
                 double *exx,
                 double *eyy,
                 double *gxy) = nullptr;

  /** a.b of n numbers (double only). */
  double (*dot)(const double *a, const double *b, unsigned int n) = nullptr;
};

#define MESOSLIP_DECLARE_KERNELS(name)                   \
  namespace name                                         \
  {                                                      \
  void select(Choice &choice, Kernels<double> &kernels); \
  void select(Choice &choice, Kernels<float> &kernels);  \
  }

MESOSLIP_FOR_EACH_VARIANT(MESOSLIP_DECLARE_KERNELS)
#undef MESOSLIP_DECLARE_KERNELS
} // namespace mesoslip::kernels

#endif
