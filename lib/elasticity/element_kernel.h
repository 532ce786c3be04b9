#ifndef mesoslip_elasticity_element_kernel_h
#define mesoslip_elasticity_element_kernel_h

#include "elasticity/kernel_variants.h"

#include <cstddef>
#include <cstdint>

/**
 * Interface between the ordinary sources and the kernels of general cells, which are
 * compiled once for each instruction set (see row_kernel.h for why it is so plain).
 *
 * The mathematics. Of multilinear cells all reference gradients at the 2^dim Gauss points
 * have 2^(dim-1) distinct values an axis and component: the differences along the edges,
 * interpolated along the other axes. With J = dx/dxi from the coordinates in the same way,
 * the force is the transpose of this applied to sigma adj(J)^T, where the strain is that
 * of du/dxi adj(J) / det(J): one division a point, and nothing stored but coordinates.
 * In triangles and tetrahedra gradients are constant, and stored: to load and transpose the
 * coordinates of all corners again would take longer than to read them.
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

/** Cells of one kind, as many in a batch as a vector has numbers. */
struct CellBatches
{
  std::size_t n = 0; ///< number of batches

  /** Nodes: [batch][corner in the order of deal.II][cell of the batch]. */
  const std::uint32_t *nodes = nullptr;

  /** Phase, or element matrix, of each batch. */
  const std::uint32_t *material = nullptr;

  /** Voigt stiffness (Pa) of the phases, one after the other, or the element matrices,
   * without rows and columns of the first corner, all components of a corner together. */
  const double *stiffness = nullptr;

  /** Of triangles and tetrahedra without a common matrix: see SimplexFunction. */
  const double *gradients = nullptr;
};

/** Gradients of the shape functions of all corners of simplices but the first, times the root of the
 * volume: [batch][corner - 1][axis][cell], aligned as vectors. */
using SimplexFunction = void (*)(const CellBatches &cells,
                                 const double *points,
                                 double *gradients);

/** f += K u of the cells; coordinates in @p points. */
using CellFunction = void (*)(const CellBatches &cells,
                              const double *points,
                              const double *u,
                              double *f);

/** Constants of the beta2 scheme. */
struct NodeStep
{
  double dt;              ///< s
  double c_new;           ///< u += c_new w_(n+1) + c_old w_n (s)
  double c_old;           ///< see c_new
  double beta;            ///< of the damping C = beta K (s)
  double acceleration[3]; ///< of the body (m/s^2)
};

/** Nodes of one rank. Components apart, on whole vectors, but for z and force. */
struct NodeArrays
{
  std::size_t n;                 ///< number of nodes
  double *u[3];                  ///< displacement (m)
  double *w[3];                  ///< velocity of the scheme (m/s)
  const double *inverse_mass[3]; ///< m/kg, 0 where constrained
  const double *mass;            ///< kg (in 2D kg/m); null without body acceleration

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

  SimplexFunction simplex_gradients; ///< what the kernels of simplices read

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
