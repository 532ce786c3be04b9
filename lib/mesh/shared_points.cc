#include "mesh/shared_points.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace mesoslip
{
namespace
{
constexpr int tag = 73;

template <int dim>
void copy_terms(const double *field,
                const std::vector<unsigned int> &points,
                const unsigned int stride,
                std::vector<double> &terms)
{
  for (std::size_t k = 0; k < points.size(); ++k)
    std::copy_n(field + std::size_t(points[k]) * stride, dim, &terms[k * dim]);
}
} // namespace

template <int dim>
SharedPoints<dim>::SharedPoints(const MeshPart<dim> &part,
                                const unsigned int stride,
                                const MPI_Comm communicator)
  : neighbours(part.neighbours)
  , copies(part.copies)
  , stride(stride)
  , communicator(communicator)
  , rank(mpi::this_mpi_process(communicator))
{
  for (const auto &neighbour : neighbours)
    {
      points.insert(points.end(), neighbour.points.begin(), neighbour.points.end());
      sent.emplace_back(neighbour.points.size() * dim);
    }
  received = sent;
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  own.resize(points.size() * dim);
}

template <int dim>
SharedPoints<dim>::~SharedPoints()
{
  for (MPI_Request &request : receiving)
    MPI_Cancel(&request);
  wait_for_all(receiving);
  wait_for_all(sending);
}

template <int dim>
void SharedPoints<dim>::start(double *field)
{
  Assert(receiving.empty(),
         dealii::ExcMessage("terms were sent whose sum is not formed"));
  wait_for_all(sending);
  for (const auto &[copy, first] : copies)
    for (unsigned int c = 0; c < dim; ++c)
      field[std::size_t(first) * stride + c] += field[std::size_t(copy) * stride + c];
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    {
      const int count = static_cast<int>(sent[k].size());
      const int other = static_cast<int>(neighbours[k].rank);
      copy_terms<dim>(field, neighbours[k].points, stride, sent[k]);
      MPI_Irecv(received[k].data(), count, MPI_DOUBLE, other, tag, communicator,
                &receiving.emplace_back());
      MPI_Isend(sent[k].data(), count, MPI_DOUBLE, other, tag, communicator,
                &sending.emplace_back());
    }
}

template <int dim>
void SharedPoints<dim>::finish(double *field)
{
  AssertDimension(receiving.size(), neighbours.size());
  wait_for_all(receiving);
  copy_terms<dim>(field, points, stride, own);
  for (const unsigned int p : points)
    std::fill_n(field + std::size_t(p) * stride, dim, 0.);
  const auto add = [&](const std::vector<unsigned int> &where,
                       const std::vector<double> &terms) {
    for (std::size_t k = 0; k < where.size(); ++k)
      for (unsigned int c = 0; c < dim; ++c)
        field[std::size_t(where[k]) * stride + c] += terms[k * dim + c];
  };
  bool own_added = false;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    {
      if (!own_added && neighbours[k].rank > rank)
        {
          add(points, own);
          own_added = true;
        }
      add(neighbours[k].points, received[k]);
    }
  if (!own_added)
    add(points, own);
  for (const auto &[copy, first] : copies)
    std::copy_n(field + std::size_t(first) * stride, dim,
                field + std::size_t(copy) * stride);
}

template class SharedPoints<2>;
template class SharedPoints<3>;
} // namespace mesoslip
