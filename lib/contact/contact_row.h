#ifndef mesoslip_contact_contact_row_h
#define mesoslip_contact_contact_row_h

#include "contact/contact_function.h"
#include "contact/friction_law.h"
#include "contact/load_history.h"
#include "elasticity/explicit_stepper.h"
#include "grid/nodal_field.h"
#include "io/state_checks.h"

#include <boost/serialization/vector.hpp>

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** The rigid flat and how the contact on it is observed. */
struct ContactSetup
{
  FrictionLaw law; ///< target, limit and regularization of the tangential force

  /** Coulomb coefficient of each node of the row. */
  std::vector<double> friction_coefficient;

  /** Velocity of the flat along x (m/s). */
  LoadHistory flat_velocity;

  /** Distance between row and flat in the undeformed state (m). */
  double gap = 0.;

  /** The last column duplicates the first. */
  bool periodic = false;

  /** A sample of the histories is kept every so many steps; 0: none. */
  unsigned int history_interval = 1;

  /** A sample is kept for take_recent() every so many steps; 0: none. */
  unsigned int recent_interval = 0;

  /** Steps in a block of the node statistics; 0: one block for the whole run. */
  std::uint64_t steps_per_block = 0;

  /** Columns whose motion and tractions are kept with the histories. */
  std::vector<unsigned int> monitored_nodes;
};

/** Motion and forces of one contact node, a value each sample; forces per unit thickness.
 */
struct MonitoredNode
{
  std::vector<double> ux;               ///< displacement (m)
  std::vector<double> uy;               ///< displacement (m)
  std::vector<double> vx;               ///< velocity (m/s)
  std::vector<double> vy;               ///< velocity (m/s)
  std::vector<double> normal_force;     ///< N/m, positive when pressed
  std::vector<double> tangential_force; ///< N/m, on the body

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &ux &uy &vx &vy &normal_force &tangential_force;
  }
};

/** Sampled resultants; energies are those dissipated from the start to the end of the
 * step. */
struct ContactHistory
{
  std::vector<std::uint64_t> step;      ///< number of the sampled step
  std::vector<double> time;             ///< s
  std::vector<double> normal_force;     ///< N/m, positive when pressed
  std::vector<double> tangential_force; ///< N/m, on the body
  std::vector<double> sticking;         ///< number of nodes that stick
  std::vector<double> slipping;         ///< number of nodes that slip
  std::vector<double> separated;        ///< numbers of nodes
  std::vector<double> friction_energy;  ///< J/m
  std::vector<double> impact_energy;    ///< J/m
  std::vector<double> flat_work;        ///< J/m
  std::vector<MonitoredNode> nodes;     ///< those of ContactSetup that are monitored

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &step &time &normal_force &tangential_force &sticking &slipping &separated;
    archive &friction_energy &impact_energy &flat_work &nodes;
  }
};

/** Steps that each node stuck or slipped in, and landings, in one block of steps. */
struct NodeCounts
{
  std::uint64_t first_step = 0; ///< first step of the block, from 0
  std::uint64_t n_steps    = 0; ///< in the block
  std::vector<float> stick;     ///< steps that stuck
  std::vector<float> slip;      ///< steps that slipped
  std::vector<float> landings;  ///< steps in which contact began

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &first_step &n_steps &stick &slip &landings;
  }
};

/** Energies since the start (J/m), every step counted. */
struct ContactWork
{
  double friction = 0.; ///< dissipated by friction, eq. (8)
  double impact   = 0.; ///< taken from the body by the normal forces
  double flat     = 0.; ///< done by the moving flat on the system

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &friction &impact &flat;
  }
};

/**
 * The bottom row of the body on a rigid flat moving along x: forward-increment Lagrange
 * multipliers and regularized Coulomb friction (eqs 2, 4, 7), with histories and
 * node statistics.
 */
class ContactRow : public BoundaryRow
{
public:
  /** As many nodes as @p setup has friction coefficients, none of them touching. */
  ContactRow(const ContactSetup &setup, const StepParameters &step);

  /**
   * Contact forces by forward increment Lagrange multipliers, then the step of the row.
   */
  void advance(const RowView &row) override;

  /** What was sampled so far. */
  const ContactHistory &history() const
  {
    return samples;
  }

  /** Takes out the samples of every recent_interval steps since the last call. */
  ContactHistory take_recent();

  /** Complete blocks and, after finish(), the last, shorter one. */
  const std::vector<NodeCounts> &blocks() const
  {
    return complete_blocks;
  }

  /** Closes the running block of the node statistics. */
  void finish();

  /** Energies since the start, of all nodes. */
  const ContactWork &work() const
  {
    return total;
  }

  /** Contact forces of the last step (N/m), one value a node. */
  const double *normal_force() const
  {
    return column(normal);
  }

  /** Of each node on the body (N/m), after the step. */
  const double *tangential_force() const
  {
    return column(tangential);
  }

  /**
   * Saves or restores the state between two steps (Boost.Serialization), after
   * take_recent(). A run that is continued with another setup keeps the length of its
   * blocks.
   */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &values &started &total &samples &steps_per_block &block &complete_blocks;
    require_when_loading(archive, is_consistent());
  }

  /** Steps since the start, as the blocks have counted them. */
  std::uint64_t counted_steps() const
  {
    return block.first_step + block.n_steps;
  }

private:
  /** Whether histories and blocks are those of this setup. */
  bool is_consistent() const;

  enum Column
  {
    gap,
    friction_coefficient,
    decay,
    lag,
    increment_x,
    increment_y,
    tangential,
    target,
    touching,
    normal,
    sticking,
    stick_count,
    slip_count,
    landing_count,
    n_columns_stored
  };

  double *column(const Column c)
  {
    return values.row(0, c);
  }
  const double *column(const Column c) const
  {
    return values.row(0, c);
  }

  ContactArrays arrays(const RowView &row);

  void initialize_increments(const RowView &row);

  /** Motion of the monitored nodes before the step. */
  void remember(const RowView &row);

  void record(const RowView &row, const ContactSums &sums, ContactHistory &history) const;

  void count_step();

  const ContactFunction advance_nodes = contact_function();

  const ContactSetup setup;
  const StepParameters step;
  const unsigned int n_nodes;
  const unsigned int n_distinct;

  NodalField<double> values; ///< one row for each Column; component 1 is unused
  // Of the monitored nodes, within a step.
  std::vector<double> u_before_x, u_before_y, w_before_x, w_before_y;
  bool started = false;
  ContactWork total;
  ContactHistory samples;
  ContactHistory recent; ///< since take_recent()
  std::uint64_t steps_per_block;
  NodeCounts block;
  std::vector<NodeCounts> complete_blocks;
};
} // namespace mesoslip

#endif
