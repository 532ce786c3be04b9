#include "base/exchange.h"
#include "localization/strain/cell_set.h"
#include "localization/strain/grid_interpolation.h"
#include "localization/strain/grid_strain.h"
#include "localization/strain/read_ahead.h"
#include "localization/strain/side_integrals.h"
#include "localization/strain/strain_source.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
/** Stencil radius of the slope fit, in cells. */
constexpr unsigned int n_layers = 2;

/** Bytes of a batch of snapshots (as many more are being read), and largest useful number
 * of snapshots. */
constexpr std::size_t batch_bytes = 16 << 20;
constexpr std::size_t max_batch   = 4;

/** Number of snapshots per batch; one has @p bytes. */
std::size_t batch_size(const std::size_t bytes)
{
  return std::clamp<std::size_t>(batch_bytes / std::max<std::size_t>(bytes, 1), 1,
                                 max_batch);
}

/** The cell that holds @p place, which lies in the body up to round-off. */
template <int dim>
std::array<unsigned int, dim> cell_around(const UniformGrid<dim> &body,
                                          const dealii::Point<dim> &place)
{
  const auto cell = cell_at(body, place);
  AssertThrow(cell, dealii::ExcMessage("a place has to lie in the body"));
  return *cell;
}

template <int dim>
std::size_t n_nodes(const CellBlock<dim> &block)
{
  return block.n_cells() == 0 ? 0 : UniformGrid<dim>{block.cells, {}, {}}.n_nodes();
}

/** Displacements of blocks of nodes in some snapshots, [snapshot][node][dim]. */
struct BlockSnapshots
{
  std::vector<double> of_rank;                ///< around the cells of this rank
  std::vector<std::vector<double>> of_points; ///< around each point
};

/**
 * Reads whole layers of the body (around the cells of this rank, and for its share of
 * the mean strain) and a block around each point. Strains are interpolated to the cells
 * of a grid; at other centroids GridStrain gives the strain.
 */
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
    , buffer(places.n_in_row)
  {
    on_all_ranks(communicator, [this]() { find_blocks(); });
    const std::size_t largest =
      mpi::max(sizeof(double) * dim * n_nodes(block), communicator);
    // There is only one GridStrain, for one snapshot; all ranks read the same number of
    // snapshots.
    const bool any_middles  = mpi::max(places.middles.empty() ? 0 : 1, communicator) > 0;
    const std::size_t batch = any_middles ? 1 : batch_size(largest);
    if (places.grid != nullptr && places.n_cells > 0)
      interpolations.assign(batch, {run.grid, *places.grid, block});
    else if (!places.middles.empty())
      prepare_middles();
    ahead = std::make_unique<ReadAhead<BlockSnapshots>>(
      places.snapshots, batch, [this](const IndexRange &range) { return read(range); });
  }

  std::size_t next() override
  {
    const std::size_t n = ahead->n_next();
    if (n == 0)
      return 0;
    now = {}; // frees memory for the batch being read
    on_all_ranks(communicator, [this]() { now = ahead->next(); });
    const std::size_t size = now.of_rank.size() / n;
    for (std::size_t b = 0; b < n && !interpolations.empty(); ++b)
      interpolations[b].set_displacement(now.of_rank.data() + b * size);
    if (around_middles)
      around_middles->set_displacement(now.of_rank);
    at_points.resize(n);
    for (std::size_t b = 0; b < n; ++b)
      evaluate_points(b, n);
    if (places.mean)
      average(n, size);
    return n;
  }

  CellRow row(const std::size_t b, const std::size_t j) override
  {
    if (!interpolations.empty())
      return interpolations[b].row(places.first_layer * rows_in_layer() + j);
    const std::size_t first = j * places.n_in_row;
    return buffer.fill(std::min(places.n_in_row, places.n_cells - first),
                       [&](const std::size_t i) { return at_middle(first + i); });
  }

  VoigtVector<dim> at_point(const std::size_t b, const std::size_t p) const override
  {
    return at_points[b][p];
  }

  const VoigtVector<dim> &mean(const std::size_t b) const override
  {
    return means[b];
  }

private:
  /** The layers of this rank, and a block around each point. */
  void find_blocks()
  {
    block = layers_of_rank();
    for (const dealii::Point<dim> &point : places.points)
      {
        const auto cell = cell_around(run.grid, point);
        around_points.emplace_back(run.grid,
                                   block_around<dim>(run.grid, cell, cell, n_layers));
      }
  }

  std::size_t rows_in_layer() const
  {
    return dim == 3 ? places.grid->cells[1] : 1;
  }

  /** Finds the cells of the centroids for GridStrain. */
  void prepare_middles()
  {
    around_middles.emplace(run.grid, block);
    const double least =
      *std::min_element(run.grid.spacing.begin(), run.grid.spacing.end());
    for (const dealii::Point<dim> &place : places.middles)
      {
        const auto cell = cell_around(run.grid, place);
        cells.push_back(block.number_of(cell));
        at_middles =
          at_middles && place.distance(middle_of<dim>(run.grid, cell)) <= 1e-9 * least;
      }
  }

  VoigtVector<dim> at_middle(const std::size_t k) const
  {
    return at_middles ? around_middles->mean(cells[k])
                      : around_middles->at(cells[k], places.middles[k]);
  }

  /** First layer of the body whose sides rank @p rank adds to the mean. */
  unsigned int first_layer(const unsigned int rank) const
  {
    return static_cast<unsigned int>(std::uint64_t{rank} * run.grid.cells[dim - 1] /
                                     mpi::n_mpi_processes(communicator));
  }

  /** Layers of the body that the cells of this rank need. */
  std::array<unsigned int, 2> layers_of_cells() const
  {
    const unsigned int n = run.grid.cells[dim - 1];
    if (places.grid != nullptr && places.n_cells > 0)
      {
        const auto begin = static_cast<unsigned int>(places.first_layer);
        return StrainInterpolation<dim>::layers(
          run.grid, *places.grid, begin,
          begin +
            static_cast<unsigned int>(places.n_cells / places.grid->cells_in_layer()));
      }
    unsigned int begin = n, end = 0;
    for (const dealii::Point<dim> &place : places.middles)
      {
        const unsigned int layer = cell_around(run.grid, place)[dim - 1];
        begin = std::min(begin, layer > n_layers ? layer - n_layers : 0);
        end   = std::max(end, std::min(layer + n_layers + 1, n));
      }
    return {{begin, end}};
  }

  CellBlock<dim> layers_of_rank()
  {
    auto [begin, end]       = layers_of_cells();
    const unsigned int rank = mpi::this_mpi_process(communicator);
    own_layers              = {{first_layer(rank), first_layer(rank + 1)}};
    if (places.mean && own_layers[0] < own_layers[1])
      {
        begin = std::min(begin, own_layers[0]);
        end   = std::max(end, own_layers[1]);
      }
    CellBlock<dim> layers;
    if (begin >= end)
      return layers;
    layers.cells          = run.grid.cells;
    layers.first[dim - 1] = begin;
    layers.cells[dim - 1] = end - begin;
    return layers;
  }

  BlockSnapshots read(const IndexRange &range) const
  {
    BlockSnapshots some = {run.displacement(range, block), {}};
    for (const GridStrain<dim> &strain : around_points)
      some.of_points.push_back(run.displacement(range, strain.block()));
    return some;
  }

  /** Evaluates the points for snapshot @p b of @p n. */
  void evaluate_points(const std::size_t b, const std::size_t n)
  {
    at_points[b].clear();
    for (std::size_t p = 0; p < places.points.size(); ++p)
      {
        const auto &u           = now.of_points[p];
        const auto size         = static_cast<std::ptrdiff_t>(u.size() / n);
        const auto from         = u.begin() + static_cast<std::ptrdiff_t>(b) * size;
        GridStrain<dim> &strain = around_points[p];
        strain.set_displacement(std::vector<double>(from, from + size));
        const auto cell = cell_around(run.grid, places.points[p]);
        at_points[b].push_back(
          strain.at(strain.block().number_of(cell), places.points[p]));
      }
  }

  /** Averages @p n snapshots, of which this rank has @p size numbers each. */
  void average(const std::size_t n, const std::size_t size)
  {
    constexpr std::size_t n_sums = std::size_t{2} * dim * dim;
    std::vector<double> sums(n * n_sums);
    in_order_of_ranks(
      sums.data(), sums.size(),
      [&]() {
        for (std::size_t b = 0; b < n; ++b)
          add_side_integrals<dim>(run.grid, block, now.of_rank.data() + b * size,
                                  own_layers[0], own_layers[1], &sums[b * n_sums]);
      },
      communicator);
    means.clear();
    for (std::size_t b = 0; b < n; ++b)
      means.push_back(mean_strain<dim>(run.grid, &sums[b * n_sums]));
  }

  const BodySnapshots<dim> &run;
  const StrainPlaces<dim> &places;
  const MPI_Comm communicator;
  StrainRowBuffer<dim> buffer;
  std::array<unsigned int, 2> own_layers = {}; ///< layers of its share of the mean
  CellBlock<dim> block;                        ///< the layers that this rank reads

  std::vector<StrainInterpolation<dim>> interpolations; ///< to a grid, one per snapshot
  std::optional<GridStrain<dim>> around_middles;        ///< for a volume that is no grid
  std::vector<std::size_t> cells; ///< cells that hold the centroids, numbers in the block
  bool at_middles = true;         ///< whether these are the cell centroids

  std::vector<GridStrain<dim>> around_points;
  std::vector<std::vector<VoigtVector<dim>>> at_points; ///< for the current batch
  std::vector<VoigtVector<dim>> means;                  ///< for the current batch
  BlockSnapshots now;                                   ///< the current batch
  std::unique_ptr<ReadAhead<BlockSnapshots>> ahead;     ///< uses the members above
};
} // namespace

double bytes_of_displacements(const double of_snapshot, const std::size_t n_snapshots)
{
  const std::size_t batch = batch_size(static_cast<std::size_t>(of_snapshot));
  return of_snapshot * static_cast<double>(std::min(2 * batch, n_snapshots));
}

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
