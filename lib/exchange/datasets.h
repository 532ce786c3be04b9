#ifndef mesoslip_exchange_datasets_h
#define mesoslip_exchange_datasets_h

#include "base/errors.h"
#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "material/voigt.h"

#include <limits>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * @name Functions shared by several exchange files
 * @p program wrote or writes the file; used in messages.
 * @{
 */

/** Values of a dataset in a file, and of a column in a table. */
struct Series
{
  std::string name;                  ///< name of the dataset in its group
  std::string unit;                  ///< SI symbol, "-" for pure numbers
  const std::vector<double> *values; ///< not null
  std::size_t components = 0;        ///< length of the last axis; 0: a number per entry
};

/** Writes datasets of @p group with their units, [n] or [n][components]. */
void write_series(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Series> &series);

/**
 * Writes scalar series as a table of about @p most_rows evenly spaced rows; its length is
 * the length of the shortest series.
 */
void write_table(const std::string &path,
                 const std::vector<Series> &series,
                 const std::size_t most_rows = std::numeric_limits<std::size_t>::max());

/** Writes a dataset with its unit. */
template <typename T>
void write_dataset(Hdf5File &file,
                   const std::string &name,
                   const Shape &shape,
                   const std::vector<T> &values,
                   const std::string &unit = "-")
{
  file.write(name, shape, values);
  file.write_unit(name, unit);
}

/** Shape of a dataset with a number per cell: [ny][nx] or [nz][ny][nx]. */
template <int dim>
Shape shape_of_cells(const UniformGrid<dim> &grid)
{
  return {grid.cells.rbegin(), grid.cells.rend()};
}

/**
 * Reads the values of @p count cells from number @p first on. The dataset has the shape
 * [nz][ny][nx] or [n], followed by @p n_axes axes for the values of a cell. Whole rows of
 * the first axis are read. @throws UserError
 */
template <typename T>
std::vector<T> read_cells(const Hdf5File &file,
                          const std::string &dataset,
                          const std::size_t first,
                          const std::size_t count,
                          const std::string &hint  = "",
                          const std::size_t n_axes = 0)
{
  if (count == 0)
    return {};
  Shape extent = file.shape(dataset, hint);
  if (extent.size() <= n_axes)
    throw UserError(file.path() + ": " + dataset + " has " +
                    std::to_string(extent.size()) + " axes, and cells need " +
                    std::to_string(n_axes + 1) + " or more; " + hint);
  std::size_t cells = 1, values = 1;
  for (std::size_t axis = 1; axis < extent.size(); ++axis)
    (axis + n_axes < extent.size() ? cells : values) *= extent[axis];
  Shape offset(extent.size(), 0);
  offset[0]             = first / cells;
  extent[0]             = (first + count + cells - 1) / cells - offset[0];
  std::vector<T> result = file.read_block<T>(dataset, offset, extent, hint);
  const auto begin = static_cast<std::ptrdiff_t>((first - offset[0] * cells) * values);
  result.erase(result.begin(), result.begin() + begin);
  result.resize(count * values);
  return result;
}

/** Reads the attributes of /grid. @throws UserError */
template <int dim>
UniformGrid<dim> read_grid(const Hdf5File &file, const std::string &program);

/** Writes the attributes of /grid. */
template <int dim>
void write_grid(Hdf5File &file, const UniformGrid<dim> &grid);

/**
 * Reads name, stiffness, density and, if requested, friction_coefficient of phases.
 * @throws UserError, also for unphysical values
 */
template <int dim>
std::vector<Phase<dim>> read_phases(const Hdf5File &file,
                                    const std::string &group,
                                    const bool with_friction,
                                    const std::string &program);

/** Writes name, stiffness, density and, if requested, friction_coefficient of phases. */
template <int dim>
void write_phases(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Phase<dim>> &phases,
                  const bool with_friction);

/**
 * Checks a stiffness. @throws UserError naming @p object of the file unless @p D is a
 * valid stiffness
 */
template <int dim>
void require_stiffness(const Hdf5File &file,
                       const std::string &object,
                       const VoigtMatrix<dim> &D,
                       const std::string &program);

/** Checks phase indices. @throws UserError unless all @p id are less than @p n */
void require_phases(const Hdf5File &file,
                    const std::string &dataset,
                    const std::vector<std::uint8_t> &id,
                    const std::size_t n,
                    const std::string &program);
/** @} */
} // namespace mesoslip

#endif
