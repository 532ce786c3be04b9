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
/** A node, and the factor of its displacements in a sum. */
struct WeightedNode
{
  NodeIndex node;      ///< which one
  double weight = 1.0; ///< the factor
};

/** The nodes of one side of a body. */
template <int dim>
struct SurfaceNodes
{
  /** Those that this rank has. In 2D in ascending order along the side. */
  std::vector<NodeIndex> nodes;

  /** In 2D on a body whose sides are periodic: the last node is the duplicate of the first.
   * Meshes with Mesh::originals have no duplicates here. */
  bool closed = false;

  /** Of all nodes of the side, whatever rank has them: integral of the outward normal times
   * the shape function of the node, its tributary length (2D, m) or area (3D, m^2) in the
   * direction of the normal. */
  std::vector<std::array<double, dim>> normal_area;

  /** Of each of nodes its number among all nodes of the side; empty: nodes are all. */
  std::vector<std::size_t> place_of_nodes;

  /** Number of node @p k of nodes among all nodes of the side. */
  std::size_t place(const std::size_t k) const
  {
    return place_of_nodes.empty() ? k : place_of_nodes[k];
  }
};

/** A part of an entry of K; parts at the same place add up. Degree of freedom dim k + c is
 * component c of the node k = row of the field * n_columns() + column. */
struct MatrixEntry
{
  std::uint64_t row    = 0;  ///< degree of freedom of the force
  std::uint64_t column = 0;  ///< of the displacement
  double value         = 0.; ///< N/m, in 2D N/m^2
};

/** What nodes stand on and carry besides the cells around them; of each rank what concerns the nodes that it
 * has, of duplicates that of the originals. */
struct Foundation
{
  std::vector<SpringEntry> springs;                      ///< to places at rest
  std::vector<SpringEntry> dashpots;                     ///< likewise, N s/m (in 2D Pa s)
  std::vector<std::pair<NodeIndex, double>> masses = {}; ///< kg, in 2D kg/m
};

/**
 * What statics, modes and load cases ask of a linear elastic body; GridBody and MeshBody
 * answer. Fields are NodalField with n_columns() x n_rows() nodes, whatever the body: on
 * a grid its rows and columns, on a mesh any layout. Where sides are periodic, fields
 * keep the duplicate nodes, which operators read and write equal to their originals.
 *
 * Fields are whole on every rank, or divided: then a rank has the nodes of its cells, and
 * nodes of several ranks have the same values on all of them. Sums over nodes go over those
 * that a rank counts and then over the ranks of communicator(), which are one where fields
 * are whole. On a distributed body products and solves are collective and give all ranks
 * the same bits, so that they take the same decisions.
 */
template <int dim>
class ElasticBody
{
public:
  static constexpr unsigned int bottom = 2 * (dim - 1); ///< the contact side
  static constexpr unsigned int top    = 2 * dim - 1;   ///< opposite to it

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

  /** A field that is zero. */
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

  /** Which opposite sides are one. */
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

  /** Components of @p field at all nodes of side @p id, on all ranks; those of a node
   * together. Collective. */
  std::vector<double> surface_values(const unsigned int id,
                                     const NodalField<double> &field) const;

  /** The same of a mask: 1 where a component is constrained, else 0. Collective. */
  std::vector<double> surface_values(const unsigned int id, const DofMask &mask) const;

  /** The ranks among which fields are divided; MPI_COMM_SELF where they are whole. */
  MPI_Comm communicator() const
  {
    return sharing;
  }

  /** Whether this rank counts @p node in sums: of a node of several ranks one does, of
   * divided fields only that which duplicates follow. */
  bool is_counted(const NodeIndex &node) const
  {
    return index(node) < n_counted;
  }

  /** Number of @p node in the whole body, the same for any number of ranks. */
  virtual std::uint64_t number(const NodeIndex &node) const
  {
    return index(node);
  }

  /** Duplicate nodes and their originals, axis after axis: a corner is the duplicate of
   * one that is itself the duplicate of another along the next axis. None where fields are
   * divided. */
  const std::vector<std::array<NodeIndex, 2>> &duplicate_nodes() const
  {
    return duplicates;
  }

  /** For each node, row after row, whether this rank counts it and it duplicates no other. */
  std::vector<bool> counted_originals() const;

  /** Adds up what duplicate nodes and their originals have, in both. */
  void add_duplicates(NodalField<double> &field) const;

  /** Sets duplicate nodes, and those that other ranks count, to the value of their originals.
   * Collective. */
  virtual void copy_duplicates(NodalField<double> &field) const;

  /** Constrains duplicate nodes where their originals are constrained. Solvers of divided
   * fields look at originals alone. */
  void copy_duplicates(DofMask &mask) const;

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

  /** Integral of the density (kg, in 2D kg/m). */
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

  /** What node @p k of the contact meets of a second body in the place of the flat; nothing on a flat. */
  virtual std::vector<WeightedNode> meets(const std::size_t /*k*/) const
  {
    return {};
  }

  /** Makes of the @p force on nodes that on the displacements of fields; not the same where some of these are relative. */
  virtual void act_on_displacements(NodalField<double> & /*force*/) const
  {
  }

  /** Place of a node, from the lower corner of the bounding box (m). */
  virtual std::array<double, dim> point(const NodeIndex &node) const = 0;

  /** From now on the body has this besides its cells: products and solvers have the springs, masses those of
   * nodes. Collective. */
  void stand_on(const Foundation &given);

  /** What it stands on. */
  const Foundation &foundation() const
  {
    return under;
  }

  /** Lumped mass (kg, in 2D kg/m) of the nodes, row after row; duplicates and their
   * originals carry the mass of both. */
  std::vector<double> lumped_mass() const;

  /** Cells are evaluated in groups of consecutive ones, on a grid its rows. */
  virtual std::size_t n_cell_groups() const = 0;

  /** Phase, mean strain and relative volume of the cells of one group. */
  struct Cells
  {
    std::vector<unsigned int> phase;      ///< index into phases()
    std::vector<VoigtVector<dim>> strain; ///< mean over the cell, engineering shear
    std::vector<double> volume;           ///< in mean cell volumes: 1 on a grid
  };

  /** Evaluates the displacement @p u in the cells of @p group, where fields are divided of
   * those of this rank. Not collective. */
  virtual void
  evaluate(const NodalField<double> &u, const std::size_t group, Cells &cells) const = 0;

  /** Ku = K u without constraints (N, in 2D N/m), with the springs of the foundation. Collective. */
  void vmult(NodalField<double> &Ku, const NodalField<double> &u) const;

  /**
   * K of the cells as a matrix: of this rank's cells or rows, all together without repetition.
   * Duplicate nodes are apart from their originals or empty. Not collective; for whole
   * fields.
   */
  virtual std::vector<MatrixEntry> stiffness_entries() const = 0;

  /** A solver for K u = f, without constraints at first. The body must outlive it. That of a plane grid knows
   * no springs, those of other bodies have the ones of the foundation; solves then begin with u = 0. */
  virtual std::unique_ptr<StaticSolver> make_solver() const = 0;

  /** The same body, periodic along all axes. @throws std::invalid_argument if nodes of
   * opposite sides do not match. */
  virtual std::unique_ptr<ElasticBody> make_periodic() const = 0;

protected:
  /** Of fields with @p n_columns x @p n_rows nodes; derived classes set the rest. */
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

  /** Ku = K u of the cells. */
  virtual void multiply(NodalField<double> &Ku, const NodalField<double> &u) const = 0;

  /** lumped_mass() of the cells. */
  virtual std::vector<double> mass_of_cells() const = 0;

  /** Of a node among those of a field, row after row. */
  std::size_t index(const NodeIndex &node) const
  {
    return static_cast<std::size_t>(node.j) * columns + node.i;
  }

  std::array<double, dim> extents = {};             ///< see extent()
  double total_volume             = 0.;             ///< see volume()
  double mass                     = 0.;             ///< see total_mass()
  std::size_t number_of_cells     = 0;              ///< see n_cells()
  bool distributed                = false;          ///< see is_distributed()
  MPI_Comm sharing                = MPI_COMM_SELF;  ///< see communicator()
  std::size_t n_counted;                            ///< the first nodes of a field
  std::array<SurfaceNodes<dim>, 2UL * dim> sides;   ///< see surface()
  std::vector<std::array<NodeIndex, 2>> duplicates; ///< see duplicate_nodes()

private:
  template <typename Value>
  std::vector<double> gather(const unsigned int id, const Value &value) const;

  const unsigned int columns, rows;
  Foundation under;
  bool is_on_springs = false; ///< on any rank
  std::vector<double> extra;  ///< masses of the nodes; empty: none
  const std::vector<ElasticPhase<dim>> the_phases;
  const Periodicity periodic;
};

/** The springs of both. */
std::vector<SpringEntry> with_foundation(const Foundation &foundation,
                                         const std::vector<SpringEntry> &springs);

/** Volume (in mean cell volumes) of each phase. */
template <int dim>
std::vector<double> phase_volumes(const ElasticBody<dim> &body);

/**
 * The body that @p solver works on: a GridBody, or for StaticSolverKind::ml a MeshBody
 * with the same cells, distributed over @p communicator. @p material must outlive it.
 */
std::unique_ptr<ElasticBody<2>> make_body(const UniformMaterial &material,
                                          const StaticSolverKind solver,
                                          const MPI_Comm communicator);
} // namespace mesoslip

#endif
