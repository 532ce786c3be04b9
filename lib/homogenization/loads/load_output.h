#ifndef mesoslip_homogenization_loads_load_output_h
#define mesoslip_homogenization_loads_load_output_h

#include "homogenization/rve_program.h"
#include "io/hdf5_file.h"
#include "io/json.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Begins loads.h5 at @p path for cells of that @p shape, unless no fields are asked for;
 * then the result is empty, else @p path. On rank 0. */
template <int dim>
std::string reserve_loads(const RveParameters &parameters,
                          const std::string &path,
                          const Shape &shape);

/** Bytes of the fields in loads.h5 of @p n_cells cells. */
template <int dim>
double bytes_of_loads(const RveParameters &parameters, const double n_cells);

/** Sentences on what loads leave out and on means that are far from the macroscopic state. */
template <int dim>
std::vector<std::string> load_warnings(const RveParameters &parameters,
                                       const std::vector<EnsembleMember<dim>> &members);

/** loads.h5 and loads.xdmf, loads.csv and, of several members, loads_ensemble.csv. */
template <int dim>
void write_loads(const RveParameters &parameters,
                 const RveResults<dim> &results,
                 const RunContext &context);

/** What summary.json says of the loads. */
template <int dim>
nlohmann::json loads_json(const RveParameters &parameters,
                          const RveResults<dim> &results);

/** The loads of a summary, new or restored, on the console. */
template <int dim>
void log_loads(RunContext &context);
} // namespace mesoslip

#endif
