#ifndef mesoslip_homogenization_rve_program_h
#define mesoslip_homogenization_rve_program_h

#include "exchange/rve_file.h"
#include "homogenization/ensemble.h"
#include "program/program.h"

namespace mesoslip
{
class RunContext;

/** Results of a run of rve_homogenization; on rank 0. */
template <int dim>
struct RveResults
{
  /** Morphology and materials of the first member. */
  RveContent<dim> first;
  std::vector<Rectangle> rectangles; ///< rectangles of the first member, if it has any

  std::vector<EnsembleMember<dim>> members; ///< per morphology
  /** Effective stiffness (Pa), mean over the members. */
  VoigtMatrix<dim> effective = VoigtMatrix<dim>::Zero();

  /** Thermal expansion (1/K) by condition, and "effective"; empty: no phase expands. */
  std::map<std::string, VoigtVector<dim>> expansion;

  /** Conductivity by condition, and "effective", in the unit of the phases; empty: not
   * asked for. */
  std::map<std::string, Tensor2<dim>> conductivity;

  /** Number of nodes of the first member. */
  std::size_t n_nodes = 0;
};

/** Writes rve.h5 (with the summary written before) and rve.xdmf. */
template <int dim>
void write_rve_results(RveResults<dim> &results, RunContext &context);

/**
 * Restores the summary of the run that wrote the rve.h5 in the output folder.
 * @return false if the file has none
 */
bool restore_rve_summary(RunContext &context);

/** Prints the table of stiffnesses of the summary, new or restored, on the console. */
template <int dim>
void log_stiffness(RunContext &context);

/** Writes stiffness.csv, engineering_constants.csv, phase_means.csv, ensemble.csv,
 * rectangles.csv. */
template <int dim>
void write_rve_tables(const RveParameters &parameters,
                      const RveResults<dim> &results,
                      const RunContext &context);

/** Writes summary.json, and the key numbers to the console. */
template <int dim>
void write_rve_summary(const RveParameters &parameters,
                       const RveResults<dim> &results,
                       RunContext &context);

/** The program rve_homogenization. */
Application rve_homogenization_program();
} // namespace mesoslip

#endif
