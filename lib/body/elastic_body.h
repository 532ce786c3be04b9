#ifndef mesoslip_body_elastic_body_h
#define mesoslip_body_elastic_body_h

#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "statics/static_solver.h"

#include <mpi.h>

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace mesoslip
{
/** A node and the factor of its displacements in a sum. */
struct WeightedNode
{
  NodeIndex node;      ///< the node
  double weight = 1.0; ///< the factor
};

/** Nodes of one side of a body. */
template <int dim>
struct SurfaceNodes
{
  /** Nodes of the side on this rank; in 2D in ascending order along the side. */
  std::vector<NodeIndex> nodes;

  /** In 2D with periodic sides: the last node is the periodic copy of the first one.
   * Meshes with Mesh::masters have no periodic copies here. */
  bool closed = false;

  /** Integral of the outward normal times the shape function of each node: its tributary
   * length (2D, m) or area (3D, m^2) in the direction of the normal. For all nodes of
   * the side, on all ranks. */
  std::vector<std::array<double, dim>> normal_area;

  /** Index of each of nodes among all nodes of the side; empty if nodes are all of them.
   */
  std::vector<std::size_t> place_of_nodes;

  /** Index of node @p k of nodes among all nodes of the side. */
  std::size_t place(const std::size_t k) const
  {
    return place_of_nodes.empty() ? k : place_of_nodes[k];
  }
};

/** A contribution to an entry of K; contributions to the same entry add up. Degree of
 * freedom dim k + c is component c of node k = row of the field * n_columns() + column.
 */
struct MatrixEntry
{
  std::uint64_t row    = 0;  ///< degree of freedom of the force
  std::uint64_t column = 0;  ///< degree of freedom of the displacement
  double value         = 0.; ///< N/m, in 2D N/m^2
};

/** Springs, dashpots and masses at nodes, in addition to the cells. Each rank has the
 * entries of its own nodes. Entries at periodic copies belong to their periodic masters.
 */
struct Foundation
{
  std::vector<SpringEntry> springs;                      ///< springs to fixed points
  std::vector<SpringEntry> dashpots;                     ///< N s/m (in 2D Pa s)
  std::vector<std::pair<NodeIndex, double>> masses = {}; ///< kg (in 2D kg/m)
};

/**
 * Interface of a linear elastic body for statics, modes and load cases; implemented by
 * GridBody and MeshBody. Fields are NodalField objects with n_columns() x n_rows() nodes
 * for every body: rows and columns of a grid, any layout of a mesh. With periodic sides,
 * fields contain the periodic copies; operators read and write the same values at copies
 * and masters.
 *
 * Fields are replicated on every rank, or distributed. A distributed field has the nodes
 * of the cells of this rank; shared nodes have the same values on all their ranks. Sums
 * over nodes run over locally owned nodes (is_counted()), then over the ranks of
 * communicator(), a single rank for replicated fields. On a distributed body, products
 * and solves are collective and return the same bits on all ranks, so that all ranks take
 * the same decisions.
 */
template <int dim>
class ElasticBody
{
public:
  static constexpr unsigned int bottom = 2 * (dim - 1); ///< the contact side
  static constexpr unsigned int top    = 2 * dim - 1;   ///< the side opposite to it

  virtual ~ElasticBody() = default;

  /** Number of nodes in a row of a field. */
  unsigned int n_columns() const
  {
    return columns;
  }

  /** Number of node rows of a field. */
  unsigned int n_rows() const
  {
    return rows;
  }

  /** A field of zeros. */
  NodalField<double> zero_field() const
  {
    return rows == 1 ? NodalField<double>::of_points(columns, dim)
                     : NodalField<double>(columns, rows, dim);
  }

  /** Stiffness (Pa) and density (kg/m^3) of each phase. */
  const std::vector<ElasticPhase<dim>> &phases() const
  {
    return the_phases;
  }

  /** Axes whose opposite sides are periodic. */
  Periodicity periodicity() const
  {
    return periodic;
  }

  /** Nodes of side @p id, numbered as deal.II does: 2 d at the lower, 2 d + 1 at the
   * upper end of axis d. */
  const SurfaceNodes<dim> &surface(const unsigned int id) const
  {
    return sides[id];
  }

  /** Components of @p field at all nodes of side @p id, node after node, on all ranks.
   * Collective. */
  std::vector<double> surface_values(const unsigned int id,
                                     const NodalField<double> &field) const;

  /** Values of @p mask at all nodes of side @p id: 1 for constrained components, else 0.
   * Collective. */
  std::vector<double> surface_values(const unsigned int id, const DofMask &mask) const;

  /** Ranks over which fields are distributed; MPI_COMM_SELF for replicated fields. */
  MPI_Comm communicator() const
  {
    return sharing;
  }

  /** Whether @p node is locally owned, i.e. counted on this rank in sums over nodes. In
   * distributed fields only periodic masters count. */
  bool is_counted(const NodeIndex &node) const
  {
    return index(node) < n_counted;
  }

  /** Global number of @p node, independent of the number of ranks. */
  virtual std::uint64_t number(const NodeIndex &node) const
  {
    return index(node);
  }

  /** Pairs of periodic copy and periodic master, axis after axis: the master of a corner
   * is itself the copy of another node along the next axis. Empty for distributed
   * fields. */
  const std::vector<std::array<NodeIndex, 2>> &periodic_copies() const
  {
    return copies;
  }

  /** For each node, row after row: whether it is locally owned and no periodic copy. */
  virtual std::vector<bool> counted_masters() const;

  /** Sums the values of periodic copies and masters, and stores the sum at both. */
  void add_copies(NodalField<double> &field) const;

  /** Updates periodic copies and ghost nodes with the values of their masters and owners.
   * Collective. */
  virtual void update_copies(NodalField<double> &field) const;

  /** Constrains periodic copies whose masters are constrained. Solvers of distributed
   * fields read masters only. */
  void update_copies(DofMask &mask) const;

  /** Length of the body's bounding box along axis @p d (m). */
  double extent(const unsigned int d) const
  {
    return extents[d];
  }

  /** Area (2D, m^2) or volume of the body. */
  double volume() const
  {
    return total_volume;
  }

  /** Mass, the integral of the density (kg, in 2D kg/m). */
  double total_mass() const
  {
    return mass;
  }

  /** Number of cells. */
  std::size_t n_cells() const
  {
    return number_of_cells;
  }

  /** Whether products and solves are collective over several ranks. */
  bool is_distributed() const
  {
    return distributed;
  }

  /** Nodes of a second body that contact node @p k meets in place of the flat; empty on a
   * flat. */
  virtual std::vector<WeightedNode> meets(const std::size_t /*k*/) const
  {
    return {};
  }

  /**
   * Converts the @p force conjugate to nodal displacements to the force conjugate to the
   * values of fields. The two differ if some of these values are relative displacements.
   */
  virtual void act_on_displacements(NodalField<double> & /*force*/) const
  {
  }

  /** Position of a node, from the lower corner of the bounding box (m). */
  virtual std::array<double, dim> point(const NodeIndex &node) const = 0;

  /** Adds springs, dashpots and masses to the body: products and solvers include the
   * springs, mass vectors the masses. Collective. */
  void stand_on(const Foundation &given);

  /** Springs, dashpots and masses at nodes. */
  const Foundation &foundation() const
  {
    return under;
  }

  /** Lumped mass of the nodes, row after row (kg, in 2D kg/m); periodic copies and
   * masters carry the sum of both. */
  std::vector<double> lumped_mass() const;

  /** Number of groups of consecutive cells for evaluate(); on a grid a group is a row. */
  virtual std::size_t n_cell_groups() const = 0;

  /** Phase, mean strain and relative volume of the cells of a group. */
  struct Cells
  {
    std::vector<unsigned int> phase;      ///< indices into phases()
    std::vector<VoigtVector<dim>> strain; ///< mean over the cell, engineering shear
    std::vector<double> volume;           ///< in mean cell volumes: 1 on a grid
  };

  /** Evaluates the displacement @p u in the cells of @p group; for distributed fields in
   * the cells of this rank. Not collective. */
  virtual void
  evaluate(const NodalField<double> &u, const std::size_t group, Cells &cells) const = 0;

  /** Integral of strain strain^T over the cells of each phase (m^3, in 2D m^2): its scalar
   * products with the stiffnesses sum up to u^T K u without springs. Collective. */
  virtual std::vector<VoigtMatrix<dim>>
  strain_products(const NodalField<double> &u) const = 0;

  /** Ku = K u without constraints (N, in 2D N/m), including the springs of the
   * foundation. Collective. */
  void vmult(NodalField<double> &Ku, const NodalField<double> &u) const;

  /** Entries of K from the cells: contributions of the cells or rows of this rank, all
   * ranks together without repetition. Periodic copies are separate from their masters
   * or have no entries. Not collective; for replicated fields. */
  virtual std::vector<MatrixEntry> stiffness_entries() const = 0;

  /** A solver for K u = f, initially without constraints. The body must outlive it.
   * Solvers of plane grids ignore springs; other solvers include the springs of the
   * foundation and then start from u = 0. */
  virtual std::unique_ptr<StaticSolver> make_solver() const = 0;

  /**
   * Returns this body, periodic along all axes. @throws std::invalid_argument if nodes of
   * opposite sides do not match.
   */
  virtual std::unique_ptr<ElasticBody> make_periodic() const = 0;

protected:
  /** Sets the layout of fields with @p n_columns x @p n_rows nodes; derived classes set
   * the rest. */
  ElasticBody(const unsigned int n_columns,
              const unsigned int n_rows,
              const std::vector<ElasticPhase<dim>> &phases,
              const Periodicity &periodicity)
    : n_counted(static_cast<std::size_t>(n_columns) * n_rows)
    , columns(n_columns)
    , rows(n_rows)
    , the_phases(phases)
    , periodic(periodicity)
  {
  }

  /** Ku = K u, cells only. */
  virtual void multiply(NodalField<double> &Ku, const NodalField<double> &u) const = 0;

  /** lumped_mass() of the cells only. */
  virtual std::vector<double> mass_of_cells() const = 0;

  /** Index of a node in a field, row after row. */
  std::size_t index(const NodeIndex &node) const
  {
    return static_cast<std::size_t>(node.j) * columns + node.i;
  }

  std::array<double, dim> extents = {};            ///< see extent()
  double total_volume             = 0.;            ///< see volume()
  double mass                     = 0.;            ///< see total_mass()
  std::size_t number_of_cells     = 0;             ///< see n_cells()
  bool distributed                = false;         ///< see is_distributed()
  MPI_Comm sharing                = MPI_COMM_SELF; ///< see communicator()
  std::size_t n_counted;                           ///< locally owned, come first
  std::array<SurfaceNodes<dim>, 2UL * dim> sides;  ///< see surface()
  std::vector<std::array<NodeIndex, 2>> copies;    ///< see periodic_copies()

private:
  template <typename Value>
  std::vector<double> gather(const unsigned int id, const Value &value) const;

  const unsigned int columns, rows;
  Foundation under;
  bool is_on_springs = false; ///< whether any rank has springs
  std::vector<double> extra;  ///< point masses of the nodes; empty if there are none
  const std::vector<ElasticPhase<dim>> the_phases;
  const Periodicity periodic;
};

/** Springs of @p foundation and @p springs together. */
std::vector<SpringEntry> with_foundation(const Foundation &foundation,
                                         const std::vector<SpringEntry> &springs);

/** Volume (in mean cell volumes) of each phase. */
template <int dim>
std::vector<double> phase_volumes(const ElasticBody<dim> &body);

/** The body for @p solver: a GridBody, or for StaticSolverKind::ml a MeshBody with the
 * same cells, distributed over @p communicator. @p material must outlive it. */
std::unique_ptr<ElasticBody<2>> make_body(const UniformMaterial &material,
                                          const StaticSolverKind solver,
                                          const MPI_Comm communicator);
} // namespace mesoslip

#endif
