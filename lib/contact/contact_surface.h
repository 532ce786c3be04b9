#ifndef mesoslip_contact_contact_surface_h
#define mesoslip_contact_contact_surface_h

#include "contact/contact_kernel.h"
#include "contact/flat/contact_setup.h"
#include "contact/flat/moving_profile.h"
#include "contact/flat/power_springs.h"
#include "contact/friction_law.h"
#include "contact/laws/variable_friction.h"
#include "contact/node_counts.h"
#include "dynamics/energy_audit.h"
#include "dynamics/surface_condition.h"
#include "grid/instruction_set.h"
#include "grid/nodal_field.h"
#include "grid/uniform_grid.h"
#include "parameters/load_history.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace mesoslip
{
/**
 * Contact step compiled for an instruction set; all variants give the same bits. With
 * @p full it supports profiles and tangential springs. Throws std::runtime_error if the
 * processor lacks the instruction set.
 */
template <int dim>
ContactFunction contact_function(const InstructionSet isa = InstructionSet::automatic,
                                 const bool full          = false);

/** Tributary width of a node at the bottom of @p grid (m); half a cell at the ends. */
inline double
tributary_width(const UniformGrid<2> &grid, const unsigned int node, const bool periodic)
{
  const bool end = !periodic && (node == 0 || node == grid.cells[0]);
  return grid.spacing[0] * (end ? 0.5 : 1.);
}

template <int dim>
class ContactSurface;

/** Observer of the contact during time steps, see ContactSurface::observe(). */
template <int dim>
struct ContactObserver
{
  virtual ~ContactObserver() = default;

  /** Whether before() and after() are called in step @p step. */
  virtual bool wants(const std::uint64_t step) const = 0;

  /** Called before the step, with u_n and w_n. */
  virtual void before(const SurfaceView<dim> &surface) = 0;

  /** Called after the step, with u_(n+1), w_(n+1) and the contact forces of the step. */
  virtual void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) = 0;
};

/**
 * Contact with a rigid flat that moves along itself: forward-increment Lagrange
 * multipliers and regularized Coulomb friction (eqs 2, 4, 7).
 */
template <int dim>
class ContactSurface : public SurfaceCondition<dim>
{
public:
  /**
   * The number of nodes is the number of friction coefficients in @p setup; no node
   * touches initially.
   */
  ContactSurface(const ContactSetup &setup, const StepParameters &step);

  /** Registers @p observer for all following steps; it must outlive the last step. */
  void observe(ContactObserver<dim> &observer)
  {
    observers.push_back(&observer);
  }

  /** Computes the contact forces, then advances the nodes by one step. */
  void advance(const SurfaceView<dim> &surface) override;

  /**
   * Computes the forces of that step without executing it (N, in 2D N/m), in rows of
   * @p trial, padded to whole vectors, in the order of the axes. The @p first trial
   * decides which nodes stick in the step. For ContactSetup::is_coupled, without a
   * profile.
   */
  void try_forces(const SurfaceView<dim> &surface,
                  const std::array<double *, dim> &trial,
                  const bool first);

  /**
   * Call before a step in which the sliding surface below rises by @p rise (m) at each
   * node. @p moved (m, one row per axis) replaces the increments of the nodes relative to
   * it in the previous step. For ContactSetup::is_coupled.
   */
  void ride(const double *rise, const std::array<const double *, dim> &moved);

  /**
   * Energies since the start and energy in the springs, for the nodes of this rank;
   * external is the work of the moving flat.
   */
  const BoundaryWork &work() const
  {
    return total;
  }

  /** Resultants of the last step, for the nodes of this rank. */
  const ContactSums &sums() const
  {
    return last;
  }

  /** Number of nodes of this rank without periodic copies. */
  unsigned int n_distinct_nodes() const
  {
    return n_distinct;
  }

  /** Normal forces of the last step (N/m), one value per node. */
  const double *normal_force() const
  {
    return column(Column::normal_force);
  }

  /** Tangential forces on the body along x in the last step (N/m), one value per node. */
  const double *tangential_force() const
  {
    return column(Column::tangential_force);
  }

  /**
   * In 3D: tangential forces on the body along y in the last step, one value per node.
   */
  const double *lateral_force() const
  {
    return column(Column::lateral_force);
  }

  /** 1 for nodes that touched the flat in the last step, else 0. */
  const double *touching() const
  {
    return column(Column::touching);
  }

  /** 1 for nodes that touched without sliding in the last step, else 0. */
  const double *sticking() const
  {
    return column(Column::sticking);
  }

  /**
   * Displacement increments of the nodes in the last step along x (@p component 0) or, in
   * 3D, y (1) (m).
   */
  const double *increment(const unsigned int component) const
  {
    return column(component == 0 ? Column::increment_x : Column::lateral_increment);
  }

  /**
   * Gap (m) of node @p i of @p surface before the last step, at the instant of its
   * forces; negative while a spring is compressed.
   */
  double gap_before(const SurfaceView<dim> &surface, const unsigned int i) const
  {
    return column(Column::gap)[i] + column(Column::rise)[i] + surface.u[dim - 1][i] -
           column(Column::increment_y)[i];
  }

  /** Length of a step (s). */
  double time_step() const
  {
    return step.dt;
  }

  /** Increment of the flat along x and y in the step that begins at @p time (m). */
  std::array<double, 2> flat_increment(const double time) const
  {
    return flat_increment_at(setup.flat_velocity(time));
  }

  /** Central increment of the flat: the mean of this step and the previous one (m). */
  std::array<double, 2> central_flat_increment(const double time) const
  {
    return flat_increment_at(0.5 * (setup.flat_velocity(std::max(0., time - step.dt)) +
                                    setup.flat_velocity(time)));
  }

  /**
   * Whether node @p i stays on the flat at the start, when only @p acceleration of the
   * body along the normal acts; never on a spring.
   */
  bool rests(const unsigned int i, const double acceleration) const
  {
    const unsigned int master = setup.periodic && i == n_distinct ? 0 : i;
    return acceleration <= 0. && column(Column::gap)[master] <= 0. &&
           !setup.is_compliant();
  }

  /** Model of variable friction coefficients; null if they are constant. */
  const VariableFriction<dim> *variable_friction() const
  {
    return variable.get();
  }

  /**
   * State variable of the friction law, one value per node; null if it has none.
   * FrictionLaw::coefficient_law has its name and unit.
   */
  const double *law_state() const
  {
    return variable ? variable->state() : nullptr;
  }

  /** Node counts since the last call; the step numbers are 0. */
  NodeCounts take_counts();

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &values &started;
    serialize_members<7>(archive, total);
    if (variable)
      archive &*variable;
    if (profile)
      archive &*profile;
  }

  /**
   * Saves or restores the memory that a run passes on to a subsequent run
   * (Boost.Serialization): forces and states of the nodes, and the state of the friction
   * law.
   */
  template <class Archive>
  void serialize_memory(Archive &archive)
  {
    using C       = ContactArrays::Column;
    std::size_t n = n_nodes;
    archive &n;
    if (n != n_nodes)
      throw std::length_error("a contact of another number of nodes was saved");
    for (const C c : {C::tangential_force, C::target, C::touching, C::normal_force,
                      C::sticking, C::stretch, C::stretch_before})
      serialize_array(archive, column(c), n_nodes);
    if (dim == 3)
      for (const C c : {C::lateral_force, C::lateral_target, C::lateral_stretch,
                        C::lateral_stretch_before})
        serialize_array(archive, column(c), n_nodes);
    if (variable)
      archive &*variable;
    continues = continues || Archive::is_loading::value;
  }

private:
  using Column = ContactArrays::Column;

  double *column(const Column c)
  {
    return values.row(c, 0);
  }
  const double *column(const Column c) const
  {
    return values.row(c, 0);
  }
  ContactArrays arrays(const SurfaceView<dim> &surface,
                       const unsigned int first,
                       const unsigned int end);

  /** Velocity of the flat along its direction (m/s). */
  struct FlatVelocity
  {
    double before; ///< in the previous step
    double now;    ///< in the step that begins
  };

  FlatVelocity flat_at(const double time) const
  {
    return {setup.flat_velocity(std::max(0., time - step.dt)), setup.flat_velocity(time)};
  }

  ContactStep constants(const FlatVelocity &flat) const;
  void begin(const SurfaceView<dim> &surface);
  void prepare(const SurfaceView<dim> &surface, const FlatVelocity &flat);
  void advance_all(const SurfaceView<dim> &surface, const FlatVelocity &flat);

  std::array<double, 2> flat_increment_at(const double flat_velocity) const
  {
    const double moved = flat_velocity * step.dt;
    return {{moved * setup.flat_direction[0], moved * setup.flat_direction[1]}};
  }

  void initialize_increments(const SurfaceView<dim> &surface);
  void relax_along_flat(const SurfaceView<dim> &surface);
  void count_stretched_springs();

  const ContactSetup setup;
  const ContactFunction advance_nodes;
  const StepParameters step;
  const unsigned int n_nodes;
  const unsigned int n_distinct;

  NodalField<double> values; ///< one row, one component per Column
  std::unique_ptr<VariableFriction<dim>> variable;
  std::unique_ptr<MovingProfile<dim>> profile; ///< null: the flat is even
  std::unique_ptr<PowerSprings<dim>> springs;  ///< null: linear springs or none
  bool started   = false;
  bool continues = false; ///< whether it started with the memory of another run
  BoundaryWork total;
  ContactSums last;
  std::vector<ContactObserver<dim> *> observers;
};
} // namespace mesoslip

#endif
