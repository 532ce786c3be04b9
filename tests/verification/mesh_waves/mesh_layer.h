#ifndef mesoslip_tests_verification_mesh_layer_h
#define mesoslip_tests_verification_mesh_layer_h

#include "../mesh_sliding/mesh_sliding.h"
#include "../sliding/sliding_layer.h"

#include <functional>
#include <set>
#include <vector>

namespace verification
{
namespace sliding_layer
{
/** The layer's material: c_T = 2560 m/s, nu = 0.2. */
template <int dim>
ElasticPhase<dim> layer_material()
{
  const double density = 1900.;
  return {isotropic_stiffness<dim>(2.4 * density * c_T * c_T, 0.2), density};
}

/** A displacement or velocity at a point, by component. */
template <int dim>
using Field = std::function<double(const dealii::Point<dim> &, unsigned int)>;

/** @p c, periodic along x. */
template <int dim>
MeshCase<dim> joined(MeshCase<dim> c)
{
  c.join(0);
  return c;
}

/** A body on a mesh that is periodic along x, on one rank. */
template <int dim>
class LayerRun
{
public:
  /** With so much of the critical time step. */
  explicit LayerRun(const MeshCase<dim> &open, const double share = 0.9)
    : c(joined(open))
    , part(
        distribute(c.mesh, std::vector<unsigned int>(c.mesh.cells.size()), MPI_COMM_SELF))
    , op(part, c.phases, MPI_COMM_SELF)
    , contact_boundary(c.side(2 * (dim - 1)))
    , top_boundary(c.side(2 * dim - 1))
    , setup(completed(share))
    , body(op, contact_boundary, top_boundary, c.held, setup)
  {
  }

  /** Sets u and w, what is held as well. */
  void set(const Field<dim> &displacement, const Field<dim> &velocity)
  {
    for (unsigned int k = 0; k < dim; ++k)
      for (std::size_t i = 0; i < part.points.size(); ++i)
        {
          body.u.row(k, 0)[i] = displacement(part.points[i], k);
          body.w.row(k, 0)[i] = velocity(part.points[i], k);
        }
  }

  void run(const unsigned int n_steps)
  {
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        body.stepper.advance(1);
        slipping =
          slipping && body.contact.sums().slipping == contact_boundary.points.size();
      }
  }

  /** Every node slipped all the time. */
  bool slipping = true;

private:
  const MeshCase<dim> c;
  const MeshPart<dim> part;
  const MeshOperator<dim> op;
  const MeshBoundary contact_boundary, top_boundary;

public:
  const SlidingSetup setup;

private:
  SlidingMesh<dim> body;

  SlidingSetup completed(const double share) const
  {
    SlidingSetup s = c.setup;
    s.contact.friction_coefficient.assign(contact_boundary.points.size(), c.friction);
    s.step.dt =
      share * critical_time_step(largest_frequency(op).upper, s.step.beta2, s.step.beta);
    return s;
  }

public:
  /** The sum over the lowest points, each once, of a component of u times @p weight. */
  template <typename Weight>
  auto sum_below(const unsigned int component, const Weight &weight) const
  {
    decltype(weight(part.points[0])) sum = 0.;
    const std::set<unsigned int> below(contact_boundary.points.begin(),
                                       contact_boundary.points.end());
    for (std::size_t i = 0; i < part.n_distinct; ++i)
      if (below.count(part.point_in_mesh[i]) > 0)
        sum += body.u.row(component, 0)[i] * weight(part.points[i]);
    return sum;
  }
};
} // namespace sliding_layer
} // namespace verification

#endif
