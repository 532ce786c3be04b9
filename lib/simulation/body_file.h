#ifndef mesoslip_simulation_body_file_h
#define mesoslip_simulation_body_file_h

#include "grid/nodal_field.h"
#include "io/hdf5_file.h"
#include "simulation/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** A new file with header, /grid and /material of the body. */
Hdf5File
create_body_file(const std::string &path, const std::string &format, const Scene &scene);

/** Values [ny + 1][nx + 1][2] of a nodal field. */
std::vector<double> interleaved(const NodalField<double> &u);

/** Empty /snapshots/time [0] and /snapshots/displacement [0][ny + 1][nx + 1][2]. */
void create_snapshots(Hdf5File &file, const UniformGrid<2> &grid);

/** Appends the displacement @p u (m) at time @p time (s). */
void append_snapshot(Hdf5File &file, const double time, const NodalField<double> &u);

/**
 * Shows vector series [k][ny + 1][nx + 1][2] of the file @p h5 beside the XDMF file @p
 * path
 * (`NAME.xdmf`), and the phases of a heterogeneous body in `NAME-phases.xdmf`, as
 * ParaView cannot read vectors and cell data from one plane grid. @p series: names in
 * ParaView and datasets.
 */
void write_body_xdmf(const std::string &path,
                     const Scene &scene,
                     const std::string &h5,
                     const std::vector<std::pair<std::string, std::string>> &series,
                     const std::vector<double> &times);
} // namespace mesoslip

#endif
