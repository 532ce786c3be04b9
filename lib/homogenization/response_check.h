#ifndef mesoslip_homogenization_response_check_h
#define mesoslip_homogenization_response_check_h

#include "homogenization/ensemble.h"
#include "homogenization/response.h"

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * What the residuals say of a result: a sentence when fewer than five digits of the mean
 * stress (SUBC: strain) and of the concentration tensors hold, else nothing.
 * @throws NumericalFailure when not even two hold, or when the stiffness is not positive
 * definite: this is no result.
 */
std::string check_response(const HomogenizedResponse &response, const double tolerance);

/**
 * check_response() of all members, with their seeds if there are several, and what the
 * effective stiffness hides: entries D13 and D23 that orthotropy drops, KUBC and SUBC of
 * which the mean is taken although they are far apart.
 */
std::vector<std::string> result_warnings(const std::vector<EnsembleMember> &members,
                                         const RveParameters &parameters);
} // namespace mesoslip

#endif
