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
 * @name What several exchange files have in common
 * @p program wrote or writes the file, for messages.
 * @{
 */

/** Numbers that become a dataset of a file, and a column of a table. */
struct Series
{
  std::string name;                  ///< of the dataset in its group
  std::string unit;                  ///< SI symbol, "-" for pure numbers
  const std::vector<double> *values; ///< not null
  std::size_t components = 0;        ///< length of a last axis; 0: one number an entry
};

/** Writes datasets of @p group with their units, [n] or [n][components]. */
void write_series(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Series> &series);

/**
 * Writes series of single numbers as a table of about @p most_rows rows, evenly spaced, as
 * long as the shortest of them.
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

/** Extents of a dataset of one number a cell: [ny][nx] or [nz][ny][nx]. */
template <int dim>
Shape shape_of_cells(const UniformGrid<dim> &grid)
{
  return {grid.cells.rbegin(), grid.cells.rend()};
}

/**
 * Of a dataset of the cells, [nz][ny][nx] or [n], with @p n_axes axes of the values of a cell
 * behind: those of @p count cells from number @p first on. Whole rows of the first axis are
 * read. @throws UserError
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
 * Reads name, stiffness, density and, if asked for, friction_coefficient of phases.
 * @throws UserError also for values that no material has
 */
template <int dim>
std::vector<Phase<dim>> read_phases(const Hdf5File &file,
                                    const std::string &group,
                                    const bool with_friction,
                                    const std::string &program);

/** Writes name, stiffness, density and, if asked for, friction_coefficient of phases. */
template <int dim>
void write_phases(Hdf5File &file,
                  const std::string &group,
                  const std::vector<Phase<dim>> &phases,
                  const bool with_friction);

/** @throws UserError naming @p object of the file unless @p D is a stiffness. */
template <int dim>
void require_stiffness(const Hdf5File &file,
                       const std::string &object,
                       const VoigtMatrix<dim> &D,
                       const std::string &program);

/** @throws UserError unless all @p id are numbers of @p n phases. */
void require_phases(const Hdf5File &file,
                    const std::string &dataset,
                    const std::vector<std::uint8_t> &id,
                    const std::size_t n,
                    const std::string &program);
/** @} */
} // namespace mesoslip

#endif
