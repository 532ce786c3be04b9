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
/** Format of loads.h5 and its newest version. */
inline constexpr char loads_format[]      = "mesoslip-loads";
inline constexpr int newest_loads_version = 1; ///< as written now

/** A field of the cells under a load in loads.h5. */
struct LoadField
{
  std::string name;           ///< absolute path in the file
  std::size_t components = 1; ///< numbers a cell
  std::string unit;           ///< SI symbol, "-" for pure numbers
};

/** Histograms of quantities of one unit in one phase. */
struct LoadHistograms
{
  std::string name; ///< absolute path: `_edges` and `_share` are added
  std::string unit; ///< of the edges
  std::vector<std::vector<double>> edges; ///< of each quantity
  std::vector<std::vector<double>> share; ///< of the phase's volume, one less a quantity
};

/** A load under a boundary condition in loads.h5. */
struct LoadGroup
{
  std::string name;                      ///< absolute path of the group
  std::vector<double> strain;            ///< macroscopic, engineering shear, Voigt order
  std::vector<double> stress;            ///< macroscopic (Pa)
  std::vector<LoadHistograms> histogram; ///< empty: none
};

/** What rve_homogenization leaves in loads.h5 beside the fields. */
template <int dim>
struct LoadsContent
{
  std::string digest;              ///< of the inputs that determine the content
  UniformGrid<dim> grid;           ///< of the morphology, unless it is a mesh
  const Mesh<dim> *mesh = nullptr; ///< null: it is a grid
  std::vector<Phase<dim>> phases;  ///< by index

  /** Of each cell, on a grid x fastest; empty: in the file since write_cell_planes(). */
  std::vector<std::uint8_t> phase_id;

  std::vector<LoadField> fields; ///< that are in the file since reserve_load_fields()
  std::vector<LoadGroup> groups; ///< of each load and condition

  std::vector<std::string> strains;  ///< names of the quantities that are strains
  std::vector<std::string> stresses; ///< of those that are stresses
};

/**
 * Begins loads.h5, of which @p path is the name, with room for the @p fields of cells of
 * that @p shape, which ParallelRows fills.
 */
void reserve_load_fields(const std::string &path,
                         const Shape &shape,
                         const std::vector<LoadField> &fields);

/** Completes loads.h5, of which @p path is the name, and writes `NAME.xdmf` for ParaView
 * beside it if there are fields. */
template <int dim>
void write_loads_file(const std::string &path, const LoadsContent<dim> &content);
} // namespace mesoslip

#endif
