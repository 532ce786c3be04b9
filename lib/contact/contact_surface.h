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
/** The step of the contact nodes compiled for an instruction set, all of which give the same bits; in @p full with a
 *  profile of the flat and springs along it. Throws std::runtime_error if the processor lacks it. */
template <int dim>
ContactFunction contact_function(const InstructionSet isa = InstructionSet::automatic,
                                 const bool full          = false);

/** Width (m) of the bottom of @p grid that belongs to a node; half a cell at the ends. */
inline double
tributary_width(const UniformGrid<2> &grid, const unsigned int node, const bool periodic)
{
  const bool end = !periodic && (node == 0 || node == grid.cells[0]);
  return grid.spacing[0] * (end ? 0.5 : 1.);
}

template <int dim>
class ContactSurface;

/** Looks at the contact within the steps that it wants, see ContactSurface::observe(). */
template <int dim>
struct ContactObserver
{
  virtual ~ContactObserver() = default;

  /** Whether before() and after() are to be called in this step. */
  virtual bool wants(const std::uint64_t step) const = 0;

  /** The surface with u_n and w_n. */
  virtual void before(const SurfaceView<dim> &surface) = 0;

  /** The same with u_(n+1) and w_(n+1), and the contact forces of the step. */
  virtual void after(const SurfaceView<dim> &surface, ContactSurface<dim> &contact) = 0;
};

/**
 * The law of contact with a rigid flat that moves along itself: forward increment Lagrange
 * multipliers and regularized Coulomb friction (eqs 2, 4, 7).
 */
template <int dim>
class ContactSurface : public SurfaceCondition<dim>
{
public:
  /** As many nodes as @p setup has friction coefficients, none of them touching. */
  ContactSurface(const ContactSetup &setup, const StepParameters &step);

  /** @p observer is called from now on and has to outlive the last step. */
  void observe(ContactObserver<dim> &observer)
  {
    observers.push_back(&observer);
  }

  /** Contact forces by forward increment Lagrange multipliers, then the step. */
  void advance(const SurfaceView<dim> &surface) override;

  /** What the forces of that step would be (N, in 2D N/m): into rows of @p trial, padded to whole vectors, in the order of the axes.
   * The @p first trial decides which nodes stick in the step. For ContactSetup::is_coupled, without a profile. */
  void try_forces(const SurfaceView<dim> &surface,
                  const std::array<double *, dim> &trial,
                  const bool first);

  /** Before the step in which the surface below rises by @p rise (m) under each node as it slides, and with it what nodes @p moved
   * relative to it in the step before changes (m, a row for each axis); for ContactSetup::is_coupled. */
  void ride(const double *rise, const std::array<const double *, dim> &moved);

  /** Energies since the start, and that in the springs, of the nodes of this rank; external is the
   * work of the moving flat. */
  const BoundaryWork &work() const
  {
    return total;
  }

  /** Resultants of the last step, of the nodes of this rank. */
  const ContactSums &sums() const
  {
    return last;
  }

  /** Number of nodes of this rank, a periodic one counted once. */
  unsigned int n_distinct_nodes() const
  {
    return n_distinct;
  }

  /** Normal forces of the last step (N/m), one value a node. */
  const double *normal_force() const
  {
    return column(Column::normal_force);
  }

  /** Tangential forces of the last step on the body (N/m) along x, one value a node. */
  const double *tangential_force() const
  {
    return column(Column::tangential_force);
  }

  /** In 3D: the same along y. */
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

  /** By what the nodes moved in the last step along x (@p component 0) or, in 3D, y (1)
   * (m). */
  const double *increment(const unsigned int component) const
  {
    return column(component == 0 ? Column::increment_x : Column::lateral_increment);
  }

  /** Distance (m) of node @p i of @p surface from the flat before the last step, at the instant of its forces; what
   * a spring is pressed in by counts less than 0. */
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

  /** By what the flat moves along x and y in the step that begins at @p time (m). */
  std::array<double, 2> flat_increment(const double time) const
  {
    return flat_increment_at(setup.flat_velocity(time));
  }

  /** The mean of that and the one before: the central increment (m). */
  std::array<double, 2> central_flat_increment(const double time) const
  {
    return flat_increment_at(0.5 * (setup.flat_velocity(std::max(0., time - step.dt)) +
                                    setup.flat_velocity(time)));
  }

  /** Whether node @p i stays on the flat if the body's @p acceleration along the normal is all that
   * acts at the start; on a spring it does not. */
  bool rests(const unsigned int i, const double acceleration) const
  {
    const unsigned int original = setup.periodic && i == n_distinct ? 0 : i;
    return acceleration <= 0. && column(Column::gap)[original] <= 0. &&
           !setup.is_compliant();
  }

  /** What makes the coefficients of friction vary; null when they are constant. */
  const VariableFriction<dim> *variable_friction() const
  {
    return variable.get();
  }

  /** The state of the friction law, one value a node; null if it has none.
   * FrictionLaw::slip_law has its name and unit. */
  const double *law_state() const
  {
    return variable ? variable->state() : nullptr;
  }

  /** The node counts since the last call; steps are left at 0. */
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

  /** Saves or restores what a run leaves for another one that starts from its end (Boost.Serialization): forces and
   * states of the nodes, and what the law of friction remembers. */
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
    double before; ///< in the step that ends
    double now;    ///< in that which begins
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

  NodalField<double> values; ///< one row, a component for each Column
  std::unique_ptr<VariableFriction<dim>> variable;
  std::unique_ptr<MovingProfile<dim>> profile; ///< null: the flat is even
  std::unique_ptr<PowerSprings<dim>> springs;  ///< null: they are linear, or none
  bool started   = false;
  bool continues = false; ///< whether it began with the memory of another run
  BoundaryWork total;
  ContactSums last;
  std::vector<ContactObserver<dim> *> observers;
};
} // namespace mesoslip

#endif
