#ifndef mesoslip_dynamics_mesh_surface_h
#define mesoslip_dynamics_mesh_surface_h

#include "dynamics/shared_nodes.h"
#include "dynamics/supports/side_surface.h"
#include "dynamics/surface_condition.h"
#include "grid/nodal_field.h"

#include <functional>

namespace mesoslip
{
/**
 * A boundary surface of a mesh during time integration. Each rank advances its own nodes,
 * see SharedNodes. Ranks exchange only the sum of the forces, and only if the condition
 * needs it.
 */
template <int dim>
class MeshSurface
{
public:
  /**
   * @p inverse_mass returns the inverse mass (m/kg) of a component of a point of the
   * part. Collective.
   */
  MeshSurface(const SharedNodes &nodes,
              const std::function<double(unsigned int, unsigned int)> &inverse_mass,
              SurfaceCondition<dim> &condition,
              const MPI_Comm communicator);

  ~MeshSurface();

  MeshSurface(const MeshSurface &)            = delete; ///< owns a communicator
  MeshSurface &operator=(const MeshSurface &) = delete; ///< not copyable either

  /**
   * Registers node @p i as node @p k of @p side, too; @p side must outlive the last step.
   */
  void add_guest(const unsigned int i, SideSurface<dim> &side, const unsigned int k);

  /**
   * Sets the complete forces on the nodes (N, in 2D N/m) in @p step: @p force_of (k, c)
   * is component c at points()[k].
   */
  template <typename Force>
  void start(const std::uint64_t step, const double time, const Force &force_of)
  {
    for (std::size_t k = 0; k < point.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        force.row(c, 0)[place[k]] = force_of(k, c);
    start_loads(step, time);
  }

  /**
   * Recovers the forces from the velocities @p w_of_part (m/s) after a step of length
   * @p dt (s) without surface forces.
   */
  void start_from_motion(const std::uint64_t step,
                         const double time,
                         const NodalField<double> &w_of_part,
                         const double dt);

  /** Advances the nodes by one step with these forces, and sets their u and w. */
  void finish(NodalField<double> &u, NodalField<double> &w);

  /** Loads u and w (m, m/s) of the nodes from the fields. */
  void load(const NodalField<double> &u, const NodalField<double> &w);

  /** Points of the part that belong to the surface. */
  const std::vector<unsigned int> &points() const
  {
    return point;
  }

private:
  void start_loads(const std::uint64_t step, const double time);
  void start_sum();

  /** A node that also belongs to a side. */
  struct Guest
  {
    SideSurface<dim> *side; ///< side that loads it
    unsigned int k;         ///< index of the node in side
    unsigned int i;         ///< index of the node in the arrays
  };

  SurfaceCondition<dim> &condition;
  std::vector<unsigned int> point; ///< point of the part for each node
  std::vector<unsigned int> place; ///< index in the arrays of each node
  const unsigned int n_owned;      ///< owned nodes are the first ones
  NodalField<double> u, w, force, inverse_mass;
  NodalField<double> own_inverse_mass; ///< without guest masses
  SurfaceView<dim> view;               ///< view of the arrays in the current step
  std::vector<Guest> guests;

  MPI_Comm ranks = MPI_COMM_NULL; ///< ranks that sum the forces of this surface
  std::array<double, dim> own_force = {}, total_force = {};
  std::vector<double> of_ranks;
  MPI_Request request = MPI_REQUEST_NULL;
};
} // namespace mesoslip

#endif
