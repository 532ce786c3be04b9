#ifndef mesoslip_observation_contact_statistics_h
#define mesoslip_observation_contact_statistics_h

#include "contact/contact_surface.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Fractions of time of a node (or of all) in each state; they sum to 1. */
struct ContactShares
{
  double slip       = 0.; ///< touching and sliding
  double stick      = 0.; ///< touching without sliding
  double separation = 0.; ///< not touching
};

/** How long the nodes stay in contact at a stretch. */
struct ContactDuration
{
  /**
   * T_G of eqs. (12, 13) (s): time in contact over the number of landings (re-contact
   * events). The episode cut by the start of the window and the one cut by its end make up
   * for each other (exactly so in a window of whole periods). Without a landing: the time
   * in contact itself, a lower bound.
   */
  double mean = 0.;

  /** Fraction of the nodes that landed at least once. */
  double node_share = 0.;

  /** False: no landing in the window, #mean is only a lower bound (0: never in contact).
   */
  bool complete() const
  {
    return node_share > 0.;
  }

  /**
   * False when fewer than half of the nodes landed: then #mean is mostly the time that
   * the others have been in contact without an end, and grows with the window.
   */
  bool representative() const
  {
    return node_share >= 0.5;
  }
};

/** Tangential over normal forces, entry by entry; zero where there is no normal force. */
std::vector<double> quotients(const std::vector<double> &tangential,
                              const std::vector<double> &normal);

/** Statistics of the contact in a window of time. */
struct ContactSummary
{
  std::vector<ContactShares> node_shares; ///< one entry a node
  ContactShares shares;                   ///< of all nodes, each of the same weight
  ContactDuration duration;               ///< of all nodes
};

/**
 * Evaluates the @p blocks (in the order of time, without gaps, steps of @p dt seconds) that
 * begin at the time @p from (s) or later, within 1e-9 of a block; if none does, the last
 * one, so that there always is an answer. The first @p n_nodes nodes count: with periodic
 * sides the last one is the first one again.
 */
ContactSummary summarize_contact(const std::vector<NodeCounts> &blocks,
                                 const std::size_t n_nodes,
                                 const double dt,
                                 const double from);

/** Means of what each contact node takes of the load. */
struct NodeMeans
{
  std::vector<double> pressure;       ///< Pa
  std::vector<double> friction_power; ///< dissipated (W/m^2)
};

/**
 * Means over the blocks number @p first to @p last, both included, which have loads (
 * NodeCounts::loads); of as many nodes as there are tributary areas @p area (m^2, in 2D m).
 */
NodeMeans mean_loads(const std::vector<NodeCounts> &blocks,
                     const std::size_t first,
                     const std::size_t last,
                     const std::vector<double> &area,
                     const double dt);

/** Number of the first block of those that summarize_contact() evaluates. */
std::size_t
first_block(const std::vector<NodeCounts> &blocks, const double dt, const double from);

/**
 * Name of the instability type (paper, section 2.4; Linck et al. 2003) from the shares of
 * the reference node. A state that takes less than 1 % of the time does not count:
 *
 *     slip                          permanent slip
 *     stick                         permanent stick
 *     separation                    permanent separation
 *     slip + stick                  stick-slip
 *     slip + separation             slip-separation, regime 1 (mostly slipping) if
 *                                   slip >= separation, else regime 2 (mostly separated)
 *     stick + separation            stick-separation
 *     all three                     stick-slip-separation
 */
std::string regime_label(const ContactShares &shares);

/** A mean over a window of time and how far it may be trusted, by batch means. */
struct Estimate
{
  double value = 0.; ///< the mean

  /** Half width of the 95 % confidence interval (Student); 0 with fewer than two batches.
   */
  double half_width = 0.;

  /** Batches of whole periods; at most 20, so that neighbours are hardly correlated. */
  unsigned int batches = 0;

  double begin = 0.; ///< first time that counts (s)
  double end   = 0.; ///< last time that counts (s)
};

/** Part of the time over which means are taken: to the last sample. */
struct MeanWindow
{
  double from   = 0.; ///< s; three samples at least are not before it
  double period = 0.; ///< s; 0: none
};

/**
 * Mean power (W) of a work (J) that is known since the start: its least-squares slope in
 * @p window. The window is shortened at its beginning to whole periods, all of which
 * count; without a period it is left as it is. The error follows from the mean powers of
 * batches (end differences, exact for a limit cycle) of ceil(periods / 20) periods each,
 * counted backwards from the end; without a period of ten equal parts. Periods at the
 * beginning that do not fill a batch count for the value only.
 */
Estimate mean_power(const std::vector<double> &time,
                    const std::vector<double> &work,
                    const MeanWindow &window);

/**
 * Global interface friction coefficient, eq. (9): mean power of the frictional energy
 * over that of the work @p load_work of the load along the way of the flat (P S |V| t
 * while all of them are constant), which must be positive. Its error is that of a ratio
 * of means.
 */
Estimate interface_friction_coefficient(const std::vector<double> &time,
                                        const std::vector<double> &friction_energy,
                                        const std::vector<double> &load_work,
                                        const MeanWindow &window);

/**
 * Mean of uniformly sampled @p values over whole periods of the same window, for instance
 * of the apparent friction coefficient mu_app(t) (paper, remark 1).
 */
Estimate window_mean(const std::vector<double> &time,
                     const std::vector<double> &values,
                     const MeanWindow &window);
} // namespace mesoslip

#endif
