#ifndef mesoslip_localization_localization_program_h
#define mesoslip_localization_localization_program_h

#include "localization/localize.h"
#include "program/program.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mesoslip
{
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
