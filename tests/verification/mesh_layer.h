#ifndef mesoslip_tests_verification_mesh_layer_h
#define mesoslip_tests_verification_mesh_layer_h

#include "mesh_sliding.h"
#include "sliding_layer.h"

#include <functional>
#include <memory>
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

/** Hands a condition each point of a periodic boundary twice, with the forces and the mass
 * of both copies, so that both move alike. */
template <int dim>
class PeriodicSurface : public SurfaceCondition<dim>
{
public:
  /** @p partner: the place of the other copy of each point in the surface; of itself if
   * there is none. */
  PeriodicSurface(SurfaceCondition<dim> &inner, const std::vector<std::size_t> &partner)
    : inner(inner)
    , partner(partner)
    , force(static_cast<unsigned int>(partner.size()), 1, dim)
    , inverse_mass(force)
  {
  }

  void advance(const SurfaceView<dim> &surface) override
  {
    SurfaceView<dim> view = surface;
    for (unsigned int c = 0; c < dim; ++c)
      {
        for (std::size_t i = 0; i < surface.n; ++i)
          {
            const std::size_t j = partner[i];
            const double m      = surface.inverse_mass[c][i];
            force.row(c, 0)[i]  = surface.force[c][i] + (i != j) * surface.force[c][j];
            const double both   = 1. / m + 1. / surface.inverse_mass[c][j];
            inverse_mass.row(c, 0)[i] = i == j || m == 0. ? m : 1. / both;
          }
        view.force[c]        = force.row(c, 0);
        view.inverse_mass[c] = inverse_mass.row(c, 0);
      }
    inner.advance(view);
  }

private:
  SurfaceCondition<dim> &inner;
  const std::vector<std::size_t> partner;
  NodalField<double> force, inverse_mass; ///< aligned and padded as the kernel wants them
};

/** A body on a mesh that is periodic along x, on one rank. Points at both ends of x lie
 * opposite. */
template <int dim>
class LayerRun
{
public:
  /** With so much of the critical time step. */
  explicit LayerRun(const MeshCase<dim> &c, const double share = 0.9)
    : part(
        distribute(c.mesh, std::vector<unsigned int>(c.mesh.cells.size()), MPI_COMM_SELF))
    , op(part, c.phases, MPI_COMM_SELF)
    , contact_boundary(c.side(2 * (dim - 1)))
    , top_boundary(c.side(2 * dim - 1))
    , setup(completed(c, share))
    , u(static_cast<unsigned int>(part.points.size()), 1, dim)
    , w(u)
    , contact(setup.contact, setup.step)
    , top(setup.top, setup.step, top_boundary.points.size())
    , sides(setup.step)
    , stepper(op, c.held, setup.step, u, w)
  {
    std::set<unsigned int> others;
    for (const unsigned int side : {0, 1})
      for (const unsigned int p : c.side(side).points)
        others.insert(p);
    for (const auto *boundary : {&contact_boundary, &top_boundary})
      for (const unsigned int p : boundary->points)
        others.erase(p);
    const std::vector<unsigned int> side_points(others.begin(), others.end());
    add(c.mesh, contact_boundary.points, contact);
    add(c.mesh, top_boundary.points, top);
    add(c.mesh, side_points, sides);
  }

  /** Sets u and w, what is held as well. */
  void set(const Field<dim> &displacement, const Field<dim> &velocity)
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (std::size_t i = 0; i < part.points.size(); ++i)
        {
          u.row(c, 0)[i] = displacement(part.points[i], c);
          w.row(c, 0)[i] = velocity(part.points[i], c);
        }
  }

  void run(const unsigned int n_steps)
  {
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        stepper.advance(1);
        slipping = slipping && contact.sums().slipping == contact_boundary.points.size();
      }
  }

  /** Every node slipped all the time. */
  bool slipping = true;

private:
  const MeshPart<dim> part;
  const MeshOperator<dim> op;
  const MeshBoundary contact_boundary, top_boundary;

public:
  const SlidingSetup setup;

private:
  NodalField<double> u, w;
  ContactSurface<dim> contact;
  TopSurface<dim> top;
  FreeSurface<dim> sides;
  std::vector<std::unique_ptr<PeriodicSurface<dim>>> surfaces;
  MeshStepper<dim> stepper;

  /** The place in @p points of the other copy of each of them. */
  static std::vector<std::size_t> partners(const Mesh<dim> &mesh,
                                           const std::vector<unsigned int> &points)
  {
    double length = 0.;
    for (const auto &p : mesh.points)
      length = std::max(length, p[0]);
    std::vector<std::size_t> found(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        found[i]               = i;
        dealii::Point<dim> due = mesh.points[points[i]];
        if (due[0] > 1e-9 * length && due[0] < (1. - 1e-9) * length)
          continue;
        due[0] = due[0] < 0.5 * length ? length : 0.;
        for (std::size_t j = 0; j < points.size(); ++j)
          if (mesh.points[points[j]].distance(due) < 1e-9 * length)
            found[i] = j;
      }
    return found;
  }

  SlidingSetup completed(const MeshCase<dim> &c, const double share) const
  {
    SlidingSetup s = c.setup;
    s.contact.friction_coefficient.assign(contact_boundary.points.size(), c.friction);
    const std::vector<std::size_t> other = partners(c.mesh, top_boundary.points);
    s.top.tributary                      = top_boundary.area;
    for (std::size_t i = 0; i < other.size(); ++i)
      if (other[i] != i)
        s.top.tributary[i] += top_boundary.area[other[i]];
    s.step.dt =
      share * critical_time_step(largest_frequency(op).upper, s.step.beta2, s.step.beta);
    return s;
  }

  void add(const Mesh<dim> &mesh,
           const std::vector<unsigned int> &points,
           SurfaceCondition<dim> &condition)
  {
    surfaces.push_back(
      std::make_unique<PeriodicSurface<dim>>(condition, partners(mesh, points)));
    stepper.add_surface(SharedNodes(points, part), *surfaces.back());
  }

public:
  /** The sum over the lowest points, each once, of a component of u times @p weight. */
  template <typename Weight>
  auto sum_below(const unsigned int component, const Weight &weight) const
  {
    decltype(weight(part.points[0])) sum = 0.;
    const std::set<unsigned int> below(contact_boundary.points.begin(),
                                       contact_boundary.points.end());
    for (std::size_t i = 0; i < part.points.size(); ++i)
      if (below.count(part.point_in_mesh[i]) > 0 && part.points[i][0] > 1e-12)
        sum += u.row(component, 0)[i] * weight(part.points[i]);
    return sum;
  }
};

/**
 * The circular frequency and growth of a real signal that is one wave Re(c exp(s t)):
 * samples follow q(n + 1) = a q(n) + b q(n - 1), with a and b by least squares.
 */
inline Complex rate_of(const std::vector<double> &q, const double interval)
{
  double m11 = 0., m12 = 0., m22 = 0., r1 = 0., r2 = 0.;
  for (std::size_t n = 1; n + 1 < q.size(); ++n)
    {
      m11 += q[n] * q[n];
      m12 += q[n] * q[n - 1];
      m22 += q[n - 1] * q[n - 1];
      r1 += q[n + 1] * q[n];
      r2 += q[n + 1] * q[n - 1];
    }
  const double det = m11 * m22 - m12 * m12, a = (r1 * m22 - r2 * m12) / det,
               b = (m11 * r2 - m12 * r1) / det;
  return std::log(0.5 * a + std::sqrt(Complex(0.25 * a * a + b))) / interval;
}
} // namespace sliding_layer
} // namespace verification

#endif
