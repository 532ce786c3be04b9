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

/** A body on a mesh or of bricks that is periodic along x, on one rank. */
template <int dim>
class LayerRun : BodyParts<dim>
{
public:
  /** With so much of the critical time step. */
  explicit LayerRun(const MeshCase<dim> &open, const double share = 0.9)
    : BodyParts<dim>(joined(open), MPI_COMM_SELF)
    , part(this->distributed->part())
    , setup(completed(open.friction, share))
    , body(
        *this->distributed, this->contact_boundary, this->top_boundary, this->held, setup)
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
        slipping = slipping &&
                   body.contact.sums().slipping == this->contact_boundary.points.size();
      }
  }

  /** Every node slipped all the time. */
  bool slipping = true;

private:
  const MeshPart<dim> &part;

public:
  const SlidingSetup setup;

private:
  SlidingMesh<dim> body;

  SlidingSetup completed(const double friction, const double share) const
  {
    SlidingSetup s = this->with_friction(friction);
    s.step.dt = share * critical_time_step(this->distributed->largest_frequency().upper,
                                           s.step.beta2, s.step.beta);
    return s;
  }

public:
  /** The sum over the lowest points, each once, of a component of u times @p weight. */
  template <typename Weight>
  auto sum_below(const unsigned int component, const Weight &weight) const
  {
    decltype(weight(part.points[0])) sum = 0.;
    const std::set<unsigned int> below(this->contact_boundary.points.begin(),
                                       this->contact_boundary.points.end());
    for (std::size_t i = 0; i < part.n_distinct; ++i)
      if (below.count(part.point_in_mesh[i]) > 0)
        sum += body.u.row(component, 0)[i] * weight(part.points[i]);
    return sum;
  }
};
} // namespace sliding_layer
} // namespace verification

#endif
