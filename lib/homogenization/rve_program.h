#ifndef mesoslip_homogenization_rve_program_h
#define mesoslip_homogenization_rve_program_h

#include "homogenization/ensemble.h"
#include "program/program.h"

namespace mesoslip
{
class RunContext;

/** Everything a run of rve_homogenization has found out; on rank 0. */
struct RveResults
{
  Microstructure microstructure;       ///< morphology and materials of the first member
  std::vector<EnsembleMember> members; ///< one a morphology
  /** Stiffness (Pa), mean over the members. */
  VoigtMatrix<2> effective = VoigtMatrix<2>::Zero();
};

/** rve.h5 (with the summary written before) and rve.xdmf; @p digest identifies the
 * inputs. */
void write_rve_file(const RveParameters &parameters,
                    const RveResults &results,
                    const std::string &digest,
                    RunContext &context);

/**
 * Takes over the summary of the run that wrote the rve.h5 in the output folder.
 * @return false if it holds none
 */
bool restore_rve_summary(RunContext &context);

/** The table of stiffnesses of the summary, new or restored, on the console. */
void log_stiffness(RunContext &context);

/** stiffness.csv, engineering_constants.csv, phase_means.csv, ensemble.csv,
 * rectangles.csv. */
void write_rve_tables(const RveParameters &parameters,
                      const RveResults &results,
                      const RunContext &context);

/** summary.json, and the key numbers on the console. */
void write_rve_summary(const RveParameters &parameters,
                       const RveResults &results,
                       RunContext &context);

/** The program rve_homogenization. */
Application rve_homogenization_program();
} // namespace mesoslip

#endif
