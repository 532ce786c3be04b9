#ifndef mesoslip_elasticity_element_kernel_h
#define mesoslip_elasticity_element_kernel_h

#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between the ordinary sources and the kernels of general cells, which are
 * compiled once for each instruction set (see row_kernel.h for why it is so plain).
 *
 * What the kernels need to know of the shape of a cell is computed once and read with the
 * batch: to load and transpose the coordinates of all corners again would take longer. Of
 * triangles and tetrahedra these are the gradients, which are constant; of quadrilaterals and
 * hexahedra the coefficients of the coordinates, with which Gauss points are summed up.
 */
namespace mesoslip::kernels
{
/** Numbers a node in displacements, forces and coordinates: in 3D the fourth is not used,
 * but whole nodes are loaded at once. */
template <int dim>
constexpr unsigned int node_stride = dim == 2 ? 2 : 4;

/** What a batch of cells has in common. */
enum class CellMaterial
{
  orthotropic, ///< a phase without coupling of normal and shear components
  anisotropic, ///< any phase
  matrix       ///< phase and shape, thus the element matrix
};

/**
 * Element matrices are stored for modes (element_modes.h). Those of a parallelogram or
 * parallelepiped with one, two and three coordinates are orthogonal, so that there is a block for
 * each number; simplices have one block.
 */
constexpr int mode_block(const bool simplex, const int mode)
{
  int n = 0;
  for (int bit = 1; bit <= mode; bit *= 2)
    n += (mode & bit) != 0;
  return simplex ? 1 : n;
}

/** Numbers in an element matrix: [block][mode][component] of the displacement, [mode of the
 * same block][component] of the force. */
template <int dim>
constexpr std::size_t n_matrix_numbers(const std::size_t n_corners)
{
  return n_corners == dim + 1 ? dim * dim * dim * dim : dim == 2 ? 16 + 4 : 81 + 81 + 9;
}

/** Cells of one kind, as many in a batch as a vector has numbers. */
struct CellBatches
{
  std::size_t n = 0; ///< number of batches

  /** Where the numbers of nodes begin in fields, node_stride times the node: [batch][corner
   * in the order of deal.II][cell of the batch]. */
  const std::uint32_t *nodes = nullptr;

  /** Phase, or element matrix, of each batch. */
  const std::uint32_t *material = nullptr;

  /** Voigt stiffness (Pa) of the phases, or the element matrices, one after the other. */
  const double *stiffness = nullptr;

  /** What the mean strain of a quadrilateral or hexahedron meets more (Pa), phase by phase, where
   * `stiffness` is that about the mean (ElasticPhase); null: nothing. */
  const double *excess = nullptr;

  /** Without a common matrix: see ShapeFunction. */
  const double *shapes = nullptr;
};

/**
 * [batch][corner or mode but the first][axis][cell], aligned as vectors: of simplices
 * gradients of shape functions times the root of the volume, of other cells modes of the
 * coordinates with gauss_scale.
 */
using ShapeFunction = void (*)(const CellBatches &cells,
                               const double *points,
                               double *shapes);

/** f += K u of the cells. */
using CellFunction = void (*)(const CellBatches &cells, const double *u, double *f);

/** Constants of the beta2 scheme. */
struct NodeStep
{
  double dt;              ///< s
  double c_new;           ///< u += c_new w_(n+1) + c_old w_n (s)
  double c_old;           ///< see c_new
  double beta;            ///< of the damping C = alpha M + beta K (s)
  double alpha;           ///< likewise (1/s)
  double acceleration[3]; ///< of the body (m/s^2)
};

/** Nodes of one rank. Components apart, on whole vectors, but for z and force. */
struct NodeArrays
{
  std::size_t n;                 ///< number of nodes
  double *u[3];                  ///< displacement (m)
  double *w[3];                  ///< velocity of the scheme (m/s)
  const double *inverse_mass[3]; ///< m/kg, 0 where constrained
  const double *mass; ///< kg (in 2D kg/m); null without forces in proportion to it

  /** u + beta w, to be set for the next product. */
  double *z;

  /** In: internal minus body forces; out: minus body forces (N, in 2D N/m). */
  double *force;
};

/** One time step of all nodes from the forces on them. */
using NodeFunction = void (*)(const NodeArrays &nodes, const NodeStep &step);

/** Kernels of one instruction set. */
struct CellKernels
{
  NodeFunction advance; ///< of nodes

  ShapeFunction shapes[2]; ///< of triangles or tetrahedra, and of others

  /** By CellMaterial, for triangles or tetrahedra. */
  CellFunction simplex[3];

  /** By CellMaterial, for quadrilaterals or hexahedra. */
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
