#ifndef mesoslip_morphology_statistics_h
#define mesoslip_morphology_statistics_h

#include "grid/phase_map.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What one phase occupies. */
struct PhaseStatistics
{
  std::size_t n_cells  = 0;  ///< of this phase
  double area_fraction = 0.; ///< of the box

  /** Connected regions (cells that share an edge): fibres, as long as they do not touch.
   */
  std::size_t n_regions = 0;

  /** Mean length (m) of the runs of this phase along x and y; 0 for an absent phase. */
  double mean_chord_x = 0.;
  double mean_chord_y = 0.; ///< along y
};

/** Statistics of phases 0 to @p n_phases - 1. */
std::vector<PhaseStatistics> phase_statistics(const PhaseMap<2> &map,
                                              const unsigned int n_phases);

/** Area fractions of phases 0 to @p n_phases - 1; they sum to one. */
std::vector<double> area_fractions(const PhaseMap<2> &map, const unsigned int n_phases);

/**
 * Probability that two points @p lag cells apart along @p direction (0: x, 1: y) both lie
 * in @p phase, for lags 0 to @p max_lag, over all pairs inside the box.
 */
std::vector<double> two_point_probability(const PhaseMap<2> &map,
                                          const std::uint8_t phase,
                                          const unsigned int direction,
                                          const unsigned int max_lag);

/** 64-bit FNV-1a of the numbers of cells and the phase indices. */
std::uint64_t morphology_digest(const PhaseMap<2> &map);
} // namespace mesoslip

#endif
