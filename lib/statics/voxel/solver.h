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
 * [across][c]. */
using HeldOnSides = std::array<std::array<bool, 3>, 3>;

/**
 * The six unit load cases of a volume of voxels, see Stiffness and ConjugateGradients.
 *
 * Held, periodic and mixed sides: u = E.x + fluctuation with a unit strain E
 * (engineering shear), the fluctuation being zero at the sides (KUBC), periodic (PBC, up
 * to a translation) or zero in some components (MUBC, see hold()).
 * Free sides: tractions S.n of a unit stress (SUBC, up to a rigid motion); the
 * fluctuation is then the whole displacement.
 *
 * A flat box (VoxelGrid::flat) has three load cases, xx, zz and xz in Voigt order; other
 * rows and columns of the matrices below are not read, and undefined in results.
 *
 * Planes across z are divided among the ranks (see VoxelGrid); a box of fewer than two
 * planes per rank is solved by every rank on its own. All members are collective unless
 * documented otherwise.
 */
class Solver
{
public:
  /** Cells of @p map, which is replicated on all ranks; see the other constructor. */
  Solver(const PhaseMap<3> &map,
         const std::vector<ElasticPhase<3>> &the_phases,
         const Sides sides,
         const MPI_Comm communicator = MPI_COMM_SELF)
    : Solver(
        CellPlanes::of_whole(map.grid, CellView(map.id), communicator), the_phases, sides)
  {
  }

  /**
   * @p cells holds the phase numbers of the cells of a box (not needed later) in
   * @p the_phases; at most 65535 phases. From 256 on they are called materials: cells
   * take two bytes instead of one, and all are treated as anisotropic. @p flat: see
   * VoxelGrid; the box has one cell along y, and there are at most 255 phases.
   * @throws std::invalid_argument for a phase without a stiffness
   */
  Solver(const CellPlanes &cells,
         const std::vector<ElasticPhase<3>> &the_phases,
         const Sides sides,
         const bool flat = false);

  /** For mixed sides: sets the components of the fluctuation that are zero on them; call
   * it before the first solve(), and between load cases with different constraints. */
  void hold(const HeldOnSides &held);

  /** Number of the load case of one kelvin without macroscopic strain (free sides:
   * stress); its load is ElasticPhase::thermal_stress. */
  static constexpr unsigned int heat = 6;

  /**
   * Solves load case @p k (Voigt, or heat) from zero until the residual is @p tolerance
   * times the initial one. @p limit bounds the iterations.
   * @throws NotConverged
   */
  SolverReport
  solve(const unsigned int k, const double tolerance, const unsigned int limit = 2000);

  /** Solves all load cases; @p progress gets the number of completed cases. */
  std::array<SolverReport, 6>
  solve_all(const double tolerance,
            const std::function<void(unsigned int)> &progress = {});

  /**
   * Effective stiffness (Pa) from the energies, of second order in the error of the
   * solutions. Entries between load cases with different hold() are energies without
   * meaning as stiffness. Only after solve_all().
   */
  VoigtMatrix<3> effective_stiffness() const;

  /** Strain sums of a phase. */
  struct PhaseStrains
  {
    double n_cells; ///< number of cells of the phase, summed over the ranks

    /** Sum of RowOfCells::strain over these cells, a column for each solved load case. */
    UnitStrains<3> sum;
  };

  /** Sums by phase, in the order of the phases. Not collective. */
  std::vector<PhaseStrains> phase_strains() const;

  /** Strains of a row of cells along x. */
  struct RowOfCells
  {
    std::vector<unsigned int> phase; ///< per cell

    /** Mean strain of each cell (free sides: for 1 Pa), including E: [load case][Voigt
     * component]. */
    std::array<std::array<std::vector<double>, 6>, 7> strain;
  };

  /** Evaluates row @p j along y of plane @p k of cells; planes are numbered from the first
   *  of grid().n_cell_planes() of this rank. Not collective. */
  void evaluate(const unsigned int j, const unsigned int k, RowOfCells &row) const;

  /** Displacements of the nodes of a row of cells along x. */
  struct NodesOfRow
  {
    std::vector<unsigned int> phase; ///< per cell

    /** Component @p c of a field under load case @p load at node @p i of a row of nodes.
     * @p side: lower (0) or upper end of the cells along y (adds 1) and z (adds 2). The
     * field is the fluctuation, for free sides the displacement for 1 Pa; in the unit of
     * length of grid(). */
    double displacement(const unsigned int load,
                        const unsigned int c,
                        const unsigned int side,
                        const unsigned int i) const
    {
      const std::vector<double> &values = u[load][c][side];
      return values.empty() ? 0. : factor[load] * values[first + i];
    }

    std::array<double, 7> factor = {}; ///< scaling of the stored numbers
    unsigned int first           = 0;  ///< ghosts before the first node
    std::array<std::array<std::array<std::vector<double>, 4>, 3>, 7> u; ///< kept numbers
  };

  /** Evaluates the nodal displacements of the same row. */
  void evaluate(const unsigned int j, const unsigned int k, NodesOfRow &row) const;

  /** Residual forces (N): load of case k minus forces of the unknowns @p v, a field of
   * grid(), in edges along y (free sides: times the unit of stress over 1 Pa, the
   * largest entry of all stiffnesses); its ghosts are set. */
  void residual(const unsigned int k, VoxelField<double> &v, VoxelField<double> &out);

  /** Nodes and cells in the numbering of the fields; lengths in edges along y. Not
   * collective. */
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
  unsigned int n_solved     = 0;       ///< number of load cases solved so far, in order
  VoxelField<double> u;                ///< solution of the current load case
  std::array<PackedField, 7> kept;     ///< solutions of earlier load cases
  std::vector<UnitStrains<3>> strains; ///< sums of fluctuation strains per phase
  VoigtMatrix<3> corrections = VoigtMatrix<3>::Zero(); ///< u_k . residual of l, k <= l
};
} // namespace mesoslip::voxel

#endif
