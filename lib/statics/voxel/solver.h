#ifndef mesoslip_statics_voxel_solver_h
#define mesoslip_statics_voxel_solver_h

#include "statics/voxel/conjugate_gradients.h"
#include "statics/voxel/packed_field.h"
#include "statics/voxel/stiffness.h"

#include <array>
#include <functional>
#include <vector>

namespace mesoslip::voxel
{
/** Whether the displacement along axis c is zero on the two sides across an axis:
 *  [across][c]. */
using HeldOnSides = std::array<std::array<bool, 3>, 3>;

/**
 * The six unit load cases of a volume of voxels, see Stiffness and ConjugateGradients.
 *
 * Held, periodic and mixed sides: u = E.x + fluctuation with a unit strain E (engineering
 * shear), the fluctuation being zero at the sides (KUBC), periodic (PBC, up to a translation)
 * or zero in some components (MUBC, see hold()).
 * Free sides: tractions S.n of a unit stress (SUBC, up to a rigid motion), and the whole
 * displacement is called fluctuation.
 *
 * A flat box (VoxelGrid::flat) has three load cases, xx, zz and xz in Voigt order: what the
 * matrices below have in other rows and columns is neither read nor, in results, of meaning.
 *
 * Planes across z are divided among the ranks (see VoxelGrid); a box of fewer than two a
 * rank is solved by every rank alone. All members but those that say so are collective.
 */
class Solver
{
public:
  /** Cells of @p map, which all ranks have. See below. */
  Solver(const PhaseMap<3> &map,
         const std::vector<ElasticPhase<3>> &the_phases,
         const Sides sides,
         const MPI_Comm communicator = MPI_COMM_SELF)
    : Solver(
        CellPlanes::of_whole(map.grid, CellView(map.id), communicator), the_phases, sides)
  {
  }

  /**
   * Phases of the cells of a box, which are needed no longer, have @p the_phases; at
   * most 65535 of them. From 256 on they are called materials: cells take two bytes
   * instead of one, and all count as anisotropic. @p flat: see VoxelGrid; the box has one cell
   * along y, and there are at most 255 phases.
   * @throws std::invalid_argument for a phase without a stiffness
   */
  Solver(const CellPlanes &cells,
         const std::vector<ElasticPhase<3>> &the_phases,
         const Sides sides,
         const bool flat = false);

  /** Of mixed sides: components of the fluctuation that are zero on them from now on; to be
   *  called before the first solve(), and between load cases that differ. */
  void hold(const HeldOnSides &held);

  /** Number of the load case of one kelvin without macroscopic strain (free sides: stress), where
   *  ElasticPhase::thermal_stress is what holds it. */
  static constexpr unsigned int heat = 6;

  /**
   * Solves load case @p k (Voigt, or heat) from zero until the residual is @p tolerance times that
   * of zero. @p limit bounds the iterations.
   * @throws NotConverged
   */
  SolverReport
  solve(const unsigned int k, const double tolerance, const unsigned int limit = 2000);

  /** Solves all; @p progress gets the number of those that are done. */
  std::array<SolverReport, 6>
  solve_all(const double tolerance,
            const std::function<void(unsigned int)> &progress = {});

  /**
   * Effective stiffness (Pa) from the energies, which is of second order in the error of
   * the solutions; entries of two load cases that hold() other components are their energy, but
   * no stiffness. Only after solve_all().
   */
  VoigtMatrix<3> effective_stiffness() const;

  /** What the cells of a phase have together. */
  struct PhaseStrains
  {
    double n_cells; ///< number of cells of the phase, summed over the ranks

    /** Sum over these cells of RowOfCells::strain, a column for each load case that was
     *  solved. */
    UnitStrains<3> sum;
  };

  /** Of each phase, in the order of the stiffnesses. Not collective. */
  std::vector<PhaseStrains> phase_strains() const;

  /** Strains of a row of cells along x. */
  struct RowOfCells
  {
    std::vector<unsigned int> phase; ///< of each cell

    /** Mean strain (for free sides: for 1 Pa) of each cell, that of E included: [load
     *  case][Voigt component]. */
    std::array<std::array<std::vector<double>, 6>, 7> strain;
  };

  /** Evaluates row @p j along y of plane @p k of cells; planes are numbered from the first
   *  of grid().n_cell_planes() of this rank. Not collective. */
  void evaluate(const unsigned int j, const unsigned int k, RowOfCells &row) const;

  /** Displacements of the nodes of a row of cells along x. */
  struct NodesOfRow
  {
    std::vector<unsigned int> phase; ///< of each cell

    /** Component @p c of a field, under load case @p load, of node @p i of the row of nodes at the lower (0) or
     *  upper ends along y (1) and z (2) of the cells: the fluctuation, for free sides the displacement for 1 Pa;
     *  in the unit of length of grid(). */
    double displacement(const unsigned int load,
                        const unsigned int c,
                        const unsigned int side,
                        const unsigned int i) const
    {
      const std::vector<double> &values = u[load][c][side];
      return values.empty() ? 0. : factor[load] * values[first + i];
    }

    std::array<double, 7> factor = {}; ///< from the numbers that are kept
    unsigned int first           = 0;  ///< ghosts before the first node
    std::array<std::array<std::array<std::vector<double>, 4>, 3>, 7> u; ///< that are kept
  };

  /** Evaluates the same row as the function above. */
  void evaluate(const unsigned int j, const unsigned int k, NodesOfRow &row) const;

  /** Forces (N) of the load of case k less those of the unknowns @p v, a field of grid(),
   *  in edges along y (for free sides: times the unit of stress over 1 Pa, the largest
   *  entry of all stiffnesses); its ghosts are set. */
  void residual(const unsigned int k, VoxelField<double> &v, VoxelField<double> &out);

  /** Nodes and cells as the fields count them; lengths in edges along y. Not collective. */
  const VoxelGrid &grid() const
  {
    return K.grid;
  }

private:
  CellLoad load_of(const unsigned int k) const;
  VoigtMatrix<3> mean_stiffness() const;
  double outer(const unsigned int k,
               VoxelField<double> &v,
               VoxelField<float> &out,
               double *exact = nullptr);
  double gross_load(const unsigned int k) const;
  double outer_of_heat(VoxelField<double> &v, VoxelField<float> &out);
  void add_forces_of_heat(VoxelField<double> &force) const;
  double unit_of_kept(const unsigned int load) const;
  void keep(const unsigned int k);
  double dot_with_kept(const unsigned int k);
  void sum_strains(const unsigned int k);
  void read_phases(const unsigned int line,
                   const unsigned int plane,
                   std::vector<unsigned int> &phase) const;
  std::size_t first_cell_of_row(const unsigned int line, const unsigned int plane) const;

  const Stiffness K;
  std::unique_ptr<Multigrid> multigrid; ///< none without unknowns, or before hold()
  ConjugateGradients iteration;
  HeldOnSides held_on_sides = {};
  unsigned int n_solved     = 0;       ///< cases in order that are
  VoxelField<double> u;                ///< of the case that is being solved
  std::array<PackedField, 7> kept;     ///< those that were
  std::vector<UnitStrains<3>> strains; ///< of the fluctuations, summed for each phase
  VoigtMatrix<3> corrections = VoigtMatrix<3>::Zero(); ///< u_k . residual of l, k <= l
};
} // namespace mesoslip::voxel

#endif
