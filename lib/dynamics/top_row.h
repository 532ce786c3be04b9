#ifndef mesoslip_dynamics_top_row_h
#define mesoslip_dynamics_top_row_h

#include "contact/load_history.h"
#include "elasticity/explicit_stepper.h"
#include "io/serialize_members.h"
#include "io/state_checks.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace mesoslip
{
/** How the top of the body is loaded. */
struct TopSetup
{
  /** What the top may do. */
  enum class Kind
  {
    pressure, ///< a pressure on each node
    platen,   ///< rigid: u_x = 0 and one common u_y, pushed by the pressure's resultant
    held      ///< u = 0
  };

  Kind kind = Kind::platen; ///< platen, pressure or held

  /** Pressure (Pa), positive when it presses the body on the flat. */
  LoadHistory pressure;

  /** With Kind::pressure: u_x = 0 on the top. */
  bool lateral_held = false;

  /** Mass of the platen per unit thickness (kg/m). */
  double platen_mass = 0.;

  /** From this time (s) on the top stays where it is. */
  double hold_from = std::numeric_limits<double>::infinity();

  /** Width of a cell (m). */
  double cell_width = 0.;

  /** The last column duplicates the first. */
  bool periodic = false;

  /** A sample of the history is kept every so many steps; 0: none. */
  unsigned int history_interval = 1;

  /** A sample is kept for take_recent() every so many steps; 0: none. */
  unsigned int recent_interval = 0;
};

/** Sampled resultants at the top, per unit thickness. */
struct TopHistory
{
  std::vector<double> normal_force;     ///< N/m, positive when it presses
  std::vector<double> tangential_force; ///< N/m, as transmitted from the contact
  std::vector<double> displacement;     ///< mean u_y (m)
  std::vector<double> work;             ///< done on the body since the start (J/m)

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<4>(archive, *this);
  }
};

/**
 * The top row of nodes under its load. Work is formed with the central increment
 * (u_(n+1) - u_(n-1)) / 2, for which the discrete energy balance is exact.
 */
class TopRow : public BoundaryRow
{
public:
  /** For a top of @p n_columns nodes, at rest. */
  TopRow(const TopSetup &setup, const StepParameters &step, const unsigned int n_columns);

  /** One step of the row under its load. */
  void advance(const RowView &row) override;

  /** What was sampled so far. */
  const TopHistory &history() const
  {
    return samples;
  }

  /** Takes out the samples of every recent_interval steps since the last call. */
  TopHistory take_recent()
  {
    return std::exchange(recent, TopHistory());
  }

  /** Work done on the body since the start (J/m). */
  double work() const
  {
    return total_work;
  }

  /** Saves or restores the state between two steps (Boost.Serialization), after
   * take_recent(). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &increment_x &increment_y &started &holding &moving_mass &platen_w;
    archive &total_work &samples;
    require_when_loading(archive,
                         equally_long(tributary, increment_x, increment_y) &&
                           equally_long(samples.normal_force, samples.tangential_force,
                                        samples.displacement, samples.work));
  }

private:
  /** Forces on the body during one step. */
  struct Load
  {
    double normal     = 0.; ///< N/m
    double tangential = 0.; ///< N/m
  };

  void initialize(const RowView &row);

  Load push_nodes(const RowView &row);
  Load push_platen(const RowView &row);
  Load hold(const RowView &row);
  void stop(const RowView &row);

  void move_node(double &u, double &w, const double acceleration) const;

  const TopSetup setup;
  const StepParameters step;
  const unsigned int n_distinct;

  std::vector<double> tributary;                ///< width (m) that each node carries
  std::vector<double> increment_x, increment_y; ///< of the step before (m)
  bool started          = false;
  bool holding          = false;
  double moving_mass    = 0.; ///< of platen and row (kg/m)
  double platen_w       = 0.;
  double total_work     = 0.;
  double work_this_step = 0.;
  TopHistory samples;
  TopHistory recent; ///< since take_recent()
};
} // namespace mesoslip

#endif
