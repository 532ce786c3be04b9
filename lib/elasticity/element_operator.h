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
 * The stiffness matrix of a mesh without being assembled: linear triangles and tetrahedra,
 * bilinear quadrilaterals and trilinear hexahedra, fully integrated, also mixed. Cells of
 * which many are congruent, simplices, parallelograms and parallelepipeds, share their element
 * matrix; of others their shape is stored (see element_kernel.h).
 *
 * Fields hold the components of a node together, kernels::node_stride<dim> numbers each,
 * in the order of the points, and some zeros behind them: see zero_field().
 */
template <int dim>
class ElementOperator
{
public:
  /** Corners as indices into the points, phases as material_id. */
  using Cells = std::vector<Cell>;

  /**
   * The cells of each of @p parts are multiplied together, much in the order given, which
   * is best one along a space-filling curve. @p phases must describe all of them.
   */
  ElementOperator(const std::vector<dealii::Point<dim>> &points,
                  const std::vector<Cells> &parts,
                  const std::vector<ElasticPhase<dim>> &phases,
                  const InstructionSet isa = InstructionSet::automatic);

  /** A displacement (m) or force (N, in 2D N/m). */
  LineVector<double> zero_field() const
  {
    return LineVector<double>(coordinates.size());
  }

  /** @p f += K @p u with the cells of one part. */
  void add_product(const unsigned int part, double *f, const double *u) const;

  /** One time step of nodes whose z and force are such fields. */
  void advance(const kernels::NodeArrays &nodes, const kernels::NodeStep &step) const
  {
    kernels.advance(nodes, step);
  }

  /** Number of cells that share their matrix with others. */
  std::size_t n_congruent_cells() const
  {
    return n_congruent;
  }

private:
  using Material = kernels::CellMaterial;

  /** Cells of one kind with one CellMaterial. */
  struct Group
  {
    unsigned int kind = 0;                   ///< 0: simplices, 1: others
    Material common = Material::orthotropic; ///< what the cells of a batch have in common
    std::vector<std::uint32_t> nodes, material;
    LineVector<double> shapes; ///< see CellBatches
  };

  /** Computes the shapes of a complete group, if its kernel reads them. */
  void set_shapes(Group &group, const double *points) const;
  kernels::CellBatches batches(const Group &group) const;

  kernels::CellFunction function(const Group &group) const;

  /** Which element matrix each of @p cells has, or none (-1). */
  std::vector<int> find_congruent(const std::vector<dealii::Point<dim>> &points,
                                  const Cells &cells);
  /** As CellBatches::stiffness wants it. */
  std::vector<double> element_matrix(const Cell &cell) const;
  std::vector<Group> make_groups(const std::vector<dealii::Point<dim>> &points,
                                 const Cells &cells);
  void finish_batch(const unsigned int n_corners,
                    std::vector<std::uint32_t> &cells,
                    Group &group) const;

  const kernels::CellKernels kernels;
  const std::uint32_t first_dummy; ///< node of a cell without displacement
  Material phase_material;         ///< orthotropic, or one phase is not

  /** Of the phases, see CellBatches; simplices have that of the mean strain all over. */
  std::vector<double> stiffness, about_mean, excess;

  LineVector<double> coordinates; ///< of the nodes

  std::array<std::vector<double>, 2> matrices; ///< of elements, by kind
  std::vector<std::vector<Group>> parts;
  std::size_t n_congruent = 0;
};

/**
 * Row sums of the mass matrix (kg, in 2D kg/m), one for each point: exact integrals of
 * density times shape function.
 */
template <int dim>
std::vector<double> lumped_mass(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<Cell> &cells,
                                const std::vector<ElasticPhase<dim>> &phases);
} // namespace mesoslip

#endif
