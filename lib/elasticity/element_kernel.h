#ifndef mesoslip_elasticity_element_kernel_h
#define mesoslip_elasticity_element_kernel_h

#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between ordinary sources and the kernels of general cells, which are compiled
 * once for each instruction set; see row_kernel.h for the reason of its plain types.
 *
 * Shape data of a cell is precomputed and read with the batch, because loading and
 * transposing the coordinates of all corners takes longer. It consists of the constant
 * gradients for triangles and tetrahedra, and of the coefficients of the coordinates,
 * which give the sums over Gauss points, for quadrilaterals and hexahedra.
 */
namespace mesoslip::kernels
{
/**
 * Numbers per node in displacements, forces and coordinates; in 3D the fourth one is
 * padding, so that whole nodes are loaded at once.
 */
template <int dim>
constexpr unsigned int node_stride = dim == 2 ? 2 : 4;

/** Common property of the cells of a batch. */
enum class CellMaterial
{
  orthotropic, ///< a phase without normal-shear coupling
  anisotropic, ///< a general phase
  matrix       ///< phase and shape, hence the element matrix
};

/**
 * Block of mode @p mode in an element matrix. Element matrices are stored for modes
 * (element_modes.h). In a parallelogram or parallelepiped, modes with one, two and three
 * coordinates are orthogonal, so that there is one block for each number of coordinates;
 * simplices have one block.
 */
constexpr int mode_block(const bool simplex, const int mode)
{
  int n = 0;
  for (int bit = 1; bit <= mode; bit *= 2)
    n += (mode & bit) != 0;
  return simplex ? 1 : n;
}

/**
 * Numbers in an element matrix: [block][mode][component] of the displacement, [mode of
 * the same block][component] of the force.
 */
template <int dim>
constexpr std::size_t n_matrix_numbers(const std::size_t n_corners)
{
  return n_corners == dim + 1 ? dim * dim * dim * dim : dim == 2 ? 16 + 4 : 81 + 81 + 9;
}

/** Batches of cells of one kind; a batch has as many cells as a vector has numbers. */
struct CellBatches
{
  std::size_t n = 0; ///< number of batches

  /**
   * First value of each node in fields, node_stride times the node: [batch][corner in the
   * order of deal.II][cell of the batch].
   */
  const std::uint32_t *nodes = nullptr;

  /** Phase or element matrix of each batch. */
  const std::uint32_t *material = nullptr;

  /** Voigt stiffness (Pa) of the phases, or element matrices, one after another. */
  const double *stiffness = nullptr;

  /**
   * Additional stiffness for the mean strain of a quadrilateral or hexahedron (Pa), per
   * phase; `stiffness` is then the stiffness about the mean (ElasticPhase). Null: none.
   */
  const double *excess = nullptr;

  /** Shapes of cells without a common matrix, see ShapeFunction. */
  const double *shapes = nullptr;
};

/**
 * Computes shapes: [batch][corner or mode but the first][axis][cell], aligned as vectors.
 * For simplices they are gradients of shape functions times the square root of the
 * volume, for other cells modes of the coordinates with gauss_scale.
 */
using ShapeFunction = void (*)(const CellBatches &cells,
                               const double *points,
                               double *shapes);

/** Adds the forces of the cells: f += K u. */
using CellFunction = void (*)(const CellBatches &cells, const double *u, double *f);

/** Constants of the beta2 scheme. */
struct NodeStep
{
  double dt;              ///< s
  double c_new;           ///< u += c_new w_(n+1) + c_old w_n (s)
  double c_old;           ///< see c_new
  double beta;            ///< damping C = alpha M + beta K (s)
  double alpha;           ///< damping C = alpha M + beta K (1/s)
  double acceleration[3]; ///< body acceleration (m/s^2)
};

/**
 * Nodes of one rank. Components are separate arrays of whole vectors, except in z and
 * force.
 */
struct NodeArrays
{
  std::size_t n;                 ///< number of nodes
  double *u[3];                  ///< displacement (m)
  double *w[3];                  ///< velocity of the scheme (m/s)
  const double *inverse_mass[3]; ///< 1/kg (in 2D m/kg), 0 if constrained
  const double *mass; ///< kg (in 2D kg/m); null without mass-proportional forces

  /** Output: u + beta w for the next product. */
  double *z;

  /** Input: internal minus body forces; output: minus body forces (N, in 2D N/m). */
  double *force;
};

/** Advances all nodes by one time step with the forces on them. */
using NodeFunction = void (*)(const NodeArrays &nodes, const NodeStep &step);

/** Kernels of one instruction set. */
struct CellKernels
{
  NodeFunction advance; ///< kernel of the nodes

  ShapeFunction shapes[2]; ///< for simplices, and for other cells

  /** Triangles or tetrahedra, by CellMaterial. */
  CellFunction simplex[3];

  /** Quadrilaterals or hexahedra, by CellMaterial. */
  CellFunction tensor[3];

  unsigned int cells_at_once; ///< cells in a batch
};

#define MESOSLIP_DECLARE_CELL_KERNELS(name) \
  namespace name                            \
  {                                         \
  CellKernels plane_cell_kernels();         \
  CellKernels solid_cell_kernels();         \
  }

MESOSLIP_FOR_EACH_VARIANT(MESOSLIP_DECLARE_CELL_KERNELS)
#undef MESOSLIP_DECLARE_CELL_KERNELS
} // namespace mesoslip::kernels

#endif
