#ifndef mesoslip_exchange_xdmf_h
#define mesoslip_exchange_xdmf_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A dataset of an exchange file, as shown in ParaView. */
struct XdmfField
{
  /** Kind of values; x is the fastest axis of the grid. */
  enum class Values
  {
    nodes, ///< nodal values; the first axis is time
    cells, ///< cell values
    phases ///< phase indices of cells
  };

  std::string name;              ///< name in ParaView
  std::string dataset;           ///< absolute path in the HDF5 file
  Values values = Values::nodes; ///< kind of values

  /**
   * Shape of the axes after those of the grid: none for a scalar, the dimension for a
   * vector, the number of Voigt components for a tensor, twice that for a matrix.
   * Components and entries are shown separately: "stress_xx", "tensor_xx_yy".
   */
  Shape components = {};
};

/**
 * Writes an XDMF file for the datasets @p fields of the HDF5 file @p file in the same
 * folder. Open it in ParaView with the "XDMF Reader", not the "Xdmf3 Reader". ParaView
 * cannot show nodal and cell data on one plane grid: write two files. A plane grid with
 * cell data is shown as a slab one cell thick. @p times belong to nodal data.
 */
template <int dim>
void write_xdmf(const std::string &path,
                const std::string &file,
                const UniformGrid<dim> &grid,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times = {});

/**
 * Writes an XDMF file for datasets on a mesh that write_mesh() has written to the HDF5
 * file.
 */
template <int dim>
void write_xdmf(const std::string &path,
                const std::string &file,
                const Mesh<dim> &mesh,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times = {});

/**
 * Writes NAME.xdmf with @p fields, and NAME-phases.xdmf with the datasets @p cells, for
 * the HDF5 file NAME.h5 at @p path. An empty list writes no file.
 */
template <class GridOrMesh>
void show_file(const std::string &path,
               const GridOrMesh &shape,
               const std::vector<XdmfField> &fields,
               const std::vector<double> &times,
               const std::vector<XdmfField> &cells)
{
  const std::string file   = path.substr(path.rfind('/') + 1),
                    prefix = path.substr(0, path.rfind('.'));
  if (!fields.empty())
    write_xdmf(prefix + ".xdmf", file, shape, fields, times);
  if (!cells.empty())
    write_xdmf(prefix + "-phases.xdmf", file, shape, cells);
}
} // namespace mesoslip

#endif
