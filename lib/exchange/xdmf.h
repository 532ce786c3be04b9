#ifndef mesoslip_exchange_xdmf_h
#define mesoslip_exchange_xdmf_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A dataset of an exchange file as ParaView shows it. */
struct XdmfField
{
  /** What the dataset holds; x is the fastest of the axes of the grid. */
  enum class Values
  {
    nodes, ///< numbers of nodes; the first axis counts the times
    cells, ///< numbers of cells
    phases ///< phase numbers of cells
  };

  std::string name;              ///< in ParaView
  std::string dataset;           ///< absolute path in the HDF5 file
  Values values = Values::nodes; ///< what the dataset holds

  /**
   * Extents of the axes behind those of the grid: none for a number, the dimension for a
   * vector, the number of Voigt components for a tensor, twice that for a matrix of them.
   * Components and entries are shown one by one: "stress_xx", "tensor_xx_yy".
   */
  Shape components = {};
};

/**
 * Writes a file that ParaView opens (with its "XDMF Reader", not "Xdmf3 Reader") for the
 * datasets @p fields of the HDF5 file of the name @p file beside it. ParaView cannot show
 * data of nodes and of cells on one plane grid: for both write two files. A plane grid with
 * data of cells is shown as a slab one cell thick. @p times are those of data of nodes.
 */
template <int dim>
void write_xdmf(const std::string &path,
                const std::string &file,
                const UniformGrid<dim> &grid,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times = {});

/** The same for datasets on a mesh that write_mesh() has written into the HDF5 file. */
template <int dim>
void write_xdmf(const std::string &path,
                const std::string &file,
                const Mesh<dim> &mesh,
                const std::vector<XdmfField> &fields,
                const std::vector<double> &times = {});

/** Writes NAME.xdmf with @p fields and NAME-phases.xdmf with what the @p cells have, of the HDF5 file NAME.h5
 * at @p path; none of either, no file. */
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
