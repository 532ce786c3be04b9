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
  unsigned int phase             = 0;  ///< number of its material in the volume
  double volume                  = 0.; ///< in any unit, that of the other cells
  std::array<double, dim> centre = {}; ///< m

  /** Mean strain (SUBC: for 1 Pa) of the cell, a column for each load case and the last for one kelvin. */
  UnitStrains<dim> strain = UnitStrains<dim>::Zero();
};

/** Values of all cells that become a dataset of a file. */
struct CellDataset
{
  std::string name;           ///< absolute path in the file
  std::size_t components = 1; ///< numbers a cell
  std::size_t first      = 0; ///< of them among all numbers of the cell
};

/**
 * A representative volume element with the load cases of KUBC, SUBC, PBC and MUBC. Plane grids, voxels
 * and meshes differ in how they solve these and in how they hold and order the cells.
 */
template <int dim>
class VolumeElement
{
public:
  using Action = std::function<void(const LocalCell<dim> &)>; ///< with a cell
  using Values = std::function<void(const LocalCell<dim> &, double *out)>; ///< of a cell

  /** With the number of a material, a volume and strains as of LocalCell. */
  using Sample =
    std::function<void(const unsigned int, const double, const UnitStrains<dim> &)>;

  virtual ~VolumeElement() = default;

  /**
   * Solves the load cases of @p condition: unit strains (KUBC, PBC, MUBC; engineering shear) or stresses
   * of 1 Pa (SUBC) and, if a material expands, one kelvin at zero macroscopic strain (SUBC: stress), for which
   * MUBC hold what they hold for normal strains. Calls @p case_done, if any, after each load case. Collective.
   * @throws NotConverged, which names condition and load case
   * @throws UserError if the volume does not allow the condition
   */
  virtual VolumeSums<dim> solve(const BoundaryCondition condition,
                                const double tolerance,
                                const std::function<void()> &case_done = {}) = 0;

  /** Whether this rank has sums and cells of what was solved. */
  virtual bool is_here() const
  {
    return true;
  }

  /** The ranks that each have a part of the cells. */
  virtual MPI_Comm communicator() const = 0;

  /** Calls @p action with each cell of this rank under the condition that was solved last. Not
   * collective. */
  virtual void for_each(const Action &action) const = 0;

  /**
   * Calls @p visit with strains in the cells of this rank such that the sum of volume * strain^T C strain is the
   * energy of the unit load cases exactly as the cells have it, whatever the stiffness C of a material:
   * at quadrature points, or of the parts of the strain that are orthogonal in a rectangle or brick. The
   * volumes are in the unit of VolumeSums, and do not add up to that of the cells. Not collective.
   */
  virtual void for_each_sample(const Sample &visit) const = 0;

  /**
   * Writes @p values, @p n numbers a cell, into the @p datasets of `<path>.part`, which
   * were made by Hdf5File::reserve_rows(). Collective. @throws UserError
   */
  virtual void write(const std::string &path,
                     const std::vector<CellDataset> &datasets,
                     const std::size_t n,
                     const Values &values) const = 0;
};

/** VolumeElement::write() where the cells of a rank fill the @p rows of the datasets, one after the other,
 * @p cells_in_row cells each. */
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
