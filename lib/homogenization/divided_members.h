#ifndef mesoslip_homogenization_divided_members_h
#define mesoslip_homogenization_divided_members_h

#include "homogenization/flat_volume.h"
#include "homogenization/rve_program.h"
#include "homogenization/voxel_volume.h"

#include <optional>
#include <string>

namespace mesoslip
{
/** Bytes that load cases on a plane grid need of all ranks together when these divide its
 *  rows among themselves. */
double bytes_of_divided(const RveParameters &parameters);

/** Solves all load cases of all members on a plane grid, of which each rank has rows; one
 *  member after the other. Collective; results are those of rank 0. @throws NotConverged */
RveResults<2> compute_divided_members(const RveParameters &parameters,
                                      RunContext &context);

/** Of the results @p results what follows from the morphology of the first member. */
void set_first(RveResults<2> &results, const Microstructure &microstructure);

/** Makes room in rve.h5 for what the cells of @p grid are made of and for their concentration
 *  tensors, if they are wanted, and in loads.h5; returns where the fields of loads go (empty:
 *  nowhere). Collective. */
template <int dim>
std::string reserve_fields(const RveParameters &parameters,
                           const UniformGrid<dim> &grid,
                           RveContent<dim> &content,
                           const RunContext &context);

/** All ranks write the phases of their cells, and which of the oriented materials they are if there
 *  are @p orientations, into that room. Collective. */
void write_cells(const RveParameters &parameters,
                 const CellPlanes &phases,
                 const std::optional<CellPlanes> &orientations,
                 const RunContext &context);

/** All ranks write the concentration tensors that they have, plane by plane, for the
 *  condition that @p volume has solved last. Collective. */
template <typename Volume>
void write_concentration(const Volume &volume,
                         const BoundaryCondition condition,
                         const RunContext &context);
} // namespace mesoslip

#endif
