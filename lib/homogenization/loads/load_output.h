#ifndef mesoslip_homogenization_loads_load_output_h
#define mesoslip_homogenization_loads_load_output_h

#include "homogenization/rve_program.h"
#include "io/hdf5_file.h"
#include "io/json.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Creates loads.h5 at @p path for cells of @p shape and returns @p path; returns an
 * empty name if no fields are asked for. On rank 0. */
template <int dim>
std::string reserve_loads(const RveParameters &parameters,
                          const std::string &path,
                          const Shape &shape);

/** Size of the fields in loads.h5 for @p n_cells cells (bytes). */
template <int dim>
double bytes_of_loads(const RveParameters &parameters, const double n_cells);

/** Warnings on results that loads leave out and on means far from the macroscopic
 * state. */
template <int dim>
std::vector<std::string> load_warnings(const RveParameters &parameters,
                                       const std::vector<EnsembleMember<dim>> &members);

/** Writes loads.h5 and loads.xdmf, loads.csv and, with several members,
 * loads_ensemble.csv. */
template <int dim>
void write_loads(const RveParameters &parameters,
                 const RveResults<dim> &results,
                 const RunContext &context);

/** The loads in summary.json. */
template <int dim>
nlohmann::json loads_json(const RveParameters &parameters,
                          const RveResults<dim> &results);

/** Prints the loads of a summary, new or restored, on the console. */
template <int dim>
void log_loads(RunContext &context);
} // namespace mesoslip

#endif
