#ifndef mesoslip_simulation_contact_parameters_h
#define mesoslip_simulation_contact_parameters_h

#include "contact/contact_row.h"
#include "contact/friction_law.h"
#include "contact/load_history.h"
#include "dynamics/top_row.h"
#include "elasticity/explicit_stepper.h"
#include "elasticity/static_solver.h"
#include "simulation/transient_checkpoint.h"

#include <array>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
class RawParameters;

/** What contact_dynamics computes. */
enum class ContactAnalysis
{
  transient,
  modal,
  static_contact,
  friction_homogenization
};

/** Section Body: geometry and material. */
struct BodyParameters
{
  bool                        heterogeneous = false;
  std::string                 rve_file;       ///< empty: typed in
  std::string                 stiffness_name; ///< dataset of /stiffness
  std::vector<double>         stiffness;      ///< 4 or 6 coefficients (Pa)
  double                      density = 0.;   ///< kg/m^3
  std::array<double, 2>       size    = {};   ///< m; 0: as the RVE
  std::array<unsigned int, 2> cells   = {};   ///< 0: as the RVE
  std::array<double, 2>       initial_velocity = {}; ///< m/s
  std::array<double, 2>       acceleration     = {}; ///< m/s^2
};

/** Section Time. */
struct TimeParameters
{
  double end_time   = 0.; ///< s
  double time_step  = 0.; ///< s; NaN: automatic
  double safety     = 0.; ///< share of the critical time step
  double beta2      = 0.;
  double beta       = 0.; ///< s
  bool   check_time_step = true;
};

/** Sections Flat and Friction. */
struct FrictionParameters
{
  LoadHistory flat_velocity; ///< m/s
  double      gap = 0.;      ///< m
  FrictionLaw law;
  bool        coefficient_by_phase = false;
  double      coefficient          = 0.;
  std::string node_rule; ///< stiffness, mean, largest or smallest of the adjacent cells
};

/** A point that is watched. */
struct ProbeParameters
{
  std::string           name;
  std::array<double, 2> position = {}; ///< m
  bool                  nearest_node = false;
};

/** Sections Observation and Snapshots. */
struct ObservationParameters
{
  unsigned int                 history_interval = 0; ///< steps
  unsigned int                 energy_interval  = 0; ///< steps; 0: none
  unsigned int                 blocks           = 0;
  double                       steady_from      = 0.; ///< s; NaN: automatic
  double                       reference_x      = 0.; ///< m; NaN: the middle
  bool                         stop_at_limit_cycle = false;
  double                       limit_cycle_tolerance = 0.;
  unsigned int                 limit_cycle_periods   = 0;
  unsigned int                 limit_cycle_windows   = 0;
  unsigned int                 probe_interval        = 0; ///< steps
  std::vector<ProbeParameters> probes;
  double                       snapshots_from     = 0.; ///< s
  double                       snapshots_to       = 0.; ///< s; NaN: the end
  double                       snapshots_interval = 0.; ///< s; 0: none
};

/** Section Modal. */
struct ModalParameters
{
  unsigned int n_modes = 0;
  std::string  bottom; ///< free, held in y, both
  double       tolerance = 0.;
};

/** Section Static contact. */
struct StaticContactParameters
{
  double       tolerance      = 0.;
  unsigned int max_iterations = 0;
};

/** Section Friction homogenization. */
struct FrictionHomogenizationParameters
{
  std::string heterogeneous_run; ///< folder with dynamics.h5 and summary.json
  std::string homogeneous_run;   ///< may be empty: T_G of the heterogeneous run
  std::string static_contact;    ///< folder of a static contact analysis, may be empty
  std::string pressures = "auto"; ///< or surface fractions, volume fractions, static contact
  bool        calibrate = false;  ///< delta relative to the homogeneous run
};

/** All of contact_dynamics' parameters, checked. */
struct ContactParameters
{
  ContactAnalysis                  analysis = ContactAnalysis::transient;
  BodyParameters                   body;
  TimeParameters                   time;
  TopSetup                         top;
  SideConstraints                  sides;
  bool                             periodic = false;
  FrictionParameters               friction;
  ObservationParameters            observation;
  CheckpointParameters             checkpoints;
  ModalParameters                  modal;
  StaticContactParameters          static_contact;
  FrictionHomogenizationParameters homogenization;
  unsigned int                     wavefront = 0;
  std::string                      instruction_set;
  StaticSolverKind                 static_solver = StaticSolverKind::multigrid;

  static void
  declare(dealii::ParameterHandler &prm, const RawParameters &raw);

  /** @throws UserError naming the key. */
  static ContactParameters
  parse(dealii::ParameterHandler &prm);
};
} // namespace mesoslip

#endif
