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
/** Format of dynamics.h5 of a body on a grid; a body on a mesh has the suffix "-mesh". */
inline constexpr char dynamics_format[] = "mesoslip-dynamics";

/** Dataset of the cell phases in files of contact_dynamics. */
inline constexpr char body_phases_dataset[] = "/material/phase_id";

/**
 * Checks the header of dynamics.h5 of a body in @p dim dimensions (0: any), and returns
 * its digest. @throws UserError for another format or a newer version
 */
std::string check_dynamics_header(const Hdf5File &file, const unsigned int dim);

/** Digest of the RVE file of the body's stiffness; empty without RVE. */
std::string body_rve_digest(const Hdf5File &file);

/** Shape of a nodal displacement: [ny + 1][nx + 1][2]. */
Shape nodes_shape(const UniformGrid<2> &grid);

/**
 * Writes `NAME.xdmf` for the nodal @p series of the file at @p path and, if it
 * @p has_phases, `NAME-phases.xdmf` for the cell phases. ParaView cannot read vectors and
 * cell data from one plane grid.
 */
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

/**
 * Creates dynamics.h5 or another file of contact_dynamics on a plane grid, with this
 * @p format: header, /grid and /material.
 */
Hdf5File create_grid_file(const std::string &path,
                          const BodyDescription &body,
                          const std::string &format = dynamics_format);
} // namespace mesoslip

#endif
