#ifndef mesoslip_sliding_complex_mode_branches_h
#define mesoslip_sliding_complex_mode_branches_h

#include "sliding/complex/complex_cases.h"

#include <vector>

namespace mesoslip
{
/**
 * Follows modes through a sweep: for each case the number of the curve that each mode belongs to,
 * from 1. From one case to the next those pairs go together whose shapes are most
 * alike, |u^H M u'|^2 / (u^H M u  u'^H M u'), as long as that is at least 0.5; a mode
 * without partner begins a curve.
 */
std::vector<std::vector<unsigned int>>
mode_branches(const std::vector<ComplexCase> &cases);
} // namespace mesoslip

#endif
