#ifndef mesoslip_elasticity_element_operator_h
#define mesoslip_elasticity_element_operator_h

#include "elasticity/element_kernel.h"
#include "elasticity/uniform_material.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"
#include "mesh/mesh.h"

#include <array>
#include <vector>

namespace mesoslip
{
/**
 * Matrix-free stiffness of a mesh: linear triangles and tetrahedra, bilinear
 * quadrilaterals and trilinear hexahedra, fully integrated, also mixed. Congruent
 * simplices, parallelograms and parallelepipeds share an element matrix if there are
 * many; for other cells their shape is stored (see element_kernel.h).
 *
 * Fields store the components of a node together, kernels::node_stride<dim> numbers each,
 * in the order of the points, followed by zeros: see zero_field().
 */
template <int dim>
class ElementOperator
{
public:
  /** Corners are indices into the points, material_id is the phase. */
  using Cells = std::vector<Cell>;

  /**
   * The cells of each of @p parts form one product, roughly in the given order; an order
   * along a space-filling curve is best. @p phases must cover all material_ids.
   */
  ElementOperator(const std::vector<dealii::Point<dim>> &points,
                  const std::vector<Cells> &parts,
                  const std::vector<ElasticPhase<dim>> &phases,
                  const InstructionSet isa = InstructionSet::automatic);

  /** A zero displacement (m) or force (N, in 2D N/m). */
  LineVector<double> zero_field() const
  {
    return LineVector<double>(coordinates.size());
  }

  /** @p f += K @p u for the cells of one part. */
  void add_product(const unsigned int part, double *f, const double *u) const;

  /** Advances nodes by one time step; their z and force are fields of this class. */
  void advance(const kernels::NodeArrays &nodes, const kernels::NodeStep &step) const
  {
    kernels.advance(nodes, step);
  }

  /** Number of cells that share their element matrix. */
  std::size_t n_congruent_cells() const
  {
    return n_congruent;
  }

private:
  using Material = kernels::CellMaterial;

  /** Cells of one kind with one CellMaterial. */
  struct Group
  {
    unsigned int kind = 0;                   ///< 0: simplices, 1: other cells
    Material common = Material::orthotropic; ///< common property of the cells of a batch
    std::vector<std::uint32_t> nodes, material;
    LineVector<double> shapes; ///< shapes, see CellBatches
  };

  /** Computes the shapes of a complete group, if its kernel reads them. */
  void set_shapes(Group &group, const double *points) const;
  kernels::CellBatches batches(const Group &group) const;

  kernels::CellFunction function(const Group &group) const;

  /** Index of the element matrix of each of @p cells, -1 for none. */
  std::vector<int> find_congruent(const std::vector<dealii::Point<dim>> &points,
                                  const Cells &cells);
  /** Element matrix in the layout of CellBatches::stiffness. */
  std::vector<double> element_matrix(const Cell &cell) const;
  std::vector<Group> make_groups(const std::vector<dealii::Point<dim>> &points,
                                 const Cells &cells);
  void finish_batch(const unsigned int n_corners,
                    std::vector<std::uint32_t> &cells,
                    Group &group) const;

  const kernels::CellKernels kernels;
  const std::uint32_t first_dummy; ///< first node of the dummy cell
  Material phase_material;         ///< anisotropic if one of the phases is

  /**
   * Stiffness of the phases, see CellBatches; for simplices the stiffness for the mean
   * strain.
   */
  std::vector<double> stiffness, about_mean, excess;

  LineVector<double> coordinates; ///< coordinates of the nodes

  std::array<std::vector<double>, 2> matrices; ///< element matrices, by kind
  std::vector<std::vector<Group>> parts;
  std::size_t n_congruent = 0;
};

/**
 * Row sums of the mass matrix, one per point (kg, in 2D kg/m): exact integrals of density
 * times shape function.
 */
template <int dim>
std::vector<double> lumped_mass(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<Cell> &cells,
                                const std::vector<ElasticPhase<dim>> &phases);
} // namespace mesoslip

#endif
