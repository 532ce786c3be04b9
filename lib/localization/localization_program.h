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

/** A probe with its series, those of the direct run at the same times, and their comparison. */
struct ProbeResult : LocalizedProbe
{
  std::vector<ComponentStatistics> statistics; ///< of the components in Voigt order
};

/** All that follows from one of eqs 23 and 24. */
struct VariantResult
{
  std::string name;                ///< "local strain" or "mean strain"
  StressFields fields;             ///< averages over time in the cells of this rank
  StressFields difference;         ///< localized minus direct; empty without a direct run
  std::vector<FieldError> errors;  ///< against the direct run
  std::vector<ProbeResult> probes; ///< as LocalizationInput::probes, on rank 0
};

/** What the strain at a point of a body makes of a volume element that is smaller. */
struct PointResult
{
  std::string name;             ///< of the point
  std::vector<double> position; ///< in the body (m)
  StressFields fields;          ///< averages over time in the volume element
};

/** Everything that localize() found. Of the fields each rank has those of its cells. */
struct LocalizationResult
{
  MPI_Comm communicator = MPI_COMM_SELF; ///< of the ranks that have cells
  std::size_t first_row =
    0;                      ///< of the cells of this rank, along the first axis of fields
  FieldSelection fields;    ///< those that there are
  bool is_compared = false; ///< whether there is a direct run
  TimeWindow window;        ///< of the snapshots, else of the probes (s), on rank 0
  StressFields direct;      ///< empty without a direct run
  std::vector<VariantResult> variants; ///< local strain first when both were asked for
  std::vector<PointResult> points;     ///< those asked for
};

/** Whom localize() tells what it does; functions may be empty. */
struct LocalizationMonitor
{
  /** Begin of an activity with so many steps. */
  std::function<void(const std::string &, const std::size_t)> start;
  std::function<void(const std::size_t)> update; ///< steps done; may throw to stop
  Timer *timer = nullptr;                        ///< for the profile; may be null
};

/**
 * Eqs 22 to 24 of the paper: the stresses of the composite from a run of the homogenized
 * body, volume and body being grids or meshes. Each rank has some of the cells of the volume, whole
 * rows or planes of a grid, and reads what belongs to them. Of grids no rank has more, of meshes rank 0 has
 * all points and cells, and each rank reads a block of the points of the snapshots. @p plan is that of rank 0,
 * which alone has the @p input, to whose notes and warnings it adds; elsewhere null. Collective. @throws
 * UserError
 */
template <int dim>
LocalizationResult localize(const LocalizationParameters &parameters,
                            const LocalizationFiles<dim> &files,
                            const LocalizationPlan<dim> &plan,
                            LocalizationInput<dim> *input,
                            const MPI_Comm ranks,
                            const LocalizationMonitor &monitor = {});

/** What the results say of the input. */
struct LocalizationOrigin
{
  unsigned int dim = 2;                         ///< of body and volume
  Digest digest;                                ///< of the input files
  std::size_t n_cells = 0;                      ///< of the volume
  std::size_t n_dofs  = 0;                      ///< of the homogeneous run
  std::vector<std::string> phases;              ///< their names
  double heating = 0.;                          ///< change of temperature (K)
  std::string concentration;                    ///< KUBC or PBC
  std::size_t snapshots        = 0;             ///< of the homogeneous run, used
  std::size_t direct_snapshots = 0;             ///< of the direct run, used
  std::vector<ConditionDifference> differences; ///< of the runs

  /** Begins localization.h5, from its path and the digest of its content. The input has to be
   * there. */
  std::function<LocalizationFile(const std::string &, const std::string &)> create_file;
};

/** Of what rank 0 has. */
template <int dim>
LocalizationOrigin origin_of(const LocalizationInput<dim> &input);

/**
 * localization.h5, localization.xdmf, probes.csv and field_errors.csv in @p folder. With
 * two variants, that of the mean strain is under /mean_strain_variant. @p parameters is
 * the text of what determines the result besides the files, for the digest. Collective over
 * the result's communicator; of the @p origin ranks other than 0 need the dimension alone.
 */
void write_localization(const LocalizationOrigin &origin,
                        const LocalizationResult &result,
                        const std::string &parameters,
                        const std::string &folder);

/** The keys of summary.json: probes, field_errors, window and the like. */
void summarize_localization(const LocalizationOrigin &origin,
                            const LocalizationResult &result,
                            nlohmann::json &summary);

/** Logs the errors in summary.json that a user looks for first, in per cent. */
void log_key_numbers(RunContext &context);

/** The application stress_localization; see run_program(). */
Application stress_localization_program();
} // namespace mesoslip

#endif
