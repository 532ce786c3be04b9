#ifndef mesoslip_sliding_contact_parameters_h
#define mesoslip_sliding_contact_parameters_h

#include "contact/static_contact_solver.h"
#include "eigenvalues/vibration_modes.h"
#include "exchange/run_description.h"
#include "observation/probe_recorder.h"
#include "observation/steady_state.h"
#include "sliding/complex/complex_parameters.h"
#include "sliding/flat/profile_parameters.h"
#include "sliding/friction/friction_parameters.h"
#include "sliding/mesh/mesh_body.h"
#include "sliding/sliding_body.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Stands for a value that is chosen automatically. */
constexpr double automatic = std::numeric_limits<double>::quiet_NaN();

/** Analyses of contact_dynamics. */
enum class ContactAnalysis
{
  transient,
  modal,
  static_contact,
  friction_homogenization,
  complex_modes
};

/** Section Body or Counter body: geometry and material. */
struct BodyParameters
{
  std::string section = "Body"; ///< section of the .prm that has its keys
  bool heterogeneous =
    false;              ///< whether phases have their own stiffness, or the effective one
  std::string rve_file; ///< empty: the material in stiffness and density
  std::string stiffness_name        = "effective"; ///< dataset of /stiffness
  MeanDilatation mean_dilatation    = MeanDilatation::automatic; ///< which phases have it
  std::vector<double> stiffness     = {36.54e9, 9.1e9, 47.26e9,
                                       13.785e9}; ///< 4, 6, in 3D 9, 21 numbers (Pa)
  double density                    = 1770.;      ///< kg/m^3
  std::array<double, 3> size        = {};         ///< m; 0: as the RVE
  std::array<unsigned int, 3> cells = {};         ///< 0: as the RVE
  std::array<double, 3> initial_velocity = {};    ///< m/s; z in 3D only
  std::array<double, 2> position         = {};    ///< x and y of the lowest corner (m)
};

/** Section Time, besides the StepParameters. */
struct TimeParameters
{
  double end_time      = 5e-4; ///< s
  double safety        = 0.95; ///< fraction of the critical time step
  bool check_time_step = true; ///< whether steps above the critical one are refused
  std::string continue_from;   ///< folder of a run whose end is the start; empty: at rest
};

/** Sections Observation and Snapshots, besides the intervals of the SlidingSetup. */
struct ObservationParameters
{
  unsigned int blocks      = 200;        ///< number of contact-state blocks
  double steady_from       = automatic;  ///< s
  double reference_x       = automatic;  ///< m
  bool stop_at_limit_cycle = false;      ///< end early
  LimitCycleCriterion limit_cycle;       ///< without the reference power
  std::vector<ProbePoint> probes;        ///< in the order of the .prm
  double snapshots_from     = 0.;        ///< s
  double snapshots_to       = automatic; ///< s
  double snapshots_interval = 0.;        ///< s; 0: none
  bool contact_means        = false;     ///< mean loads of all contact nodes
};

/** Section Contact map. */
struct ContactMapParameters
{
  double interval = 0.;        ///< s; 0: none
  double from     = 0.;        ///< s
  double to       = automatic; ///< s

  /** Names of the fields to write. */
  std::vector<std::string> fields = {"pressure", "traction", "slip velocity", "state"};
};

/** Section Friction homogenization. */
struct FrictionHomogenizationParameters
{
  std::string heterogeneous_run;  ///< folder with dynamics.h5 and summary.json
  std::string homogeneous_run;    ///< may be empty: T_G of the heterogeneous run
  std::string static_contact;     ///< folder of a static contact analysis, may be empty
  std::string pressures = "auto"; ///< estimate to use, see friction_estimates()
  bool calibrate        = false;  ///< whether delta is scaled to the homogeneous run
};

/** Section Static contact, besides the StaticContactOptions. */
struct StaticLoadParameters
{
  unsigned int steps          = 1;  ///< increments of load, and of displacement
  std::vector<double> of_flat = {}; ///< displacement along x and, in 3D, y (m), or empty

  /** Whether there are several increments. */
  bool has_history() const
  {
    return steps > 1 || moves_flat();
  }

  /** Whether the flat is displaced under the normal load. */
  bool moves_flat() const
  {
    return std::any_of(of_flat.begin(), of_flat.end(),
                       [](const double d) { return d != 0.; });
  }
};

/** Section Checkpoints. */
struct CheckpointParameters
{
  double interval = 300.;  ///< wall-clock time (s); 0: only when the run is stopped
  bool keep       = false; ///< whether it is kept after the run has ended
  bool end        = false; ///< whether the final motion is written
};

/** All parameters of contact_dynamics, checked; NaN: chosen automatically. */
struct ContactParameters : SlidingSetup
{
  /** The default values. */
  ContactParameters();

  ContactAnalysis analysis = ContactAnalysis::transient; ///< which analysis runs
  MeshBodyParameters mesh;                               ///< sections Mesh and Phases
  BodyParameters body;                                   ///< section Body
  std::size_t n_alphas = 1;            ///< values of Rayleigh alpha that are given
  std::size_t n_betas  = 1;            ///< values of Rayleigh beta that are given
  TimeParameters time;                 ///< section Time
  FrictionParameters friction;         ///< section Friction
  ProfileParameters profile;           ///< section Flat, height of the flat
  ObservationParameters observation;   ///< sections Observation and Snapshots
  ContactMapParameters map;            ///< section Contact map
  CheckpointParameters checkpoints;    ///< section Checkpoints
  VibrationModesOptions modal;         ///< section Modal, without the bottom
  std::string modal_bottom = "both";   ///< free, held in y or z, both
  bool modal_derivatives   = false;    ///< whether derivatives of frequencies are written
  StaticContactOptions static_contact; ///< section Static contact
  StaticLoadParameters static_load;    ///< section Static contact
  ComplexModesParameters complex_modes;            ///< section Complex modes
  FrictionHomogenizationParameters homogenization; ///< section Friction homogenization
  StaticSolverKind static_solver =
    StaticSolverKind::multigrid; ///< for static contact and modes

  /**
   * Binds the keys of all sections.
   * @throws UserError naming the key, also for keys that have no effect with the other
   * keys
   */
  void bind(Keys &keys);

  /** Parameters of the counter body; null: the flat is rigid. */
  std::shared_ptr<const ContactParameters> counter;

  bool is_counter =
    false; ///< whether it is a counter body, whose contact is its upper side

  bool slides_on =
    false; ///< whether it slides below the other body by more than its cells

  /** Whether this is a counter body that is computed upside down. */
  bool is_turned_over() const
  {
    return is_counter && mesh.is_plane_grid() && analysis == ContactAnalysis::transient;
  }

  std::vector<SideSupport>
    supports; ///< supports of the sides other than contact and top, which are held or
              ///< loaded

  /** The loaded sides, platens first. */
  std::vector<SideSupport> loaded_sides() const;

  /** The top support and the supports of the loaded sides of these parameters. */
  std::vector<const SideSupport *> suspended() const;

  /** Whether a support has springs, dashpots or masses. */
  bool supports_keep_energy() const;

  /** Whether the far end of a suspension moves, or a traction acts, along the normal of
   * the flat. */
  bool is_moved_normally() const;

  /** Whether a side exchanges forces along the normal of the flat. */
  bool sides_carry_normally() const;

  /** Whether a load, weight, a spring, a dashpot, the profile of the flat or a counter
   * body may press the body onto the flat, or meet it again. */
  bool presses_on_flat() const;

  /** Whether the top carries the whole friction and normal force, so that its forces give
   * the friction. */
  bool friction_is_at_top() const;

  /** Whether the loads of the contact nodes are summed up in every step. */
  bool wants_node_loads() const;

  /**
   * Loads and supports of a transient run or a static contact analysis; time step and
   * steady part are known only at the end of a run.
   */
  RunConditions stated_conditions() const;

private:
  void bind_loads(Keys &keys);
  void bind_top(Keys &keys);
  void check_top(const Keys &keys) const;
  void bind_sides(Keys &keys);
  void hold_sides();
  void check_platen(const Keys &keys) const;
  void bind_periodicity(Keys &keys);
  void make_coefficient_law(const Keys &keys);
  void bind_observation(Keys &keys);
  void bind_contact_map(Keys &keys);
  void check_contact_map(const Keys &keys) const;
  void continue_run(const Keys &keys);
  void bind_analyses(Keys &keys);
  void bind_counter(Keys &keys);
  void bind_supports_below(Keys &keys, ContactParameters &other) const;
  void check_counter(const Keys &keys, const ContactParameters &other) const;
};
} // namespace mesoslip

#endif
