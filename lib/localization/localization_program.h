#ifndef mesoslip_localization_localization_program_h
#define mesoslip_localization_localization_program_h

#include "base/digest.h"
#include "localization/comparison.h"
#include "localization/localization_input.h"
#include "program/program.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
class RunContext;
class Timer;

/** A probe with its series, the direct run's series at the same times, and their
 * comparison. */
struct ProbeResult : LocalizedProbe
{
  std::vector<ComponentStatistics> statistics; ///< per component, in Voigt order
};

/** Results of one of eqs 23 and 24. */
struct VariantResult
{
  std::string name;                ///< "local strain" or "mean strain"
  StressFields fields;             ///< time averages in the cells of this rank
  StressFields difference;         ///< localized minus direct; empty without a direct run
  std::vector<FieldError> errors;  ///< against the direct run
  std::vector<ProbeResult> probes; ///< as LocalizationInput::probes, on rank 0
};

/** Fields of a volume element under the strain at a point of a larger body. */
struct PointResult
{
  std::string name;             ///< name of the point
  std::vector<double> position; ///< position in the body (m)
  StressFields fields;          ///< time averages in the volume element
};

/** Results of localize(). Each rank has the fields of its cells. */
struct LocalizationResult
{
  MPI_Comm communicator = MPI_COMM_SELF; ///< ranks that have cells
  std::size_t first_row =
    0;                      ///< first row of this rank's cells along the field's 1st axis
  FieldSelection fields;    ///< which fields exist
  bool is_compared = false; ///< whether there is a direct run
  TimeWindow window;        ///< times of the snapshots, else of the probes (s), on rank 0
  StressFields direct;      ///< empty without a direct run
  std::vector<VariantResult> variants; ///< local strain first if both are requested
  std::vector<PointResult> points;     ///< results at the requested points
};

/** Progress callbacks of localize(); functions may be empty. */
struct LocalizationMonitor
{
  /** Called when an activity with so many steps begins. */
  std::function<void(const std::string &, const std::size_t)> start;
  std::function<void(const std::size_t)> update; ///< gets steps done; may throw
  Timer *timer = nullptr;                        ///< for the profile; may be null
};

/**
 * Eqs 22 to 24 of the paper: stresses of the composite from a run of the homogenized
 * body; volume and body are grids or meshes. Each rank has a range of the cells of the
 * volume, whole rows or planes of a grid, and reads their data. Of meshes rank 0 has all
 * points and cells, and each rank reads a block of the points of the snapshots. @p plan
 * is the plan of rank 0. @p input is null except on rank 0; notes and warnings are added
 * to it. Collective.
 * @throws UserError
 */
template <int dim>
LocalizationResult localize(const LocalizationParameters &parameters,
                            const LocalizationFiles<dim> &files,
                            const LocalizationPlan<dim> &plan,
                            LocalizationInput<dim> *input,
                            const MPI_Comm ranks,
                            const LocalizationMonitor &monitor = {});

/** Facts on the input that the results state. */
struct LocalizationOrigin
{
  unsigned int dim = 2;                         ///< dimension of body and volume
  Digest digest;                                ///< digest of the input files
  std::size_t n_cells = 0;                      ///< cells of the volume
  std::size_t n_dofs  = 0;                      ///< dofs of the homogeneous run
  std::vector<std::string> phases;              ///< phase names
  double heating = 0.;                          ///< change of temperature (K)
  std::string concentration;                    ///< KUBC or PBC
  std::size_t snapshots        = 0;             ///< used snapshots of the homogeneous run
  std::size_t direct_snapshots = 0;             ///< used snapshots of the direct run
  std::vector<ConditionDifference> differences; ///< between the runs

  /** Creates localization.h5 from its path and the digest of its content. The input has
   * to exist at that time. */
  std::function<LocalizationFile(const std::string &, const std::string &)> create_file;
};

/** The origin from the input of rank 0. */
template <int dim>
LocalizationOrigin origin_of(const LocalizationInput<dim> &input);

/**
 * Writes localization.h5, localization.xdmf, probes.csv and field_errors.csv in
 * @p folder. With two variants, the mean-strain variant is under /mean_strain_variant.
 * @p parameters is the text of all parameters that determine the result, for the digest.
 * Collective over the result's communicator; ranks other than 0 need only the dimension
 * in @p origin.
 */
void write_localization(const LocalizationOrigin &origin,
                        const LocalizationResult &result,
                        const std::string &parameters,
                        const std::string &folder);

/** Adds the results to summary.json: probes, field_errors, window and the like. */
void summarize_localization(const LocalizationOrigin &origin,
                            const LocalizationResult &result,
                            nlohmann::json &summary);

/** Logs the most important errors of summary.json, in per cent. */
void log_key_numbers(RunContext &context);

/** The application stress_localization; see run_program(). */
Application stress_localization_program();
} // namespace mesoslip

#endif
