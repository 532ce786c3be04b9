#ifndef mesoslip_sliding_analyses_static_contact_h
#define mesoslip_sliding_analyses_static_contact_h

#include "contact/static_contact_solver.h"
#include "homogenization/homogenized_friction.h"
#include "sliding/body_analysis.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <vector>

namespace mesoslip
{
/** Equilibrium of the body pressed on the flat, and what follows from it. */
struct StaticContactResult
{
  StaticContactSolution solution; ///< under the pressure of section Top

  double normal_force     = 0.; ///< on the flat (N/m)
  double tangential_force = 0.; ///< of the flat on the body (N/m)

  std::vector<double> node_pressure; ///< one value a bottom node (Pa)
  std::vector<double> node_shear;    ///< shear traction of the bottom nodes (Pa)
  std::vector<double> cell_pressure; ///< mean of -sigma_yy in the bottom cells (Pa)

  /** Share of the bottom and mean of cell_pressure by phase; none for an absent phase. */
  std::vector<double> surface_fraction;
  std::vector<std::optional<double>> phase_pressure; ///< Pa

  /** The same by the static pressure repartition, eq. (19). */
  std::vector<std::optional<double>> repartition;

  /** Relative difference between the cells' pressures and the normal force. */
  double pressure_imbalance = 0.;

  double mu_homo             = 0.; ///< of eq. (17) with the phases' pressures
  double mu_homo_repartition = 0.; ///< of eq. (17) with the pressures of eq. (19)
};

/** @throws UserError if supports and loads allow no equilibrium. */
void check_static_contact(const ContactParameters &parameters,
                          const BodyDescription &body);

/** Solves for equilibrium, with the ranks of @p communicator together if the solver is
 * ML. */
StaticContactResult compute_static_contact(const ContactParameters &parameters,
                                           const BodyDescription &body,
                                           const UniformMaterial &material,
                                           const StaticContactOptions &options,
                                           const MPI_Comm communicator = MPI_COMM_SELF);

/**
 * The phases that take part in the contact with @p fractions of it as areas, Young's moduli
 * of the closest isotropic solids, friction coefficients. Absent phases are left out.
 */
std::vector<ContactPhase> contact_phases(const std::vector<Phase<2>> &phases,
                                         const std::vector<double> &fractions);

/** Analysis "static contact": static_contact.csv, dynamics.h5 with one snapshot. */
class StaticContactAnalysis : public BodyAnalysis
{
public:
  /** @throws UserError if supports and loads allow no equilibrium. */
  explicit StaticContactAnalysis(const ContactParameters &p)
    : BodyAnalysis(p)
  {
    check_static_contact(parameters, body);
  }

  void run(RunContext &context) override;

private:
  /** What to do when no equilibrium is found. */
  std::string advice() const;

  /** @throws NumericalFailure if a cell is inside out; the largest strain into the
   * summary. */
  void judge_strain(RunContext &context) const;

  void log_result(RunContext &context) const;
  void write_table(const RunContext &context) const;
  void write_file(const RunContext &context) const;
  void write_summary(nlohmann::json &json) const;

  /** Number of distinct nodes in @p state. */
  unsigned int count(const ContactState state) const;

  StaticContactResult result;
};
} // namespace mesoslip

#endif
