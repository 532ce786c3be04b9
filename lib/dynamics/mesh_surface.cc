#include "dynamics/mesh_surface.h"

#include <deal.II/base/mpi.h>

#include <numeric>
#include <unordered_map>

namespace mesoslip
{
template <int dim>
MeshSurface<dim>::MeshSurface(const std::vector<unsigned int> &points,
                              const MeshPart<dim> &part,
                              const NodalField<double> &inverse_mass_of_part,
                              SurfaceCondition<dim> &condition,
                              const MPI_Comm communicator)
  : condition(condition)
  , communicator(communicator)
  , u(static_cast<unsigned int>(points.size()), 1, dim)
  , w(u)
  , force(u)
  , inverse_mass(u)
{
  std::unordered_map<unsigned int, unsigned int> place_of;
  for (unsigned int k = 0; k < points.size(); ++k)
    place_of[points[k]] = k;
  std::vector<unsigned int> own_places;
  for (unsigned int i = 0; i < part.points.size(); ++i)
    {
      const auto found = place_of.find(part.point_in_mesh[i]);
      if (found == place_of.end())
        continue;
      local.push_back(i);
      place.push_back(found->second);
      if (i < part.n_owned)
        own_places.push_back(found->second);
    }
  n_owned = own_places.size();
  for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, own_places))
    {
      offsets.push_back(static_cast<int>(places.size() * dim));
      counts.push_back(static_cast<int>(of_rank.size() * dim));
      places.insert(places.end(), of_rank.begin(), of_rank.end());
    }
  AssertDimension(places.size(), points.size());
  sent.resize(n_owned * dim);
  received.resize(places.size() * dim);
  gather([&](const unsigned int c,
             const unsigned int i) { return inverse_mass_of_part.row(c, 0)[i]; },
         inverse_mass);
}

template <int dim>
template <typename Value>
void MeshSurface<dim>::gather(const Value &of_node, NodalField<double> &result)
{
  for (std::size_t k = 0; k < n_owned; ++k)
    for (unsigned int c = 0; c < dim; ++c)
      sent[k * dim + c] = of_node(c, local[k]);
  start_gathering();
  finish_gathering(result);
}

template <int dim>
void MeshSurface<dim>::start_gathering()
{
  MPI_Iallgatherv(sent.data(), static_cast<int>(sent.size()), MPI_DOUBLE, received.data(),
                  counts.data(), offsets.data(), MPI_DOUBLE, communicator, &request);
}

template <int dim>
void MeshSurface<dim>::finish_gathering(NodalField<double> &result)
{
  MPI_Wait(&request, MPI_STATUS_IGNORE);
  for (std::size_t k = 0; k < places.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      result.row(c, 0)[places[k]] = received[k * dim + c];
}

template <int dim>
void MeshSurface<dim>::load(const NodalField<double> &u_of_part,
                            const NodalField<double> &w_of_part)
{
  gather(
    [&](const unsigned int c, const unsigned int i) { return u_of_part.row(c, 0)[i]; },
    u);
  gather(
    [&](const unsigned int c, const unsigned int i) { return w_of_part.row(c, 0)[i]; },
    w);
}

template <int dim>
void MeshSurface<dim>::start(const double *force_of_part, const unsigned int stride)
{
  for (std::size_t k = 0; k < n_owned; ++k)
    for (unsigned int c = 0; c < dim; ++c)
      sent[k * dim + c] = force_of_part[std::size_t(local[k]) * stride + c];
  start_gathering();
}

template <int dim>
void MeshSurface<dim>::finish(const std::uint64_t step,
                              const double time,
                              NodalField<double> &u_of_part,
                              NodalField<double> &w_of_part)
{
  finish_gathering(force);
  SurfaceView<dim> view;
  view.n = u.n_columns();
  for (unsigned int c = 0; c < dim; ++c)
    {
      view.u[c]            = u.row(c, 0);
      view.w[c]            = w.row(c, 0);
      view.force[c]        = force.row(c, 0);
      view.inverse_mass[c] = inverse_mass.row(c, 0);
    }
  view.step = step;
  view.time = time;
  condition.advance(view);
  for (std::size_t k = 0; k < local.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      {
        u_of_part.row(c, 0)[local[k]] = u.row(c, 0)[place[k]];
        w_of_part.row(c, 0)[local[k]] = w.row(c, 0)[place[k]];
      }
}

template class MeshSurface<2>;
template class MeshSurface<3>;
} // namespace mesoslip
