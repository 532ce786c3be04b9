#ifndef mesoslip_exchange_datasets_h
#define mesoslip_exchange_datasets_h

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
