#ifndef mesoslip_observation_contact_shares_h
#define mesoslip_observation_contact_shares_h

#include "observation/friction_summary.h"

#include <vector>

namespace mesoslip
{
/**
 * Steps that each contact node spent in contact during a block of steps, as the contact
 * kernel counts them. All arrays have one entry a node; what is neither stick nor slip
 * is separation.
 */
struct ContactBlock
{
  /** s; the block covers the steps whose ends lie in (begin, end]. */
  double begin = 0.;
  double end   = 0.; ///< end of the block (s)

  /** Steps of the block. */
  double steps = 0.;

  /** Steps that stuck and that slipped. */
  std::vector<double> stick;
  std::vector<double> slip; ///< steps that slipped

  /** Steps at which the node came back from separation. */
  std::vector<double> landings;
};

/** Time in contact and how long it lasts at a stretch. */
struct ContactDuration
{
  /**
   * s; T_G of eqs. (12, 13): contact time / landings. The episode cut by the start of the
   * window and the one cut by its end make up for each other (exactly so in a window of
   * whole periods). Without a landing: the contact time itself, a lower bound.
   */
  double mean = 0.;

  /** Landings in the window. */
  double episodes = 0.;

  /** Share of the nodes that landed at least once. */
  double node_share = 0.;

  /** False: no landing in the window, #mean is only a lower bound (0: never in contact).
   */
  bool complete() const
  {
    return episodes > 0.;
  }

  /**
   * False when fewer than half of the nodes landed: then #mean is mostly the time that
   * the others have been in contact without an end, and grows with the window.
   */
  bool representative() const
  {
    return complete() && node_share >= 0.5;
  }
};

/** Statistics of the contact in a window of time. */
struct ContactSummary
{
  /** s; the window really used: the union of the blocks inside. */
  double begin = 0.;
  double end   = 0.; ///< end of the window (s)

  /** One entry a node. */
  std::vector<ContactShares> node_shares;
  std::vector<ContactDuration> node_durations; ///< one entry a node

  /** All nodes together (each of the same weight; add weights for tributary lengths). */
  ContactShares shares;
  ContactDuration duration; ///< T_G of eq. (13), of all landings
};

/**
 * Evaluate the blocks that lie in [@p from, @p to] (within 1e-9 of a block); if none
 * does, the last block is taken, so that there always is an answer.
 *
 * @param blocks  in the order of time, without gaps
 * @param from,to  s
 * @param weights  one per node for the overall shares, such as tributary lengths; empty:
 * equal
 * @throws std::invalid_argument without blocks or with arrays of different lengths
 */
ContactSummary summarize_contact(const std::vector<ContactBlock> &blocks,
                                 double from,
                                 double to,
                                 const std::vector<double> &weights = {});

/** Node whose position is nearest to @p x, for the reference node. */
unsigned int nearest_node(const std::vector<double> &positions, double x);
} // namespace mesoslip

#endif
