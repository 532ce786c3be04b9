#include "localization/mesh/strain_source.h"

#include "base/exchange.h"
#include "mesh/cell_gradients.h"

#include <algorithm>
#include <cmath>

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
} // namespace

template <int dim>
StrainSource<dim>::StrainSource(const std::string &path,
                                const Mesh<dim> &of_root,
                                const PlacesInCells<dim> &given,
                                const MPI_Comm the_communicator)
  : communicator(the_communicator)
  , run(path, communicator)
  , places(given.at)
  , rows(run.rows_of_points())
  , points(distribute_cells(of_root, given), rows[0] * rows[1], communicator, rows[1])
{
  distribute_mean(of_root);
}

/** Makes the strain in the cells of the places; the points of the body that it looks at. */
template <int dim>
std::vector<unsigned int>
StrainSource<dim>::distribute_cells(const Mesh<dim> &of_root,
                                    const PlacesInCells<dim> &given)
{
  namespace mpi                    = dealii::Utilities::MPI;
  std::vector<unsigned int> wanted = given.cell;
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const unsigned int cell : given.cell)
    wanted_cell.push_back(std::lower_bound(wanted.begin(), wanted.end(), cell) -
                          wanted.begin());
  const auto wanted_of_rank = mpi::gather(communicator, wanted);
  const std::string message = scatter(communicator, [&](const unsigned int rank) {
    return save_state(neighbourhood(of_root, wanted_of_rank[rank]));
  });
  Neighbourhood<dim> own;
  if (mpi::this_mpi_process(communicator) == 0)
    own = neighbourhood(of_root, wanted_of_rank[0]);
  else
    load_state(message, own, "the cells around the places of this process");
  strain = std::make_unique<CellStrain<dim>>(own.mesh, own.wanted,
                                             are_centroids(places, wanted_cell, own));
  return own.points;
}

template <int dim>
void StrainSource<dim>::distribute_mean(const Mesh<dim> &of_root)
{
  namespace mpi = dealii::Utilities::MPI;
  using Block   = std::array<std::size_t, 2>;
  const std::vector<Block> blocks =
    mpi::gather(communicator, Block{{points.first(), points.size()}});
  const MeanStrain<dim> whole =
    blocks.empty() ? MeanStrain<dim>() : MeanStrain<dim>(of_root);
  const std::string message = scatter(communicator, [&](const unsigned int rank) {
    return save_state(whole.part(blocks[rank][0], blocks[rank][1]));
  });
  if (mpi::this_mpi_process(communicator) == 0)
    mean_of_block = whole.part(0, points.size());
  else
    load_state(message, mean_of_block, "the message of another process");
}

template <int dim>
void StrainSource<dim>::set_snapshot(const std::size_t k)
{
  const std::vector<double> u =
    run.displacement(k, points.first() / rows[1], points.size() / rows[1]);
  mean_strain.setZero();
  in_order_of_ranks(
    mean_strain.data(), static_cast<std::size_t>(mean_strain.size()),
    [&]() { mean_of_block.add(u, mean_strain); }, communicator);
  strain->set_displacement(points.bring(u, dim));
}

template class StrainSource<2>;
template class StrainSource<3>;
} // namespace mesoslip
