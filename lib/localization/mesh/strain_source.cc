#include "localization/mesh/strain_source.h"

#include "base/exchange.h"
#include "mesh/cell_gradients.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mesoslip
{
namespace
{
/** Some cells of a body, points and cells in its order. */
template <int dim>
struct Neighbourhood
{
  Mesh<dim> mesh;
  std::vector<unsigned int> points; ///< in the body
  std::vector<unsigned int> wanted; ///< cells of mesh

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &mesh.points &mesh.cells &points &wanted;
  }
};

/** Those of the cells @p wanted, and of two layers around them: what CellStrain looks at. */
template <int dim>
Neighbourhood<dim> neighbourhood(const Mesh<dim> &body,
                                 const std::vector<unsigned int> &wanted)
{
  std::vector<bool> is_near(body.cells.size(), false), touched(body.points.size());
  for (const unsigned int k : wanted)
    is_near[k] = true;
  for (unsigned int layer = 0; layer < 2; ++layer)
    {
      for (std::size_t k = 0; k < is_near.size(); ++k)
        for (const unsigned int v : body.cells[k].vertices)
          touched[v] = touched[v] || is_near[k];
      for (std::size_t k = 0; k < is_near.size(); ++k)
        for (const unsigned int v : body.cells[k].vertices)
          is_near[k] = is_near[k] || touched[v];
    }
  for (std::size_t k = 0; k < is_near.size(); ++k)
    for (const unsigned int v : body.cells[k].vertices)
      touched[v] = touched[v] || is_near[k];
  Neighbourhood<dim> part;
  for (unsigned int p = 0; p < touched.size(); ++p)
    if (touched[p])
      {
        part.points.push_back(p);
        part.mesh.points.push_back(body.points[p]);
      }
  auto next = wanted.begin();
  for (unsigned int k = 0; k < is_near.size(); ++k)
    if (is_near[k])
      {
        if (next != wanted.end() && *next == k)
          {
            part.wanted.push_back(static_cast<unsigned int>(part.mesh.cells.size()));
            ++next;
          }
        part.mesh.cells.push_back(body.cells[k]);
        for (unsigned int &v : part.mesh.cells.back().vertices)
          v = static_cast<unsigned int>(
            std::lower_bound(part.points.begin(), part.points.end(), v) -
            part.points.begin());
      }
  return part;
}

/** Whether each place is the centroid of its cell, which is cell @p number [k] of the mesh. */
template <int dim>
bool are_centroids(const std::vector<dealii::Point<dim>> &places,
                   const std::vector<std::size_t> &number,
                   const Neighbourhood<dim> &own)
{
  for (std::size_t k = 0; k < places.size(); ++k)
    {
      const CellMeasure<dim> cell =
        cell_measure(own.mesh, own.mesh.cells[own.wanted[number[k]]].vertices);
      if (!(places[k].distance(cell.centroid) <= 1e-9 * std::pow(cell.volume, 1. / dim)))
        return false;
    }
  return true;
}

/** The bytes of the displacement of @p points, dim numbers each. */
template <int dim>
std::string displacement_of(const std::vector<unsigned int> &points,
                            const std::vector<double> &u)
{
  constexpr std::size_t size = dim * sizeof(double);
  std::string bytes(points.size() * size, '\0');
  for (std::size_t i = 0; i < points.size(); ++i)
    std::memcpy(&bytes[i * size], &u[std::size_t{points[i]} * dim], size);
  return bytes;
}
} // namespace

template <int dim>
StrainSource<dim>::StrainSource(const Mesh<dim> &of_root,
                                const PlacesInCells<dim> &given,
                                const MPI_Comm the_communicator)
  : communicator(the_communicator)
  , places(given.at)
{
  namespace mpi                    = dealii::Utilities::MPI;
  const bool is_root               = mpi::this_mpi_process(communicator) == 0;
  std::vector<unsigned int> wanted = given.cell;
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const unsigned int cell : given.cell)
    wanted_cell.push_back(std::lower_bound(wanted.begin(), wanted.end(), cell) -
                          wanted.begin());
  const auto wanted_of_rank = mpi::gather(communicator, wanted);
  points_of_rank.resize(wanted_of_rank.size());
  const auto make = [&](const unsigned int rank) {
    Neighbourhood<dim> part = neighbourhood(of_root, wanted_of_rank[rank]);
    points_of_rank[rank]    = part.points;
    return part;
  };
  const std::string message = scatter(
    communicator, [&](const unsigned int rank) { return save_state(make(rank)); });
  Neighbourhood<dim> own;
  if (is_root)
    own = make(0);
  else
    load_state(message, own, "the cells around the places of this process");
  strain = std::make_unique<CellStrain<dim>>(own.mesh, own.wanted,
                                             are_centroids(places, wanted_cell, own));
  displacement.resize(own.points.size() * dim);
  if (is_root)
    mean_of_body = std::make_unique<MeanStrain<dim>>(of_root);
}

template <int dim>
void StrainSource<dim>::set_displacement(const std::vector<double> &u)
{
  std::vector<std::string> parts;
  for (const std::vector<unsigned int> &points : points_of_rank)
    parts.push_back(displacement_of<dim>(points, u));
  if (mean_of_body)
    mean_strain = (*mean_of_body)(u);
  const std::string part = scatter(communicator, parts);
  std::memcpy(displacement.data(), part.data(), part.size());
  dealii::Utilities::MPI::broadcast(
    mean_strain.data(), static_cast<std::size_t>(mean_strain.size()), 0, communicator);
  strain->set_displacement(displacement);
}

template class StrainSource<2>;
template class StrainSource<3>;
} // namespace mesoslip
