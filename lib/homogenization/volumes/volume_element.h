#ifndef mesoslip_homogenization_volume_element_h
#define mesoslip_homogenization_volume_element_h

#include "grid/cell_planes.h"
#include "homogenization/response.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/** A cell under the unit load cases of a boundary condition. */
template <int dim>
struct LocalCell
{
  unsigned int phase             = 0;  ///< material number in the volume
  double volume                  = 0.; ///< in any unit, the same for all cells
  std::array<double, dim> centre = {}; ///< m

  /** Mean strain of the cell (SUBC: for 1 Pa), a column per load case, the last for one
   * kelvin. */
  UnitStrains<dim> strain = UnitStrains<dim>::Zero();
};

/** A dataset of cell values in a file. */
struct CellDataset
{
  std::string name;           ///< absolute path in the file
  std::size_t components = 1; ///< numbers per cell
  std::size_t first      = 0; ///< index of its first number in a cell
};

/**
 * A representative volume element with the load cases of KUBC, SUBC, PBC and MUBC.
 * Derived classes for plane grids, voxels and meshes differ in solver and in the storage
 * and order of cells.
 */
template <int dim>
class VolumeElement
{
public:
  using Action = std::function<void(const LocalCell<dim> &)>; ///< called for a cell
  using Values = std::function<void(const LocalCell<dim> &, double *out)>; ///< per cell

  /** Called with material number, volume and strains as in LocalCell. */
  using Sample =
    std::function<void(const unsigned int, const double, const UnitStrains<dim> &)>;

  virtual ~VolumeElement() = default;

  /**
   * Solves the load cases of @p condition: unit strains (KUBC, PBC, MUBC; engineering
   * shear) or stresses of 1 Pa (SUBC) and, if a material expands, one kelvin at zero
   * macroscopic strain (SUBC: stress), where MUBC prescribe the displacements of normal
   * strains. Calls @p case_done, if any, after each load case. Collective.
   * @throws NotConverged, which names condition and load case
   * @throws UserError if the volume does not allow the condition
   */
  virtual VolumeSums<dim> solve(const BoundaryCondition condition,
                                const double tolerance,
                                const std::function<void()> &case_done = {}) = 0;

  /** Whether this rank holds sums and cells of the last solve. */
  virtual bool is_here() const
  {
    return true;
  }

  /** The ranks that share the cells. */
  virtual MPI_Comm communicator() const = 0;

  /** Calls @p action for each locally owned cell under the condition that was solved
   * last. Not collective. */
  virtual void for_each(const Action &action) const = 0;

  /**
   * Calls @p visit with strain samples of the locally owned cells, such that the sum of
   * volume * strain^T C strain is exactly the discrete energy of the unit load cases for
   * any material stiffness C. Samples are quadrature points, or in rectangles and bricks
   * the orthogonal strain modes. The volumes have VolumeSums' unit; their sum is not the
   * cell volume. Not collective.
   */
  virtual void for_each_sample(const Sample &visit) const = 0;

  /**
   * Writes @p values (@p n numbers per cell) into the @p datasets of `<path>.part`,
   * which Hdf5File::reserve_rows() made. Collective.
   * @throws UserError
   */
  virtual void write(const std::string &path,
                     const std::vector<CellDataset> &datasets,
                     const std::size_t n,
                     const Values &values) const = 0;
};

/** VolumeElement::write() for locally owned cells that fill the @p rows of the datasets
 * in order, @p cells_in_row cells per row. */
template <int dim>
void write_rows_of_cells(const VolumeElement<dim> &volume,
                         const PlaneRange &rows,
                         const std::size_t cells_in_row,
                         const std::string &path,
                         const std::vector<CellDataset> &datasets,
                         const std::size_t n,
                         const typename VolumeElement<dim>::Values &values);
} // namespace mesoslip

#endif
