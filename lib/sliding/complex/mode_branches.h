#ifndef mesoslip_sliding_complex_mode_branches_h
#define mesoslip_sliding_complex_mode_branches_h

#include "sliding/complex/complex_cases.h"

#include <vector>

namespace mesoslip
{
/**
 * Follows modes through a sweep: for each case the curve number of each mode, from 1.
 * Between consecutive cases modes are paired by the largest |u^H M u'|^2 / (u^H M u u'^H
 * M u'), if it is at least 0.5; a mode without partner begins a curve.
 */
std::vector<std::vector<unsigned int>>
mode_branches(const std::vector<ComplexCase> &cases);
} // namespace mesoslip

#endif
