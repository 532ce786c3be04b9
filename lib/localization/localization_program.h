#ifndef mesoslip_localization_localization_program_h
#define mesoslip_localization_localization_program_h

#include "localization/comparison.h"
#include "localization/localization_input.h"
#include "program/program.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/** A probe with its series, those of the direct run at the same times, and their comparison. */
struct ProbeResult : LocalizedProbe
{
  std::array<ComponentStatistics, 3> statistics; ///< of xx, yy, xy
};

/** All that follows from one of eqs 23 and 24. */
struct VariantResult
{
  std::string name;                ///< "local strain" or "mean strain"
  StressFields fields;             ///< averages over time
  StressFields difference;         ///< localized minus direct; empty without a direct run
  std::vector<FieldError> errors;  ///< against the direct run
  std::vector<ProbeResult> probes; ///< as LocalizationInput::probes
};

/** Everything that localize() found. */
struct LocalizationResult
{
  TimeWindow window;                   ///< first and last time used (s)
  StressFields direct;                 ///< empty without a direct run
  std::vector<VariantResult> variants; ///< local strain first when both were asked for
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
 * body. Works on one process; adds to the notes and warnings of @p input and takes its
 * concentration tensors. @throws UserError.
 */
LocalizationResult localize(LocalizationInput &input,
                            const LocalizationMonitor &monitor = {});

/**
 * localization.h5, localization.xdmf, probes.csv and field_errors.csv in @p folder. With
 * two variants, that of the mean strain is under /mean_strain_variant. @p parameters is
 * the text of what determines the result besides the files, for the digest.
 */
void write_localization(const LocalizationInput &input,
                        const LocalizationResult &result,
                        const std::string &parameters,
                        const std::string &folder);

/** The keys of summary.json: probes, field_errors, window and the like. */
void summarize_localization(const LocalizationInput &input,
                            const LocalizationResult &result,
                            nlohmann::json &summary);

/** The application stress_localization; see run_program(). */
Application stress_localization_program();
} // namespace mesoslip

#endif
