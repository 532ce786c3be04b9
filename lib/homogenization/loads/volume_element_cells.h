#ifndef mesoslip_homogenization_loads_volume_element_cells_h
#define mesoslip_homogenization_loads_volume_element_cells_h

#include "material/voigt.h"

#include <array>
#include <functional>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
/** A cell under the unit load cases of a boundary condition. */
template <int dim>
struct LocalCell
{
  unsigned int phase             = 0;  ///< of it, as LocalFields numbers them
  double volume                  = 0.; ///< in any unit, that of the other cells
  std::array<double, dim> centre = {}; ///< m

  /** Mean strain (SUBC: for 1 Pa) of the cell, a column for each load case. */
  VoigtMatrix<dim> strain = VoigtMatrix<dim>::Zero();
};

/** Values of all cells that become a dataset of a file. */
struct CellDataset
{
  std::string name;           ///< absolute path in the file
  std::size_t components = 1; ///< numbers a cell
  std::size_t first      = 0; ///< of them among all numbers of the cell
};

/** Of the @p values of consecutive cells, @p n numbers each, those of a dataset. */
inline std::vector<double> values_of(const CellDataset &dataset,
                                     const std::vector<double> &values,
                                     const std::size_t n)
{
  std::vector<double> part;
  part.reserve(values.size() / n * dataset.components);
  for (std::size_t begin = dataset.first; begin < values.size(); begin += n)
    for (std::size_t c = 0; c < dataset.components; ++c)
      part.push_back(values[begin + c]);
  return part;
}

/**
 * The cells of a volume whose unit load cases were solved, gone through one by one: grids,
 * meshes and voxels differ in how they hold and order them.
 */
template <int dim>
class VolumeElementCells
{
public:
  using Action = std::function<void(const LocalCell<dim> &)>; ///< with a cell
  using Values = std::function<void(const LocalCell<dim> &, double *out)>; ///< of a cell

  virtual ~VolumeElementCells() = default;

  /** Ranks that each have a part of the cells. */
  virtual MPI_Comm communicator() const = 0;

  /** Calls @p action with each cell of this rank. Not collective. */
  virtual void for_each(const Action &action) const = 0;

  /**
   * Writes @p values, @p n numbers a cell, into the @p datasets of `<path>.part`, which
   * were made by Hdf5File::reserve_rows(). Collective. @throws UserError
   */
  virtual void write(const std::string &path,
                     const std::vector<CellDataset> &datasets,
                     const std::size_t n,
                     const Values &values) const = 0;
};
} // namespace mesoslip

#endif
