#ifndef mesoslip_sliding_analyses_friction_homogenization_h
#define mesoslip_sliding_analyses_friction_homogenization_h

#include "exchange/run_description.h"
#include "homogenization/homogenized_friction.h"
#include "program/program.h"
#include "sliding/contact_parameters.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** summary.json of a finished run. Errors name the key that gave the folder, and the
 * file. */
class RunSummary
{
public:
  /** @p given by @p key: "Friction homogenization/Heterogeneous run". @throws UserError */
  RunSummary(const std::string &key, const std::string &given);

  /** @throws UserError unless the run was a contact_dynamics @p analysis. */
  void require_analysis(const std::string &analysis) const;

  /** The number with this name, in the object @p of; empty if it is missing or null. */
  std::optional<double> find_number(const std::string &name,
                                    const std::string &of = "") const;

  /** A text of the file with this name; empty if there is none. */
  std::string text(const std::string &name) const;

  /** Path of another file in the folder. */
  std::string file(const std::string &name) const;

  const std::string key;    ///< key that gave the folder
  const std::string folder; ///< folder of the run

private:
  nlohmann::json json;
};

/** @p value if it is positive, else empty. */
inline std::optional<double> if_positive(const std::optional<double> &value)
{
  return value && *value > 0. ? value : std::nullopt;
}

/** Data of a transient run for eq. (13). */
struct FrictionRun
{
  std::string folder;       ///< folder with summary.json and dynamics.h5
  RunConditions conditions; ///< loads and supports from dynamics.h5
  double mu_inter = 0.;     ///< global interface friction coefficient, eq. (9)
  std::optional<double> contact_duration; ///< T_G (s); unknown without complete landings
  std::string duration_warning; ///< reason not to use T_G; empty if there is none
  std::optional<double> regularization_time;  ///< delta (s); none for plain Coulomb
  std::optional<double> friction_coefficient; ///< local mu; none if it varies by phase
};

/** Input of the homogenization of friction. */
struct FrictionHomogenizationInput
{
  FrictionRun heterogeneous;              ///< run to be matched
  std::optional<FrictionRun> homogeneous; ///< with its T_G and mu_inter, if given

  std::vector<std::string> phase_names; ///< phases on the contact line
  std::vector<ContactPhase> surface;    ///< areas are shares of the contact line
  std::vector<ContactPhase> volume;     ///< areas are volume fractions

  /** Pressures (Pa) of these phases in a static contact analysis; empty without one. */
  std::vector<double> static_pressures;

  /**
   * Eq. (17) with eq. (19) over the contact nodes of the run and their own coefficients,
   * which differ from the phases' where phases meet.
   */
  double mu_of_nodes = 0.;
  std::optional<double> static_mu_of_nodes; ///< by static contact pressures
  std::vector<std::string> warnings;        ///< sentences on the files read

  /** Eq. (17) with the phases of the contact line and the best pressures known. */
  double mu_of_phases() const
  {
    return static_pressures.empty()
             ? homogenized_friction_coefficient(surface)
             : homogenized_friction_coefficient(surface, static_pressures);
  }
};

/** An estimate of coefficient and regularization time of the homogeneous model. */
struct FrictionEstimate
{
  std::string pressures;            ///< a choice of the key Pressures from
  std::string duration;             ///< run of the T_G: "heterogeneous", "homogeneous"
  double mu_homo          = 0.;     ///< eq. (17) with these pressures
  double contact_duration = 0.;     ///< T_G (s)
  std::optional<double> delta;      ///< s, eq. (13); none unless mu_inter < mu_homo
  std::optional<double> calibrated; ///< s, eq. (13) scaled to the homogeneous run
};

/** Reads the folders of section Friction homogenization.
 * @throws UserError naming key, file and the missing data */
FrictionHomogenizationInput
read_friction_homogenization(const FrictionHomogenizationParameters &parameters);

/**
 * All estimates that the input allows: mu_homo by eqs (17) to (21), delta by inverting
 * eq. (13) for the heterogeneous run's mu_inter. The calibrated delta uses eq. (13) only
 * for the ratio of mu_inter between two deltas: starting from the homogeneous run's
 * mu_inter at its own delta, it yields the heterogeneous run's mu_inter.
 * @throws UserError if no T_G is known
 */
std::vector<FrictionEstimate>
friction_estimates(const FrictionHomogenizationInput &input);

/**
 * A warning if the coefficient of the contact nodes differs from that of the phases; ""
 * otherwise.
 */
std::string node_warning(const FrictionHomogenizationInput &input);

/** A warning if the T_G that @p chosen uses relies on few nodes; "" otherwise. */
std::string duration_warning(const FrictionHomogenizationInput &input,
                             const FrictionEstimate &chosen);

/** The estimate selected by section Friction homogenization.
 * @throws UserError */
const FrictionEstimate &
chosen_estimate(const std::vector<FrictionEstimate> &estimates,
                const FrictionHomogenizationParameters &parameters,
                const FrictionHomogenizationInput &input);

/** Analysis "friction homogenization": friction_homogenization.csv, lines for a .prm. */
class FrictionHomogenizationAnalysis : public Analysis
{
public:
  /** Rank 0 reads the folders. @throws UserError */
  explicit FrictionHomogenizationAnalysis(const ContactParameters &p);

  void run(RunContext &context) override;

private:
  const FrictionHomogenizationParameters parameters;
  FrictionHomogenizationInput input;       ///< on rank 0
  std::vector<FrictionEstimate> estimates; ///< on rank 0
};
} // namespace mesoslip

#endif
