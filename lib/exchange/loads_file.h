#ifndef mesoslip_exchange_loads_file_h
#define mesoslip_exchange_loads_file_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "material/voigt.h"
#include "mesh/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** Format of loads.h5, and its newest version. */
inline constexpr char loads_format[]      = "mesoslip-loads";
inline constexpr int newest_loads_version = 1; ///< version written now

/** A cell field of a load in loads.h5. */
struct LoadField
{
  std::string name;           ///< absolute path in the file
  std::size_t components = 1; ///< numbers per cell
  std::string unit;           ///< SI symbol, "-" for pure numbers
};

/** Histograms of quantities with the same unit in one phase. */
struct LoadHistograms
{
  std::string name; ///< absolute path; suffixes `_edges` and `_share`
  std::string unit; ///< unit of the edges
  std::vector<std::vector<double>> edges; ///< bin edges of each quantity
  std::vector<std::vector<double>> share; ///< phase volume shares, one less
};

/** A load with a boundary condition in loads.h5. */
struct LoadGroup
{
  std::string name;                      ///< absolute path of the group
  std::vector<double> strain;            ///< macroscopic strain, Voigt, engineering shear
  std::vector<double> stress;            ///< macroscopic stress (Pa)
  std::vector<LoadHistograms> histogram; ///< histograms; may be empty
};

/** Content of loads.h5 apart from the fields. */
template <int dim>
struct LoadsContent
{
  std::string digest;              ///< digest of all inputs
  UniformGrid<dim> grid;           ///< grid of the morphology, unless it is a mesh
  const Mesh<dim> *mesh = nullptr; ///< mesh; null for a grid
  std::vector<Phase<dim>> phases;  ///< phases by index

  /**
   * Phase of each cell, on a grid x fastest; empty if write_cell_planes() has already
   * written it.
   */
  std::vector<std::uint8_t> phase_id;

  std::vector<LoadField> fields; ///< fields reserved by reserve_load_fields()
  std::vector<LoadGroup> groups; ///< groups of each load and condition

  std::vector<std::string> strains;  ///< names of the strain quantities
  std::vector<std::string> stresses; ///< names of the stress quantities
};

/**
 * Creates loads.h5 at @p path with space for the @p fields of cells in an array of this
 * @p shape; ParallelRows fills them.
 */
void reserve_load_fields(const std::string &path,
                         const Shape &shape,
                         const std::vector<LoadField> &fields);

/**
 * Completes loads.h5 at @p path, and writes `NAME.xdmf` for ParaView if there are fields.
 */
template <int dim>
void write_loads_file(const std::string &path, const LoadsContent<dim> &content);
} // namespace mesoslip

#endif
