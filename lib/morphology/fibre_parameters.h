#ifndef mesoslip_morphology_fibre_parameters_h
#define mesoslip_morphology_fibre_parameters_h

#include <string>

namespace mesoslip
{
class Keys;
struct MicrostructureParameters;

/** Binds the subsection `Random fibres` of the current section. */
void bind_fibres(Keys &keys, MicrostructureParameters &parameters);

/** @throws UserError if random fibres do not fit the cells or the box, or lack a
 * phase. */
void check_fibres(const MicrostructureParameters &parameters);

/** @throws UserError for the key Phase of @p section if fibres or inclusions would
 * consist of the first phase. */
void check_fibre_phase(const MicrostructureParameters &parameters,
                       const std::string &section);
} // namespace mesoslip

#endif
