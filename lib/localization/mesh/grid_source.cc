#include "base/exchange.h"
#include "localization/mesh/cell_set.h"
#include "localization/mesh/grid_strain.h"
#include "localization/mesh/strain_source.h"

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
/** Layers around a cell whose means the slope in it is made of. */
constexpr unsigned int n_layers = 2;

/** The cell that holds @p place, which lies in the body as far as numbers can tell. */
template <int dim>
std::array<unsigned int, dim> cell_around(const UniformGrid<dim> &body,
                                          const dealii::Point<dim> &place)
{
  const auto cell = cell_at(body, place);
  AssertThrow(cell, dealii::ExcMessage("a place has to lie in the body"));
  return *cell;
}

/** Reads blocks of a grid: one around the middles of the cells of this rank, whole planes, and
 * one around each of the points. */
template <int dim>
class GridSource : public StrainSource<dim>
{
public:
  GridSource(const BodySnapshots<dim> &of_run,
             const StrainPlaces<dim> &given,
             const MPI_Comm the_communicator)
    : run(of_run)
    , places(given)
    , communicator(the_communicator)
  {
    bool own_middles = false;
    on_all_ranks(communicator, [&]() { own_middles = are_middles(); });
    at_middles = dealii::Utilities::MPI::min(own_middles ? 1 : 0, communicator) == 1;
    on_all_ranks(communicator, [&]() { prepare(); });
  }

  void set_snapshot(const std::size_t k) override
  {
    on_all_ranks(communicator, [&]() {
      for (GridStrain<dim> &strain : strains)
        strain.set_displacement(run.displacement(k, strain.block()));
    });
    if (places.mean)
      average();
  }

  VoigtVector<dim> at(const std::size_t k) const override
  {
    if (at_middles && k < places.middles.size())
      return strains[0].mean(cells[k]);
    return strain_at(k).at(cells[k], places[k]);
  }

private:
  /** The blocks, and where the places lie in them. */
  void prepare()
  {
    strains.emplace_back(run.grid, block_of_rank());
    for (const dealii::Point<dim> &point : places.points)
      {
        const auto cell = cell_around(run.grid, point);
        strains.emplace_back(run.grid, block_around<dim>(run.grid, cell, cell, n_layers));
      }
    for (std::size_t k = 0; k < places.size(); ++k)
      cells.push_back(strain_at(k).block().number_of(cell_around(run.grid, places[k])));
  }

  bool are_middles() const
  {
    const double least =
      *std::min_element(run.grid.spacing.begin(), run.grid.spacing.end());
    return std::all_of(
      places.middles.begin(), places.middles.end(), [&](const dealii::Point<dim> &place) {
        const auto cell = cell_around(run.grid, place);
        return place.distance(middle_of<dim>(run.grid, cell)) <= 1e-9 * least;
      });
  }

  /** Planes of the body of which this rank takes the mean. */
  unsigned int first_plane(const unsigned int rank) const
  {
    return static_cast<unsigned int>(
      std::uint64_t{rank} * run.grid.cells[dim - 1] /
      dealii::Utilities::MPI::n_mpi_processes(communicator));
  }

  /** Planes around the middles, and those of the mean. */
  CellBlock<dim> block_of_rank()
  {
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    unsigned int begin = std::numeric_limits<unsigned int>::max(), end = 0;
    for (const dealii::Point<dim> &place : places.middles)
      {
        const unsigned int plane  = cell_around(run.grid, place)[dim - 1];
        const unsigned int layers = at_middles ? 0 : n_layers;
        begin                     = std::min(begin, plane > layers ? plane - layers : 0);
        end = std::max(end, std::min(plane + layers + 1, run.grid.cells[dim - 1]));
      }
    own_planes = {{first_plane(rank), first_plane(rank + 1)}};
    if (places.mean && own_planes[0] < own_planes[1])
      {
        begin = std::min(begin, own_planes[0]);
        end   = std::max(end, own_planes[1]);
      }
    CellBlock<dim> block;
    if (begin >= end)
      return block;
    block.cells          = run.grid.cells;
    block.first[dim - 1] = begin;
    block.cells[dim - 1] = end - begin;
    return block;
  }

  const GridStrain<dim> &strain_at(const std::size_t k) const
  {
    const std::size_t n = places.middles.size();
    return strains[k < n ? 0 : k - n + 1];
  }

  // Plane by plane, so that the sum does not depend on the number of ranks.
  void average()
  {
    const unsigned int n_planes = run.grid.cells[dim - 1];
    const std::size_t in_plane  = run.grid.n_cells() / n_planes;
    std::vector<double> sums(std::size_t{n_planes} * n_voigt<dim>);
    for (unsigned int plane = own_planes[0]; plane < own_planes[1]; ++plane)
      {
        Eigen::Map<VoigtVector<dim>> sum(&sums[std::size_t{plane} * n_voigt<dim>]);
        const std::size_t first = (plane - strains[0].block().first[dim - 1]) * in_plane;
        for (std::size_t k = first; k < first + in_plane; ++k)
          sum += strains[0].mean(k);
      }
    sum_over_ranks(sums, communicator);
    this->mean_strain.setZero();
    for (std::size_t k = 0; k < sums.size(); k += n_voigt<dim>)
      this->mean_strain += Eigen::Map<const VoigtVector<dim>>(&sums[k]);
    this->mean_strain /= static_cast<double>(run.grid.n_cells());
  }

  const BodySnapshots<dim> &run;
  const StrainPlaces<dim> &places;
  const MPI_Comm communicator;
  bool at_middles = false; ///< whether all middles are those of cells of the body
  std::array<unsigned int, 2> own_planes = {};
  std::vector<GridStrain<dim>> strains; ///< of the blocks
  std::vector<std::size_t> cells;       ///< of the places, numbers in their blocks
};
} // namespace

template <int dim>
std::unique_ptr<StrainSource<dim>> make_grid_source(const BodySnapshots<dim> &run,
                                                    const StrainPlaces<dim> &places,
                                                    const MPI_Comm communicator)
{
  return std::make_unique<GridSource<dim>>(run, places, communicator);
}

template std::unique_ptr<StrainSource<2>>
make_grid_source(const BodySnapshots<2> &, const StrainPlaces<2> &, const MPI_Comm);
template std::unique_ptr<StrainSource<3>>
make_grid_source(const BodySnapshots<3> &, const StrainPlaces<3> &, const MPI_Comm);
} // namespace mesoslip
