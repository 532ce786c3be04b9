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
/** Elastic properties of a phase. */
template <int dim>
struct ElasticPhase
{
  /** Voigt stiffness (Pa); in 2D the plane stiffness (plane strain or plane stress). */
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero();

  /** Density (kg/m^3). */
  double density = 0.;

  /**
   * Whether quadrilaterals and hexahedra use their mean dilatation (in 2D change of area)
   * at all points, which avoids volumetric locking (Hughes 1980, "B-bar").
   */
  bool mean_dilatation = false;

  /** Phase::thermal_stress (Pa/K). */
  ZeroedVector<dim> thermal_stress = {};

  /**
   * Stiffness (Pa) for the deviation of the strain of a quadrilateral or hexahedron from
   * its mean. The energy of a cell is the sum of the energies of mean strain and
   * deviation.
   */
  VoigtMatrix<dim> stiffness_about_mean() const
  {
    return mean_dilatation ? without_dilatation<dim>(stiffness) : stiffness;
  }
};

/**
 * Phase of a preconditioner: with mean dilatation, the resistance to changes of volume is
 * reduced. Multigrid then smooths the isochoric motions, and the other motions form a
 * second cluster of eigenvalues, which costs conjugate gradients some iterations for any
 * Poisson's ratio.
 */
template <int dim>
ElasticPhase<dim> phase_to_precondition(ElasticPhase<dim> phase)
{
  constexpr double largest_ratio = 0.45;
  if (phase.mean_dilatation)
    phase.stiffness = with_poisson_ratio_at_most<dim>(phase.stiffness, largest_ratio);
  return phase;
}

/** Elastic properties of @p phases for operators. */
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

/** Whether one of the @p phases has thermal expansion. */
template <int dim>
bool has_expansion(const std::vector<ElasticPhase<dim>> &phases)
{
  for (const ElasticPhase<dim> &phase : phases)
    if (!phase.thermal_stress.isZero(0.))
      return true;
  return false;
}

/**
 * Stiffness H (Pa/m^2) of a rectangle with edges @p h (m) for the hourglass modes of x
 * and y, with energy h_x h_y / 24 g.H g; g is the sum of the displacements at two
 * opposite corners minus the sum at the other two.
 */
Eigen::Matrix2d hourglass_stiffness(const ElasticPhase<2> &phase,
                                    const std::array<double, 2> &h);

/**
 * Stiffness (Pa) of a rectangle with edges @p h (m): corners numbered x + 2 y, two
 * components per node.
 */
Eigen::Matrix<double, 8, 8> cell_stiffness(const ElasticPhase<2> &phase,
                                           const std::array<double, 2> &h);

/**
 * Periodic pairs of opposite sides. Fields contain the last column (row), the periodic
 * copy of the first; operators read it and write both alike.
 */
struct Periodicity
{
  bool x = false; ///< left and right side are periodic
  bool y = false; ///< bottom and top are periodic
};

/**
 * Material on a uniform grid of Q1 rectangles, by phase: one byte per cell, up to 256
 * phases. A node row has `grid.cells[0] + 1` columns, periodic or not; there are
 * `grid.cells[1] + 1` rows. Replicated: always describes the whole grid.
 */
class UniformMaterial
{
public:
  /**
   * @p phase_id has the phase of each cell, x fastest; empty means phase 0 everywhere.
   * Phases without cells are allowed. Throws std::invalid_argument for inconsistent sizes
   * or ids, spacings that are not positive, a density that is not positive or a stiffness
   * that is not symmetric and positive definite (in a phase with cells).
   */
  UniformMaterial(const UniformGrid<2> &grid,
                  const std::vector<ElasticPhase<2>> &phases,
                  const std::vector<std::uint8_t> &phase_id = {},
                  const Periodicity periodicity             = Periodicity());

  /** The same material with other periodic sides. */
  UniformMaterial with(const Periodicity periodicity) const;

  /**
   * The same cells with other @p phases, as many as before, which may have zero stiffness
   * and density.
   */
  UniformMaterial with_phases(const std::vector<ElasticPhase<2>> &phases) const;

  /** Grid of the cells. */
  const UniformGrid<2> &grid() const
  {
    return the_grid;
  }

  /** Stiffness (Pa) and density (kg/m^3) of each phase. */
  const std::vector<ElasticPhase<2>> &phases() const
  {
    return the_phases;
  }

  /** Phases that have cells, ascending. */
  const std::vector<unsigned int> &phases_that_occur() const
  {
    return occurring;
  }

  /** Periodic pairs of opposite sides. */
  Periodicity periodicity() const
  {
    return periodic;
  }

  /** Whether all cells have the same phase; phase_row() must not be called then. */
  bool is_homogeneous() const
  {
    return ids.empty();
  }

  /**
   * Whether D13 = D23 = 0 (to 1e-14 of the largest entry) in all phases that have cells.
   */
  bool is_orthotropic() const;

  /** Whether all phases that have cells have the same density. */
  bool has_uniform_density() const;

  /** Phase of cell @p i from the left, @p j from the bottom. */
  std::uint8_t phase_of(const unsigned int i, const unsigned int j) const
  {
    assert(i < the_grid.cells[0]);
    assert(j < the_grid.cells[1]);
    return ids.empty() ? occurring[0] : ids[j * id_stride + i];
  }

  /** Phases of cell row @p j, followed by at least 64 readable bytes. */
  const std::uint8_t *phase_row(const unsigned int j) const
  {
    return ids.data() + j * id_stride;
  }

  /** Columns of nodes, including periodic copies. */
  unsigned int n_columns() const
  {
    return the_grid.cells[0] + 1;
  }

  /** Rows of nodes, including periodic copies. */
  unsigned int n_rows() const
  {
    return the_grid.cells[1] + 1;
  }

  /** Updates the periodic copies, last column and row, of a field on the whole grid. */
  template <typename Number>
  void update_copies(NodalField<Number> &field) const
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
   * Periodic copies and masters both have the mass of both sides.
   */
  void mass_row(const unsigned int j, double *mass) const;

  /** Sum of density times area (kg/m). */
  double total_mass() const;

private:
  UniformGrid<2> the_grid;
  std::vector<ElasticPhase<2>> the_phases;
  Periodicity periodic;
  std::vector<unsigned int> occurring;
  std::vector<std::uint8_t> ids; ///< rows of length id_stride; empty if all are equal
  std::size_t id_stride = 0;
};
} // namespace mesoslip

#endif
