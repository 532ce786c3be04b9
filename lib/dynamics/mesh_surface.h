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
 * A boundary surface of a mesh in time: each rank advances the nodes that it has, see
 * SharedNodes. Ranks tell each other only the sum of the forces, and that only if the
 * condition wants it.
 */
template <int dim>
class MeshSurface
{
public:
  /** @p inverse_mass (m/kg) of a component of a point of the part. Collective. */
  MeshSurface(const SharedNodes &nodes,
              const std::function<double(unsigned int, unsigned int)> &inverse_mass,
              SurfaceCondition<dim> &condition,
              const MPI_Comm communicator);

  ~MeshSurface();

  MeshSurface(const MeshSurface &)            = delete; ///< owns a communicator
  MeshSurface &operator=(const MeshSurface &) = delete; ///< see the constructor

  /** From now on node @p i is node @p k of @p side, too, which must outlive the last step. */
  void add_guest(const unsigned int i, SideSurface<dim> &side, const unsigned int k);

  /** Takes the forces (N, in 2D N/m) on the nodes in @p step: @p force_of (k, c) is component c of that
   * on points()[k]; they are complete. */
  template <typename Force>
  void start(const std::uint64_t step, const double time, const Force &force_of)
  {
    for (std::size_t k = 0; k < point.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        force.row(c, 0)[place[k]] = force_of(k, c);
    start_loads(step, time);
  }

  /** Takes the forces from what a step of length @p dt (s) without any at the surface made of the velocities
   * before it: @p w_of_part (m/s). */
  void start_from_motion(const std::uint64_t step,
                         const double time,
                         const NodalField<double> &w_of_part,
                         const double dt);

  /** One step with these forces; u and w of the nodes are set. */
  void finish(NodalField<double> &u, NodalField<double> &w);

  /** Takes over u and w (m, m/s) of the nodes, after they were set. */
  void load(const NodalField<double> &u, const NodalField<double> &w);

  /** Points of the part that belong to the surface. */
  const std::vector<unsigned int> &points() const
  {
    return point;
  }

private:
  void start_loads(const std::uint64_t step, const double time);
  void start_sum();

  /** A node that is in a side, too. */
  struct Guest
  {
    SideSurface<dim> *side; ///< that loads it
    unsigned int k;         ///< its number there
    unsigned int i;         ///< its place in the arrays
  };

  SurfaceCondition<dim> &condition;
  std::vector<unsigned int> point; ///< of the part, for each node
  std::vector<unsigned int> place; ///< of each node in the arrays
  const unsigned int n_owned;      ///< the first places
  NodalField<double> u, w, force, inverse_mass;
  NodalField<double> own_inverse_mass; ///< without guests
  SurfaceView<dim> view;               ///< of the arrays, in the step that was started
  std::vector<Guest> guests;

  MPI_Comm ranks = MPI_COMM_NULL; ///< with nodes of a surface whose forces are summed
  std::array<double, dim> own_force = {}, total_force = {};
  std::vector<double> of_ranks;
  MPI_Request request = MPI_REQUEST_NULL;
};
} // namespace mesoslip

#endif
