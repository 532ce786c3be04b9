#ifndef mesoslip_sliding_body_file_h
#define mesoslip_sliding_body_file_h

#include "grid/nodal_field.h"
#include "io/hdf5_file.h"
#include "sliding/scene.h"

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

/** Of @p n displacement fields in a file: [n][ny + 1][nx + 1][2]. */
Shape snapshot_shape(const UniformGrid<2> &grid, const std::size_t n);

/** Completes /snapshots beside its displacement: /snapshots/time (s) [n] and the units.
 */
void complete_snapshots(Hdf5File &file, const std::vector<double> &times);

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
