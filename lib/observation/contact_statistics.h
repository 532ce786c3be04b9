#ifndef mesoslip_observation_contact_statistics_h
#define mesoslip_observation_contact_statistics_h

#include "contact/contact_surface.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Fractions of time of a node (or of all nodes) in each state; they sum to 1. */
struct ContactShares
{
  double slip       = 0.; ///< touching and sliding
  double stick      = 0.; ///< touching without sliding
  double separation = 0.; ///< not touching
};

/** Mean duration of uninterrupted contact of the nodes. */
struct ContactDuration
{
  /**
   * T_G of eqs. (12, 13) (s): time in contact over the number of landings (re-contact
   * events). The episodes cut by the start and by the end of the window compensate each
   * other (exactly in a window of whole periods). Without a landing: the time in contact
   * itself, a lower bound.
   */
  double mean = 0.;

  /** Fraction of the nodes that landed at least once. */
  double node_share = 0.;

  /** False: no landing in the window, #mean is only a lower bound (0: never in
   * contact). */
  bool complete() const
  {
    return node_share > 0.;
  }

  /**
   * False if fewer than half of the nodes landed: then #mean is dominated by nodes in
   * permanent contact, and grows with the window.
   */
  bool representative() const
  {
    return node_share >= 0.5;
  }
};

/** Tangential over normal forces, entry by entry; zero where the normal force is zero. */
std::vector<double> quotients(const std::vector<double> &tangential,
                              const std::vector<double> &normal);

/** Statistics of the contact in a window of time. */
struct ContactSummary
{
  std::vector<ContactShares> node_shares; ///< per node
  ContactShares shares;                   ///< mean over all nodes, with equal weights
  ContactDuration duration;               ///< over all nodes
};

/**
 * Evaluates the @p blocks (sorted by time, without gaps, steps of @p dt seconds) that
 * begin at the time @p from (s) or later, within 1e-9 of a block; if there is none, the
 * last block, so that there is always a result. Only the first @p n_nodes nodes count,
 * since the last node of a periodic grid is a copy of the first.
 */
ContactSummary summarize_contact(const std::vector<NodeCounts> &blocks,
                                 const std::size_t n_nodes,
                                 const double dt,
                                 const double from);

/** Mean load of each contact node. */
struct NodeMeans
{
  std::vector<double> pressure;       ///< Pa
  std::vector<double> friction_power; ///< dissipated (W/m^2)
};

/**
 * Means over the blocks @p first to @p last, both included, which must have loads
 * (NodeCounts::loads), for as many nodes as there are tributary areas @p area (m^2, in
 * 2D m).
 */
NodeMeans mean_loads(const std::vector<NodeCounts> &blocks,
                     const std::size_t first,
                     const std::size_t last,
                     const std::vector<double> &area,
                     const double dt);

/** Index of the first block that summarize_contact() evaluates. */
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

/** A mean over a window of time and its uncertainty by batch means. */
struct Estimate
{
  double value = 0.; ///< the mean

  /** Half width of the 95 % confidence interval (Student); 0 with fewer than two batches.
   */
  double half_width = 0.;

  /** Batches of whole periods; at most 20, so that neighbours are hardly correlated. */
  unsigned int batches = 0;

  double begin = 0.; ///< start of the evaluated time (s)
  double end   = 0.; ///< end of the evaluated time (s)
};

/** Time window of means; it ends at the last sample. */
struct MeanWindow
{
  double from   = 0.; ///< s; at least three samples must follow
  double period = 0.; ///< s; 0: none
};

/**
 * Mean power (W) of a work (J) accumulated since the start: its least-squares slope in
 * @p window. The start of the window is moved so that it contains whole periods; without
 * a period it is unchanged. The error follows from the mean powers of batches (end
 * differences, exact for a limit cycle) of ceil(periods / 20) periods each, counted
 * backwards from the end; without a period from ten equal parts. Periods at the
 * beginning that do not fill a batch enter only the value.
 */
Estimate mean_power(const std::vector<double> &time,
                    const std::vector<double> &work,
                    const MeanWindow &window);

/**
 * Global interface friction coefficient, eq. (9): mean frictional power over the mean
 * power of @p load_work, the work of the load along the way of the flat (P S |V| t if
 * all factors are constant), which must be positive. The error is the error of a ratio
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
