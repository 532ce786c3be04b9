#ifndef mesoslip_elasticity_uniform_material_h
#define mesoslip_elasticity_uniform_material_h

#include "grid/nodal_field.h"
#include "grid/uniform_grid.h"
#include "material/stiffness.h"
#include "material/voigt.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What operator and mass need to know about a phase. */
template <int dim>
struct ElasticPhase
{
  /** Pa; in 2D the plane stiffness (plane strain or plane stress). */
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero();

  /** kg/m^3 */
  double density = 0.;

  /** Whether quadrilaterals and hexahedra have their mean change of volume (in 2D of area)
   * everywhere, so that they do not lock (Hughes 1980, "B-bar"). */
  bool mean_dilatation = false;

  /** Phase::thermal_stress (Pa/K). */
  ZeroedVector<dim> thermal_stress = {};

  /**
   * Stiffness (Pa) against what the strain of a quadrilateral or hexahedron differs from its mean.
   * The cell's energy is that of the mean strain and that of the differences.
   */
  VoigtMatrix<dim> stiffness_about_mean() const
  {
    return mean_dilatation ? without_dilatation<dim>(stiffness) : stiffness;
  }
};

/**
 * Phase of a preconditioner: with mean dilatation it is less stiff against that. Then a multigrid smooths what
 * keeps the volume, and the other motions are a second cluster of eigenvalues, which costs conjugate gradients some
 * iterations whatever Poisson's ratio.
 */
template <int dim>
ElasticPhase<dim> phase_to_precondition(ElasticPhase<dim> phase)
{
  constexpr double largest_ratio = 0.45;
  if (phase.mean_dilatation)
    phase.stiffness = with_poisson_ratio_at_most<dim>(phase.stiffness, largest_ratio);
  return phase;
}

/** What operators need to know about @p phases. */
template <int dim>
std::vector<ElasticPhase<dim>> elastic_phases(const std::vector<Phase<dim>> &phases,
                                              const MeanDilatation choice)
{
  std::vector<ElasticPhase<dim>> result;
  for (const Phase<dim> &phase : phases)
    result.push_back({phase.stiffness, phase.density,
                      has_mean_dilatation<dim>(phase.stiffness, choice)});
  return result;
}

/** Whether one of the @p phases expands when it is heated. */
template <int dim>
bool has_expansion(const std::vector<ElasticPhase<dim>> &phases)
{
  for (const ElasticPhase<dim> &phase : phases)
    if (!phase.thermal_stress.isZero(0.))
      return true;
  return false;
}

/** Stiffness (Pa/m^2) of a rectangle with edges @p h (m) against the hourglass modes of x and y, whose
 * energy is h_x h_y / 24 g.H g; g: the sum of the displacements at two opposite corners less that
 * at the others. */
Eigen::Matrix2d hourglass_stiffness(const ElasticPhase<2> &phase,
                                    const std::array<double, 2> &h);

/** Stiffness (Pa) of that rectangle: node x + 2 y of its corners, two components a node. */
Eigen::Matrix<double, 8, 8> cell_stiffness(const ElasticPhase<2> &phase,
                                           const std::array<double, 2> &h);

/**
 * Opposite sides that are one and the same. Fields keep the duplicate last column (row);
 * operators read it and write it equal to the first.
 */
struct Periodicity
{
  bool x = false; ///< left and right side are one
  bool y = false; ///< bottom and top are one
};

/**
 * The material on a uniform grid of Q1 rectangles, by phase: one byte for each cell and up
 * to 256 phases. A node row has `grid.cells[0] + 1` columns, periodic or not, and there
 * are `grid.cells[1] + 1` rows. Always describes the whole grid, on every rank.
 */
class UniformMaterial
{
public:
  /**
   * @p phase_id holds one phase for each cell, x fastest; empty means phase 0 everywhere.
   * Phases that no cell is of are allowed. Throws std::invalid_argument on sizes or ids
   * that do not fit, spacings that are not positive, a density that is not positive or a
   * stiffness that is not symmetric and positive definite (in a phase that occurs).
   */
  UniformMaterial(const UniformGrid<2> &grid,
                  const std::vector<ElasticPhase<2>> &phases,
                  const std::vector<std::uint8_t> &phase_id = {},
                  const Periodicity periodicity             = Periodicity());

  /** The same material with other periodic sides. */
  UniformMaterial with(const Periodicity periodicity) const;

  /** The same cells of other phases, as many, which may have no stiffness and no density. */
  UniformMaterial with_phases(const std::vector<ElasticPhase<2>> &phases) const;

  /** The cells of the body. */
  const UniformGrid<2> &grid() const
  {
    return the_grid;
  }

  /** Stiffness (Pa) and density (kg/m^3) of each phase. */
  const std::vector<ElasticPhase<2>> &phases() const
  {
    return the_phases;
  }

  /** The phases that cells are of, ascending. */
  const std::vector<unsigned int> &phases_that_occur() const
  {
    return occurring;
  }

  /** Which sides are one. */
  Periodicity periodicity() const
  {
    return periodic;
  }

  /** True if all cells are of one phase: then phase_row() is not to be called. */
  bool is_homogeneous() const
  {
    return ids.empty();
  }

  /** D13 = D23 = 0 (to 1e-14 of the largest entry) in all phases that occur. */
  bool is_orthotropic() const;

  /** All phases that occur have one density. */
  bool has_uniform_density() const;

  /** Phase of cell @p i from the left, @p j from the bottom. */
  std::uint8_t phase_of(const unsigned int i, const unsigned int j) const
  {
    assert(i < the_grid.cells[0]);
    assert(j < the_grid.cells[1]);
    return ids.empty() ? occurring[0] : ids[j * id_stride + i];
  }

  /** Phases of cell row @p j, followed by at least 64 more readable bytes. */
  const std::uint8_t *phase_row(const unsigned int j) const
  {
    return ids.data() + j * id_stride;
  }

  /** Columns of nodes, the duplicate of a periodic side included. */
  unsigned int n_columns() const
  {
    return the_grid.cells[0] + 1;
  }

  /** Rows of nodes, the duplicate of a periodic side included. */
  unsigned int n_rows() const
  {
    return the_grid.cells[1] + 1;
  }

  /** Sets the duplicate column and row of a field on the whole grid to the first ones. */
  template <typename Number>
  void copy_duplicates(NodalField<Number> &field) const
  {
    for (unsigned int c = 0; c < 2; ++c)
      {
        for (unsigned int j = 0; periodic.x && j < field.n_rows(); ++j)
          field.row(c, j)[the_grid.cells[0]] = field.row(c, j)[0];
        if (periodic.y)
          std::copy_n(field.row(c, 0), n_columns(), field.row(c, the_grid.cells[1]));
      }
  }

  /**
   * Lumped mass per unit thickness (kg/m) of the n_columns() nodes of global row @p j.
   * Nodes on a periodic side carry the mass of both sides, in both copies.
   */
  void mass_row(const unsigned int j, double *mass) const;

  /** Sum of density times area (kg/m). */
  double total_mass() const;

private:
  UniformGrid<2> the_grid;
  std::vector<ElasticPhase<2>> the_phases;
  Periodicity periodic;
  std::vector<unsigned int> occurring;
  std::vector<std::uint8_t> ids; ///< rows @p id_stride apart; empty if all are equal
  std::size_t id_stride = 0;
};
} // namespace mesoslip

#endif
