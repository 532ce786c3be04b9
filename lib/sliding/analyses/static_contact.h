#ifndef mesoslip_sliding_analyses_static_contact_h
#define mesoslip_sliding_analyses_static_contact_h

#include "contact/static_contact_solver.h"
#include "sliding/analyses/phase_pressures.h"
#include "sliding/body_analysis.h"

#include <nlohmann/json_fwd.hpp>

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

  PhasePressures phases; ///< from cell_pressure
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

  void write_draft(const std::string &folder) const override;
  void run(RunContext &context) override;

private:
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
