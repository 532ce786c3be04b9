#ifndef mesoslip_dynamics_mesh_surface_h
#define mesoslip_dynamics_mesh_surface_h

#include "dynamics/surface_condition.h"
#include "grid/nodal_field.h"
#include "mesh/mesh_part.h"

namespace mesoslip
{
/**
 * A boundary surface of a mesh in time. Every rank has the whole surface in arrays of its
 * own and advances all of it, with the same bits: ranks give each other the forces on
 * their nodes, and conditions need not know that there are ranks. A surface has far fewer
 * nodes than the body, so what is done more than once is little.
 */
template <int dim>
class MeshSurface
{
public:
  /**
   * @p points are those of the whole mesh, in the order of the arrays; @p inverse_mass
   * (m/kg) is that of the points of @p part. Collective.
   */
  MeshSurface(const std::vector<unsigned int> &points,
              const MeshPart<dim> &part,
              const NodalField<double> &inverse_mass,
              SurfaceCondition<dim> &condition,
              const MPI_Comm communicator);

  /** Takes over u and w (m, m/s) of the nodes of this rank, after they were set.
   * Collective. */
  void load(const NodalField<double> &u, const NodalField<double> &w);

  /** Gives the forces (N, in 2D N/m) on owned nodes, dim of @p stride numbers a node, to
   * all ranks. */
  void start(const double *force, const unsigned int stride);

  /** Points of the part that belong to the surface. */
  const std::vector<unsigned int> &local_points() const
  {
    return local;
  }

  /** One step with these forces; u and w of the nodes of this rank are set. */
  void finish(const std::uint64_t step,
              const double time,
              NodalField<double> &u,
              NodalField<double> &w);

private:
  /** Gives all ranks what @p of_node returns for each component of owned nodes. */
  template <typename Value>
  void gather(const Value &of_node, NodalField<double> &result);
  void start_gathering();
  void finish_gathering(NodalField<double> &result);

  SurfaceCondition<dim> &condition;
  const MPI_Comm communicator;
  std::vector<unsigned int> local; ///< points of the part, owned ones first
  std::vector<unsigned int> place; ///< of these in the surface
  std::size_t n_owned = 0;
  NodalField<double> u, w, force, inverse_mass;

  std::vector<int> counts, offsets; ///< of numbers from each rank
  std::vector<unsigned int> places; ///< in the surface, in the order of the ranks
  std::vector<double> sent, received;
  MPI_Request request = MPI_REQUEST_NULL;
};
} // namespace mesoslip

#endif
