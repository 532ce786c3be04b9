#ifndef mesoslip_statics_multigrid_axis_h
#define mesoslip_statics_multigrid_axis_h

#include "elasticity/dof_mask.h"

#include <cstdint>
#include <vector>

namespace mesoslip::multigrid
{
/**
 * An axis of a grid of the hierarchy: cells + 1 ascending node positions, in units of
 * the cell width of the finest grid. On a periodic axis the last node is a copy of the
 * first.
 */
struct Axis
{
  bool periodic = false;        ///< whether the last node is a copy of the first
  std::vector<double> position; ///< node positions, one more than cells

  /** Number of cells, at least one. */
  unsigned int n_cells() const
  {
    return static_cast<unsigned int>(position.size()) - 1;
  }

  /** Number of nodes without periodic copies. */
  unsigned int n_nodes() const
  {
    return periodic ? n_cells() : n_cells() + 1;
  }

  /** Width of a cell, in the unit of the positions. */
  double width(const unsigned int cell) const
  {
    return position[cell + 1] - position[cell];
  }

  /** An axis of cells of equal width @p spacing. */
  static Axis
  uniform(const unsigned int n_cells, const double spacing, const bool periodic)
  {
    Axis axis;
    axis.periodic = periodic;
    axis.position.resize(n_cells + 1);
    for (unsigned int i = 0; i <= n_cells; ++i)
      axis.position[i] = i * spacing;
    return axis;
  }
};

/**
 * Coarsening of one axis: every coarse node is a fine node. If halved, a coarse cell
 * consists of two fine cells with a middle node; with an odd number of cells the last
 * but one coarse cell is a single fine cell. (At the border, rotations of its coarse
 * nodes would have no effect on the finest grid.)
 */
class AxisCoarsening
{
public:
  AxisCoarsening() = default;

  /** Halves the number of cells if @p halve, else keeps the grid. */
  AxisCoarsening(const Axis &fine, const bool halve)
    : is_halved(halve)
    , coarse_cells(halve ? (fine.n_cells() + 1) / 2 : fine.n_cells())
    , regular_cells(!halve ? 0
                           : (fine.n_cells() % 2 == 0 ? coarse_cells : coarse_cells - 2))
  {
  }

  /** Number of coarse cells along this direction. */
  unsigned int n_coarse_cells() const
  {
    return coarse_cells;
  }

  /** Number of leading coarse cells that are regular: start(k) = 2 k, with a middle node.
   * All of them if the number of fine cells is even. */
  unsigned int n_regular() const
  {
    return regular_cells;
  }

  /** The fine node at coarse node @p k (0 to n_coarse_cells()). */
  unsigned int start(const unsigned int k) const
  {
    return !is_halved ? k : (k <= regular_cells ? 2 * k : 2 * k - 1);
  }

  /** The coarse cell that fine cell @p i belongs to. */
  unsigned int coarse_cell(const unsigned int i) const
  {
    if (!is_halved)
      return i;
    return i < 2 * regular_cells ? i / 2 : regular_cells + (i > 2 * regular_cells);
  }

  /** Whether coarse cell @p k has a middle node. */
  bool has_middle(const unsigned int k) const
  {
    return start(k + 1) - start(k) == 2;
  }

  /** Positions of the coarse nodes. */
  Axis coarse(const Axis &fine) const
  {
    Axis axis;
    axis.periodic = fine.periodic;
    axis.position.resize(coarse_cells + 1);
    for (unsigned int k = 0; k <= coarse_cells; ++k)
      axis.position[k] = fine.position[start(k)];
    return axis;
  }

private:
  bool is_halved             = false;
  unsigned int coarse_cells  = 0;
  unsigned int regular_cells = 0;
};

/**
 * The constrained unknowns of one grid, by node rows. On coarse grids a node has the
 * constraints of the coincident fine node; its rotation is constrained if both
 * displacements are.
 */
class ConstrainedUnknowns
{
public:
  /** Constrained components of one node of a row. */
  struct Node
  {
    unsigned int column; ///< column of the node
    std::uint8_t bits;   ///< bit c: component c (0, 1: displacement, 2: rotation)

    /** Whether component @p c is constrained. */
    bool has(const unsigned int c) const
    {
      return (bits >> c & 1U) != 0;
    }
  };

  ConstrainedUnknowns() = default;

  /** Constraints of the finest grid; copies at periodic sides are merged with their
   * masters. */
  ConstrainedUnknowns(const DofMask &mask, const Axis &x, const Axis &y)
    : rows(y.n_nodes())
  {
    for (unsigned int j = 0; j < y.n_nodes(); ++j)
      for (unsigned int i = 0; i < x.n_nodes(); ++i)
        {
          const unsigned int copy_i = x.periodic && i == 0 ? mask.n_columns() - 1 : i,
                             copy_j = y.periodic && j == 0 ? mask.n_rows() - 1 : j;
          const unsigned int bits   = mask.bits({i, j}) | mask.bits({copy_i, j}) |
                                    mask.bits({i, copy_j}) | mask.bits({copy_i, copy_j});
          if (bits != 0)
            rows[j].push_back({i, static_cast<std::uint8_t>(bits == 3 ? 7 : bits)});
        }
  }

  /** Constraints of the next coarser grid; @p x and @p y map its columns and rows to the
   * fine grid. */
  ConstrainedUnknowns(const ConstrainedUnknowns &fine,
                      const AxisCoarsening &x,
                      const AxisCoarsening &y)
    // On a periodic y axis, the last coarse row is a copy of the first.
    : rows(y.n_coarse_cells() + (y.start(y.n_coarse_cells()) < fine.rows.size() ? 1 : 0))
  {
    for (unsigned int J = 0; J < rows.size(); ++J)
      {
        unsigned int I = 0;
        for (const Node &node : fine.rows[y.start(J)])
          {
            while (I <= x.n_coarse_cells() && x.start(I) < node.column)
              ++I;
            if (I <= x.n_coarse_cells() && x.start(I) == node.column)
              rows[J].push_back({I, node.bits});
          }
      }
  }

  /** Constrained nodes of row @p j, sorted by column. */
  const std::vector<Node> &row(const unsigned int j) const
  {
    return rows[j];
  }

  /** Sets the constrained unknowns of a field to zero. */
  template <typename Field>
  void clear(Field &field, const unsigned int n_components) const
  {
    for (unsigned int j = 0; j < rows.size(); ++j)
      for (const Node &node : rows[j])
        for (unsigned int c = 0; c < n_components; ++c)
          if (node.has(c))
            field.row(c, j)[node.column] = 0;
  }

private:
  std::vector<std::vector<Node>> rows;
};
} // namespace mesoslip::multigrid

#endif
