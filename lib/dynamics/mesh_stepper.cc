#include "dynamics/mesh_stepper.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
template <int dim>
constexpr unsigned int stride = kernels::node_stride<dim>;

template <int dim>
kernels::NodeArrays node_arrays(NodalField<double> &u,
                                NodalField<double> &w,
                                const NodalField<double> &inverse_mass,
                                const double *mass,
                                LineVector<double> &z,
                                LineVector<double> &force)
{
  kernels::NodeArrays a = {};
  a.n                   = u.n_columns();
  for (unsigned int c = 0; c < dim; ++c)
    {
      a.u[c]            = u.row(c, 0);
      a.w[c]            = w.row(c, 0);
      a.inverse_mass[c] = inverse_mass.row(c, 0);
    }
  a.mass  = mass;
  a.z     = z.data();
  a.force = force.data();
  return a;
}

/** @p Kx = K @p x. */
template <int dim>
void multiply_with(const MeshOperator<dim> &op,
                   NodalField<double> &Kx,
                   const NodalField<double> &x)
{
  LineVector<double> in = op.zero_field(), out = in;
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < x.n_columns(); ++i)
      in[i * stride<dim> + c] = x.row(c, 0)[i];
  op.add_product(out.data(), in.data());
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < x.n_columns(); ++i)
      Kx.row(c, 0)[i] = out[i * stride<dim> + c];
}

/** Phase damping with an operator for phases_of_damping(). */
template <int dim>
std::unique_ptr<PhaseDamping>
damping_by(const std::shared_ptr<const MeshOperator<dim>> &op,
           const StepParameters &parameters,
           const NodalField<double> &u)
{
  return damping_of_points(
    parameters, op->lumped_mass(),
    [op](NodalField<double> &Kw, const NodalField<double> &w) {
      multiply_with(*op, Kw, w);
    },
    u);
}
} // namespace

template <int dim>
MeshStepper<dim>::MeshStepper(const MeshOperator<dim> &op,
                              const std::vector<HeldComponent> &held,
                              const StepParameters &parameters,
                              NodalField<double> &u,
                              NodalField<double> &w,
                              const std::shared_ptr<const MeshOperator<dim>> &damping)
  : SurfaceStepper<dim>(parameters,
                        u,
                        w,
                        op.part,
                        op.communicator,
                        damping ? damping_by(damping, parameters, u) : nullptr)
  , op(op)
  , inverse_mass(u.zeros_alike())
  , own_mass(NodalField<double>::of_points(u.n_columns(), 1))
  , z(op.zero_field())
  , force(z)
  , arrays(node_arrays<dim>(u,
                            w,
                            inverse_mass,
                            parameters.acts_on_mass() ? own_mass.row(0, 0) : nullptr,
                            z,
                            force))
{
  const std::vector<unsigned int> &in_mesh = op.part.point_in_mesh;
  for (std::size_t i = 0; i < in_mesh.size(); ++i)
    {
      const double mass     = op.lumped_mass()[i];
      own_mass.row(0, 0)[i] = i < op.part.n_distinct ? mass : 0.;
      const double inertia  = this->inertia_of({static_cast<unsigned int>(i), 0}, mass);
      for (unsigned int c = 0; c < dim; ++c)
        inverse_mass.row(c, 0)[i] = 1. / inertia;
    }
  const PointIndex index(op.part, points_of(held));
  for (const HeldComponent &h : held)
    for (const unsigned int i : index.find(h.point))
      inverse_mass.row(h.component, 0)[i] = 0.;
}

template <int dim>
MeshSurface<dim> &MeshStepper<dim>::add_surface(const SharedNodes &nodes,
                                                SurfaceCondition<dim> &condition)
{
  surfaces.push_back(std::make_unique<MeshSurface<dim>>(
    nodes,
    [this](const unsigned int i, const unsigned int c) {
      return inverse_mass.row(c, 0)[i];
    },
    condition, communicator));
  return *surfaces.back();
}

template <int dim>
void MeshStepper<dim>::advance(const std::uint64_t n_steps)
{
  load_state();
  for (std::uint64_t k = 0; k < n_steps; ++k)
    step_once();
}

/** Reads u and w, which may have changed since the last step: a step of zero length. */
template <int dim>
void MeshStepper<dim>::load_state()
{
  std::fill(force.begin(), force.end(), 0.);
  op.advance(arrays, node_step(0., 0., 0.));
  for (const auto &surface : surfaces)
    surface->load(u, w);
}

template <int dim>
kernels::NodeStep
MeshStepper<dim>::node_step(const double dt, const double c_new, const double c_old) const
{
  const auto &g = parameters.acceleration;
  return {dt,
          c_new,
          c_old,
          parameters.common_beta(),
          parameters.common_alpha(),
          {g[0], g[1], g[2]}};
}

template <int dim>
void MeshStepper<dim>::step_once()
{
  const double dt = parameters.dt, beta2 = parameters.beta2,
               time = static_cast<double>(n_done) * dt;
  op.add_product(force.data(), z.data());
  if (this->by_phase)
    add_damping();
  for (const auto &surface : surfaces)
    {
      const std::vector<unsigned int> &points = surface->points();
      surface->start(n_done, time, [&](const std::size_t k, const unsigned int c) {
        return force[std::size_t{points[k]} * stride<dim> + c];
      });
    }
  op.advance(arrays, node_step(dt, dt * (beta2 + 0.5), -dt * (beta2 - 0.5)));
  for (const auto &surface : surfaces)
    {
      surface->finish(u, w);
      for (const unsigned int i : surface->points())
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double velocity  = w.row(c, 0)[i];
            z[i * stride<dim> + c] = u.row(c, 0)[i] + parameters.common_beta() * velocity;
            if (parameters.common_alpha() > 0.)
              force[i * stride<dim> + c] =
                (parameters.common_alpha() * velocity - parameters.acceleration[c]) *
                own_mass.row(0, 0)[i];
          }
    }
  ++n_done;
}

/**
 * Adds the forces C w; at shared points they are already summed, like the forces of the
 * product.
 */
template <int dim>
void MeshStepper<dim>::add_damping()
{
  this->by_phase->start_step(w);
  const NodalField<double> &damping = this->by_phase->force();
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t i = 0; i < arrays.n; ++i)
      force[i * stride<dim> + c] += damping.row(c, 0)[i];
}

template <int dim>
void MeshStepper<dim>::multiply(NodalField<double> &Kx, NodalField<double> &x) const
{
  multiply_with(op, Kx, x);
}

template <int dim>
double MeshStepper<dim>::elastic_energy() const
{
  NodalField<double> Ku = u.zeros_alike();
  multiply(Ku, u);
  double sum = 0.;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int i = 0; i < n_distinct; ++i)
      sum += u.row(c, 0)[i] * Ku.row(c, 0)[i];
  return 0.5 * sum;
}

template <int dim>
void MeshStepper<dim>::mass_row(const unsigned int, double *mass) const
{
  std::copy(op.lumped_mass().begin(), op.lumped_mass().end(), mass);
}

template <int dim>
Deformation MeshStepper<dim>::deformation() const
{
  return largest_deformation(op.part.points, op.part.cells, op.part.cell_in_mesh, u,
                             communicator);
}

template <int dim>
std::string MeshStepper<dim>::kernel_name() const
{
  return op.kernel_name();
}

template class MeshStepper<2>;
template class MeshStepper<3>;
} // namespace mesoslip
