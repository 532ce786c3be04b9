#ifndef mesoslip_exchange_grid_file_h
#define mesoslip_exchange_grid_file_h

#include "exchange/run_description.h"
#include "exchange/xdmf.h"
#include "grid/nodal_field.h"
#include "io/hdf5_file.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Extents of a displacement of the nodes: [ny + 1][nx + 1][2]. */
Shape nodes_shape(const UniformGrid<2> &grid);

/** Shows @p series of nodes of the file at @p path in `NAME.xdmf`, and if it @p has_phases those of the cells in
 * `NAME-phases.xdmf`, as ParaView cannot read vectors and cell data from one plane grid. */
void show_grid(const std::string &path,
               const UniformGrid<2> &grid,
               const bool has_phases,
               const std::vector<XdmfField> &series,
               const std::vector<double> &times);

/** Values [rows][columns][components] of rows @p begin to @p end of a nodal field. */
std::vector<double> interleaved(const NodalField<double> &u,
                                const unsigned int begin,
                                const unsigned int end);

/** Values [rows][columns][components] of all rows of a nodal field. */
inline std::vector<double> interleaved(const NodalField<double> &u)
{
  return interleaved(u, 0, u.n_rows());
}

/** Begins dynamics.h5 or another file of contact_dynamics on a plane grid, of that @p format: header, /grid and
 * /material. */
Hdf5File create_grid_file(const std::string &path,
                          const BodyDescription &body,
                          const std::string &format = "mesoslip-dynamics");
} // namespace mesoslip

#endif
