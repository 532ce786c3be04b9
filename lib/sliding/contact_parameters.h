#ifndef mesoslip_sliding_contact_parameters_h
#define mesoslip_sliding_contact_parameters_h

#include "contact/contact_recorder.h"
#include "contact/friction_law.h"
#include "dynamics/explicit_stepper.h"
#include "dynamics/top_surface.h"
#include "parameters/load_history.h"
#include "sliding/transient/transient_checkpoint.h"
#include "statics/static_solver.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** A value that is chosen automatically. */
constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

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
  /** Every phase with its own stiffness, else the effective one. */
  bool heterogeneous = false;
  std::string rve_file; ///< empty: the material in stiffness and density
  std::string stiffness_name = "effective"; ///< dataset of /stiffness
  /** 4 or 6 coefficients (Pa). */
  std::vector<double> stiffness          = {36.54e9, 9.1e9, 47.26e9, 13.785e9};
  double density                         = 1770.; ///< kg/m^3
  std::array<double, 2> size             = {};    ///< m; 0: as the RVE
  std::array<unsigned int, 2> cells      = {};    ///< 0: as the RVE
  std::array<double, 2> initial_velocity = {};    ///< m/s
  std::array<double, 2> acceleration     = {};    ///< m/s^2
};

/** Section Time. */
struct TimeParameters
{
  double end_time      = 5e-4;      ///< s
  double time_step     = automatic; ///< s
  double safety        = 0.95;      ///< fraction of the critical time step
  double beta2         = 0.5;       ///< of the time scheme, 0.5 to 1
  double beta          = 4.4e-9;    ///< Rayleigh's, of the stiffness (s)
  bool check_time_step = true;      ///< refuse steps above the critical one
};

/** Sections Flat and Friction. */
struct FrictionParameters
{
  LoadHistory flat_velocity;                   ///< m/s
  double gap = 0.;                             ///< between body and flat at the start (m)
  FrictionLaw law;                             ///< delta and its rule
  std::string law_name      = "constant time"; ///< coulomb, constant time or slip rate
  double slip_length        = 0.;    ///< L of the slip-rate law (m); 0: another law
  double reference_velocity = 0.;    ///< V_ref of the slip-rate law (m/s)
  bool coefficient_by_phase = false; ///< those of the phases in rve.h5
  double coefficient        = 0.25;  ///< of all nodes, unless by phase
  /** stiffness, mean, largest or smallest of the adjacent cells. */
  std::string node_rule = "stiffness";
};

/** A point that is watched. */
struct ProbeParameters
{
  std::string name;                       ///< of its subsection
  std::array<double, 2> position = {};    ///< from the lower left corner (m)
  bool nearest_node              = false; ///< move the position to a node
};

/** Sections Observation and Snapshots. */
struct ObservationParameters
{
  unsigned int history_interval = 10;        ///< steps
  unsigned int energy_interval  = 200;       ///< steps; 0: none
  unsigned int blocks           = 200;       ///< of contact states over the run
  double steady_from            = automatic; ///< s
  double reference_x            = automatic; ///< m
  bool stop_at_limit_cycle      = false;     ///< end early
  /** Largest relative difference of the windows of a limit cycle. */
  double limit_cycle_tolerance     = 0.02;
  unsigned int limit_cycle_periods = 3;  ///< in a window, at least
  unsigned int limit_cycle_windows = 3;  ///< windows that are compared
  unsigned int probe_interval      = 10; ///< steps
  std::vector<ProbeParameters> probes;   ///< in the order of the .prm
  double snapshots_from     = 0.;        ///< s
  double snapshots_to       = automatic; ///< s
  double snapshots_interval = 0.;        ///< s; 0: none
};

/** Section Modal. */
struct ModalParameters
{
  unsigned int n_modes = 4;      ///< for each bottom
  std::string bottom   = "both"; ///< free, held in y, both
  double tolerance     = 1e-10;  ///< of the residual, relative
};

/** Section Static contact. */
struct StaticContactParameters
{
  double tolerance            = 1e-8; ///< of the residual forces, relative
  unsigned int max_iterations = 200;  ///< over contact states and friction
};

/** Section Friction homogenization. */
struct FrictionHomogenizationParameters
{
  std::string heterogeneous_run; ///< folder with dynamics.h5 and summary.json
  std::string homogeneous_run;   ///< may be empty: T_G of the heterogeneous run
  std::string static_contact;    ///< folder of a static contact analysis, may be empty
  std::string pressures =
    "auto";               ///< or surface fractions, volume fractions, static contact
  bool calibrate = false; ///< delta relative to the homogeneous run
};

/** All of contact_dynamics' parameters, checked. */
struct ContactParameters
{
  /** What is computed. */
  ContactAnalysis analysis = ContactAnalysis::transient;
  BodyParameters body;   ///< section Body
  TimeParameters time;   ///< section Time
  TopSetup top;          ///< section Top
  SideConstraints sides; ///< components held on the left and right
  /** The right side continues on the left. */
  bool periodic = false;
  FrictionParameters friction;                     ///< sections Flat and Friction
  ObservationParameters observation;               ///< sections Observation and Snapshots
  CheckpointParameters checkpoints;                ///< section Checkpoints
  ModalParameters modal;                           ///< section Modal
  StaticContactParameters static_contact;          ///< section Static contact
  FrictionHomogenizationParameters homogenization; ///< section Friction homogenization
  unsigned int wavefront = 0;                      ///< time steps in flight; 0: automatic
  /** Of the row kernels; auto: the best there is. */
  std::string instruction_set = "auto";
  /** For static contact and modes. */
  StaticSolverKind static_solver = StaticSolverKind::multigrid;

  /** Binds the keys of all sections. @throws UserError naming the key. */
  void bind(Keys &keys);

  /** @throws UserError for keys that others leave without effect. */
  static void check_keys(const Keys &keys);

  /** @throws UserError naming the key. */
  void check() const;
};
} // namespace mesoslip

#endif
