#ifndef mesoslip_sliding_analyses_static_contact_h
#define mesoslip_sliding_analyses_static_contact_h

#include "contact/static_contact_solver.h"
#include "sliding/analyses/phase_pressures.h"
#include "sliding/analyses/static_load.h"
#include "sliding/body_analysis.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mesoslip
{
/** Equilibrium of the body pressed on the flat, with derived results; nodes in the order
 * of ElasticBody::surface(). */
template <int dim>
struct StaticContactResult
{
  StaticContactSolution solution;    ///< solution under the pressure of Supports/Top
  std::vector<StaticLoadStep> steps; ///< per load increment

  double normal_force = 0.; ///< on the flat (N, in 2D N/m)
  std::array<double, dim - 1>
    tangential_force; ///< friction force of the flat on the body (N, in 2D N/m)

  std::vector<double> node_pressure; ///< contact pressure per contact node (Pa)
  std::array<std::vector<double>, dim - 1>
    node_shear; ///< shear traction on the body (Pa)

  std::vector<double> cell_pressure; ///< per ContactCell, on rank 0 (Pa)
  PhasePressures phases;             ///< derived from cell_pressure, on rank 0
};

/** Computes the equilibrium of a body after make_elastic(). Collective.
 * @throws NotConverged */
template <int dim>
StaticContactResult<dim> compute_static_contact(const GivenBody<dim> &body,
                                                const StaticContactOptions &options);

/** Analysis "static contact": static_contact.csv, load_steps.csv, dynamics.h5 with one snapshot. */
template <int dim>
class StaticContactAnalysis : public BodyAnalysis<dim>
{
public:
  /** @throws UserError if supports and loads allow no equilibrium. */
  explicit StaticContactAnalysis(std::unique_ptr<GivenBody<dim>> given);

  void write_draft(const std::string &folder) const override;
  void run(RunContext &context) override;

private:
  using BodyAnalysis<dim>::body;
  using BodyAnalysis<dim>::facts;
  using BodyAnalysis<dim>::parameters;

  std::optional<double> sliding_friction() const;
  void log_result(RunContext &context) const;
  void write_contact_table(const RunContext &context,
                           const std::vector<double> &displaced) const;
  void write_step_table(const RunContext &context) const;
  void write_static_file(const RunContext &context) const;
  void write_contact_group(Hdf5File &file) const;
  void summarize(RunContext &context) const;

  /** Number of contact nodes in @p state; periodic copies are not counted. */
  std::size_t count(const ContactState state) const;

  StaticContactResult<dim> result;
};
} // namespace mesoslip

#endif
