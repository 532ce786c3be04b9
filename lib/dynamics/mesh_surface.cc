#include "dynamics/mesh_surface.h"

namespace mesoslip
{
template <int dim>
MeshSurface<dim>::MeshSurface(
  const SharedNodes &nodes,
  const std::function<double(unsigned int, unsigned int)> &inverse_mass_of,
  SurfaceCondition<dim> &condition,
  const MPI_Comm communicator)
  : condition(condition)
  , n_owned(nodes.n_owned())
  , u(NodalField<double>::of_points(nodes.size(), dim))
  , w(u)
  , force(u)
  , inverse_mass(u)
{
  for (unsigned int i = 0; i < nodes.size(); ++i)
    if (nodes.point(i) != SharedNodes::none)
      {
        point.push_back(nodes.point(i));
        place.push_back(i);
        for (unsigned int c = 0; c < dim; ++c)
          inverse_mass.row(c, 0)[i] = inverse_mass_of(nodes.point(i), c);
      }
  own_inverse_mass = inverse_mass;
  view.n           = u.n_columns();
  for (unsigned int c = 0; c < dim; ++c)
    {
      view.u[c]            = u.row(c, 0);
      view.w[c]            = w.row(c, 0);
      view.force[c]        = force.row(c, 0);
      view.inverse_mass[c] = inverse_mass.row(c, 0);
    }
  if (!condition.wants_total_force())
    return;
  MPI_Comm_split(communicator, point.empty() ? MPI_UNDEFINED : 0, 0, &ranks);
  int n_ranks = 0;
  if (ranks != MPI_COMM_NULL)
    MPI_Comm_size(ranks, &n_ranks);
  of_ranks.resize(static_cast<std::size_t>(n_ranks) * dim);
}

template <int dim>
MeshSurface<dim>::~MeshSurface()
{
  // Needed after an exception.
  if (request != MPI_REQUEST_NULL)
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  if (ranks != MPI_COMM_NULL)
    MPI_Comm_free(&ranks);
}

template <int dim>
void MeshSurface<dim>::load(const NodalField<double> &u_of_part,
                            const NodalField<double> &w_of_part)
{
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t k = 0; k < point.size(); ++k)
      {
        u.row(c, 0)[place[k]] = u_of_part.row(c, 0)[point[k]];
        w.row(c, 0)[place[k]] = w_of_part.row(c, 0)[point[k]];
      }
}

template <int dim>
void MeshSurface<dim>::add_guest(const unsigned int i,
                                 SideSurface<dim> &side,
                                 const unsigned int k)
{
  guests.push_back({&side, k, i});
  for (unsigned int c = 0; c < dim; ++c)
    if (double &inverse = inverse_mass.row(c, 0)[i]; inverse > 0.)
      inverse = 1. / (1. / inverse + side.guest_mass(k, c, 1. / inverse));
}

template <int dim>
void MeshSurface<dim>::start_loads(const std::uint64_t step, const double time)
{
  view.step = step;
  view.time = time;
  std::array<double *, dim> forces;
  for (unsigned int c = 0; c < dim; ++c)
    forces[c] = force.row(c, 0);
  for (const Guest &guest : guests)
    guest.side->add_force(guest.k, view, guest.i, forces);
  if (ranks != MPI_COMM_NULL)
    start_sum();
}

template <int dim>
void MeshSurface<dim>::start_from_motion(const std::uint64_t step,
                                         const double time,
                                         const NodalField<double> &w_of_part,
                                         const double dt)
{
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t k = 0; k < point.size(); ++k)
      {
        const double inverse = own_inverse_mass.row(c, 0)[place[k]];
        force.row(c, 0)[place[k]] =
          inverse > 0.
            ? (w.row(c, 0)[place[k]] - w_of_part.row(c, 0)[point[k]]) / (dt * inverse)
            : 0.;
      }
  start_loads(step, time);
}

// Sends the sums to all ranks, so that all ranks add the same numbers in the same order.
template <int dim>
void MeshSurface<dim>::start_sum()
{
  for (unsigned int c = 0; c < dim; ++c)
    own_force[c] = sum_of(force.row(c, 0), n_owned);
  MPI_Iallgather(own_force.data(), dim, MPI_DOUBLE, of_ranks.data(), dim, MPI_DOUBLE,
                 ranks, &request);
}

template <int dim>
void MeshSurface<dim>::finish(NodalField<double> &u_of_part,
                              NodalField<double> &w_of_part)
{
  if (ranks != MPI_COMM_NULL)
    {
      MPI_Wait(&request, MPI_STATUS_IGNORE);
      total_force.fill(0.);
      for (std::size_t k = 0; k < of_ranks.size(); ++k)
        total_force[k % dim] += of_ranks[k];
      view.total_force = total_force.data();
    }
  condition.advance(view);
  for (const Guest &guest : guests)
    guest.side->account(guest.k, view, guest.i);
  for (unsigned int c = 0; c < dim; ++c)
    for (std::size_t k = 0; k < point.size(); ++k)
      {
        u_of_part.row(c, 0)[point[k]] = u.row(c, 0)[place[k]];
        w_of_part.row(c, 0)[point[k]] = w.row(c, 0)[place[k]];
      }
}

template class MeshSurface<2>;
template class MeshSurface<3>;
} // namespace mesoslip
