#include "base/object_exchange.h"
#include "localization/strain/cell_strain.h"
#include "localization/strain/read_ahead.h"
#include "localization/strain/strain_source.h"
#include "mesh/cell_shapes.h"
#include "mesh/point_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mesoslip
{
namespace
{
/** Some cells of a body, points and cells in its order. */
template <int dim>
struct Neighbourhood
{
  Mesh<dim> mesh;
  std::vector<unsigned int> points; ///< numbers in the body
  std::vector<unsigned int> wanted; ///< cells of mesh

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &mesh.points &mesh.cells &points &wanted;
  }
};

/** The cells @p wanted with two layers around them, as CellStrain needs them. */
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

template <int dim>
class MeshSource : public StrainSource<dim>
{
public:
  MeshSource(const BodySnapshots<dim> &of_run,
             const Mesh<dim> &of_root,
             const StrainPlaces<dim> &given,
             const std::vector<unsigned int> &cells,
             const MPI_Comm the_communicator)
    : run(of_run)
    , asked(given)
    , communicator(the_communicator)
    , places(given.middles)
    , buffer(given.n_in_row)
  {
    places.insert(places.end(), given.points.begin(), given.points.end());
    std::vector<unsigned int> wanted = cells;
    std::sort(wanted.begin(), wanted.end());
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    for (const unsigned int cell : cells)
      wanted_cell.push_back(std::lower_bound(wanted.begin(), wanted.end(), cell) -
                            wanted.begin());
    const Neighbourhood<dim> own = distribute(of_root, wanted);
    strain                       = std::make_unique<CellStrain<dim>>(own.mesh, own.wanted,
                                               are_centroids(places, wanted_cell, own));
    points =
      std::make_unique<NumbersFromBlocks>(own.points, run.n_points(), communicator);
    if (asked.mean)
      distribute_mean(of_root);
    ahead.emplace(asked.snapshots, 1, [this](const IndexRange &range) {
      return run.displacement(range.first, points->first(), points->size());
    });
  }

  std::size_t next() override
  {
    if (ahead->n_next() == 0)
      return 0;
    std::vector<double> u;
    on_all_ranks(communicator, [&]() { u = ahead->next(); });
    mean_strain.setZero();
    if (asked.mean)
      in_order_of_ranks(
        mean_strain.data(), n_voigt<dim>, [&]() { mean_of_block.add(u, mean_strain); },
        communicator);
    strain->set_displacement(points->bring(u, dim));
    return 1;
  }

  CellRow row(const std::size_t, const std::size_t j) override
  {
    const std::size_t first = j * asked.n_in_row;
    return buffer.fill(std::min(asked.n_in_row, asked.n_cells - first),
                       [&](const std::size_t i) { return at(first + i); });
  }

  VoigtVector<dim> at_point(const std::size_t, const std::size_t p) const override
  {
    return at(asked.middles.size() + p);
  }

  const VoigtVector<dim> &mean(const std::size_t) const override
  {
    return mean_strain;
  }

private:
  VoigtVector<dim> at(const std::size_t k) const
  {
    return strain->at(wanted_cell[k], places[k]);
  }

  /** The part of this rank around the cells that it wants. */
  Neighbourhood<dim> distribute(const Mesh<dim> &of_root,
                                const std::vector<unsigned int> &wanted)
  {
    const auto wanted_of_rank = mpi::gather(wanted, communicator);
    return scatter_objects(communicator, [&](const unsigned int rank) {
      return neighbourhood(of_root, wanted_of_rank[rank]);
    });
  }

  /** Distributes the contributions of each rank's block of points to the mean strain. */
  void distribute_mean(const Mesh<dim> &of_root)
  {
    const std::vector<std::size_t> own = {points->first(), points->size()};
    const auto blocks                  = mpi::gather(own, communicator);
    const MeanStrain<dim> whole =
      blocks.empty() ? MeanStrain<dim>() : MeanStrain<dim>(of_root);
    mean_of_block = scatter_objects(communicator, [&](const unsigned int rank) {
      return whole.part(blocks[rank][0], blocks[rank][1]);
    });
  }

  const BodySnapshots<dim> &run;
  const StrainPlaces<dim> &asked;
  const MPI_Comm communicator;
  std::vector<dealii::Point<dim>> places; ///< centroids, then points
  std::vector<std::size_t> wanted_cell;   ///< index in CellStrain
  StrainRowBuffer<dim> buffer;

  std::unique_ptr<CellStrain<dim>> strain;
  std::unique_ptr<const NumbersFromBlocks> points; ///< exchanges points around places
  MeanStrain<dim> mean_of_block; ///< contribution of the points that this rank reads
  VoigtVector<dim> mean_strain = VoigtVector<dim>::Zero(); ///< of this snapshot
  std::optional<ReadAhead<std::vector<double>>> ahead;     ///< uses the members above
};
} // namespace

template <int dim>
std::unique_ptr<StrainSource<dim>> make_mesh_source(const BodySnapshots<dim> &run,
                                                    const Mesh<dim> &of_root,
                                                    const StrainPlaces<dim> &places,
                                                    const std::vector<unsigned int> &cell,
                                                    const MPI_Comm communicator)
{
  return std::make_unique<MeshSource<dim>>(run, of_root, places, cell, communicator);
}

template std::unique_ptr<StrainSource<2>>
make_mesh_source(const BodySnapshots<2> &,
                 const Mesh<2> &,
                 const StrainPlaces<2> &,
                 const std::vector<unsigned int> &,
                 const MPI_Comm);
template std::unique_ptr<StrainSource<3>>
make_mesh_source(const BodySnapshots<3> &,
                 const Mesh<3> &,
                 const StrainPlaces<3> &,
                 const std::vector<unsigned int> &,
                 const MPI_Comm);
} // namespace mesoslip
