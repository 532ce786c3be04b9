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
/** Format of dynamics.h5 of a body on a grid; on a mesh "-mesh" is behind it. */
inline constexpr char dynamics_format[] = "mesoslip-dynamics";

/** Dataset of the phases of the cells in files of contact_dynamics. */
inline constexpr char body_phases_dataset[] = "/material/phase_id";

/** The digest that dynamics.h5 of a body in @p dim dimensions (0: of any) states. @throws UserError if it is
 * none, or of a later version */
std::string check_dynamics_header(const Hdf5File &file, const unsigned int dim);

/** The digest of the RVE file that the body's stiffness is from; empty without one. */
std::string body_rve_digest(const Hdf5File &file);

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
                          const std::string &format = dynamics_format);
} // namespace mesoslip

#endif
