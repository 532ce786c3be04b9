#include "base/errors.h"
#include "base/exchange.h"
#include "morphology/microstructure_parameters.h"
#include "morphology/voxel_reading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace mesoslip
{
namespace
{
using PlaneAction =
  std::function<void(const std::size_t z, const std::vector<double> &plane)>;

/** The planes of the region, [y][x] with all voxels of the file. */
void for_each_plane(VoxelFile &file, const VoxelRegion &region, const PlaneAction &action)
{
  for (std::size_t z = 0; z < region.size[2]; ++z)
    action(z, file.plane(region.from[2] + z));
}

/** Values that occur in the region; counting stops for grey pictures. */
std::set<double> values_in(VoxelFile &file, const VoxelRegion &region)
{
  constexpr std::size_t enough = 256;
  std::set<double> found;
  const std::size_t width = file.shape()[2];
  for_each_plane(file, region, [&](std::size_t, const std::vector<double> &plane) {
    for (std::size_t y = 0; y < region.size[1]; ++y)
      {
        const double *row = &plane[(region.from[1] + y) * width + region.from[0]];
        for (std::size_t x = 0; x < region.size[0] && found.size() <= enough; ++x)
          if (x == 0 || row[x] != row[x - 1])
            found.insert(row[x]);
      }
  });
  return found;
}

/** Values that occur in the regions of all ranks. */
std::set<double>
values_on_ranks(VoxelFile &file, const VoxelRegion &region, const MPI_Comm communicator)
{
  std::vector<double> own;
  on_all_ranks(communicator, [&]() {
    const std::set<double> values = values_in(file, region);
    own.assign(values.begin(), values.end());
  });
  std::set<double> found;
  for (const auto &values : mpi::all_gather(own, communicator))
    found.insert(values.begin(), values.end());
  return found;
}

/** The value of each phase: from the .prm, or the occurring values, ascending. */
std::vector<double> values_of_voxel_phases(const MicrostructureParameters &p,
                                           VoxelFile &file,
                                           const VoxelRegion &region,
                                           const MPI_Comm communicator)
{
  if (!p.image.values.empty())
    return {p.image.values.begin(), p.image.values.end()};
  const std::set<double> found = values_on_ranks(file, region, communicator);
  if (found.size() == p.phases.size())
    return {found.begin(), found.end()};
  std::vector<std::string> some;
  for (const double value : found)
    if (some.size() < 8)
      some.push_back(to_text(value));
  const std::string n =
    found.size() > 256 ? "more than 256" : std::to_string(found.size());
  throw UserError(
    p.file + " has " + n + " different value" + (found.size() == 1 ? "" : "s") + " (" +
    to_text(some) + (found.size() > some.size() ? ", ..." : "") +
    "), and Phases/Names has " + std::to_string(p.phases.size()) +
    "; name as many phases, or set Microstructure/Image values or Thresholds");
}

[[noreturn]] void refuse_value(const std::string &path,
                               const std::array<std::size_t, 3> &zyx,
                               const double value,
                               const bool thresholds)
{
  throw UserError(
    path + ": voxel [" + std::to_string(zyx[0]) + "][" + std::to_string(zyx[1]) + "][" +
    std::to_string(zyx[2]) + "] has the value " +
    (std::isfinite(value) ? to_text(value) : std::string("nan or infinity")) +
    (thresholds ? ", which no threshold sorts; save it with numbers only"
                : ", which is not among Microstructure/Image values; add it"));
}

/** Counts the voxels of each phase in a layer of cells, and selects the phases of the
 * cells. */
class CellVotes
{
public:
  CellVotes(const std::size_t n_cells, const std::size_t n_phases, const double voxels)
    : missing(n_phases, 0.)
    , counts(n_cells * n_phases, 0)
    , n(n_phases)
    , voxels_of_cell(voxels)
  {
  }

  /** Counts a voxel of @p phase in @p cell of the layer. */
  void add(const std::size_t cell, const unsigned int phase)
  {
    ++counts[cell * n + phase];
  }

  /** Appends the phases of the layer to @p id and begins the next one. */
  void close_layer(std::vector<std::uint8_t> &id)
  {
    for (auto cell = counts.begin(); cell != counts.end(); cell += static_cast<long>(n))
      {
        const long most    = *std::max_element(cell, cell + static_cast<long>(n));
        std::size_t chosen = n;
        for (std::size_t p = 0; p < n; ++p)
          {
            const long has = cell[static_cast<long>(p)];
            missing[p] += static_cast<double>(has);
            if (has == most && (chosen == n || missing[p] > missing[chosen]))
              chosen = p;
          }
        missing[chosen] -= voxels_of_cell;
        id.push_back(static_cast<std::uint8_t>(chosen));
      }
    std::fill(counts.begin(), counts.end(), 0);
  }

  /** Per phase: deficit of voxels over the cells so far. */
  std::vector<double> missing;

private:
  std::vector<unsigned int> counts; ///< [cell of the layer][phase]
  const std::size_t n;
  const double voxels_of_cell;
};

/** The part of @p region that is in the planes of cells of this rank. */
VoxelRegion own_region(VoxelRegion region,
                       const MicrostructureParameters &p,
                       const MPI_Comm communicator)
{
  const PlaneRange planes = own_planes(p.box.cells[2], communicator);
  const std::size_t edge  = p.voxels.coarsening;
  region.from[2] += edge * planes.first;
  region.size[2] = edge * planes.count;
  return region;
}

/** Lets the ranks @p read. If cells are majorities of voxels, the ranks read one after
 * the other, as the @p votes depend on all cells so far. Collective.
 * @throws exceptions of read() */
void read_on_ranks(const std::function<void()> &read,
                   CellVotes &votes,
                   const bool one_voxel_a_cell,
                   const MPI_Comm communicator)
{
  if (one_voxel_a_cell)
    return on_all_ranks(communicator, read);
  std::exception_ptr failure;
  const auto try_to_read = [&]() {
    try
      {
        read();
      }
    catch (...)
      {
        failure = std::current_exception();
      }
  };
  in_order_of_ranks(votes.missing.data(), votes.missing.size(), try_to_read,
                    communicator);
  on_all_ranks(communicator, [&]() {
    if (failure)
      std::rethrow_exception(failure);
  });
}
} // namespace

CellPhases read_cell_phases(const MicrostructureParameters &p,
                            VoxelFile &file,
                            const VoxelRegion &region,
                            const MPI_Comm communicator)
{
  const bool thresholds = !p.image.thresholds.empty();
  const VoxelRegion own = own_region(region, p, communicator);
  const PhaseOfValue phase_of(
    p.image.thresholds, thresholds ? std::vector<double>()
                                   : values_of_voxel_phases(p, file, own, communicator));
  const std::size_t edge = p.voxels.coarsening, width = file.shape()[2],
                    n_x = p.box.cells[0];
  CellPhases result;
  result.id.reserve(n_x * p.box.cells[1] * (own.size[2] / edge));
  result.fractions.assign(p.phases.size(), 0.);
  CellVotes votes(n_x * p.box.cells[1], p.phases.size(),
                  static_cast<double>(edge * edge * edge));
  const auto add_plane = [&](const std::size_t z, const std::vector<double> &plane) {
    for (std::size_t y = 0; y < own.size[1]; ++y)
      {
        const double *row  = &plane[(own.from[1] + y) * width + own.from[0]];
        double last        = row[0];
        unsigned int phase = phase_of(last);
        for (std::size_t x = 0; x < own.size[0]; ++x)
          {
            if (row[x] != last)
              phase = phase_of(last = row[x]);
            if (phase >= phase_of.end())
              refuse_value(p.file, {{own.from[2] + z, own.from[1] + y, own.from[0] + x}},
                           row[x], thresholds);
            result.fractions[phase] += 1.;
            votes.add(y / edge * n_x + x / edge, phase);
          }
      }
    if ((z + 1) % edge == 0)
      votes.close_layer(result.id);
  };
  read_on_ranks([&]() { for_each_plane(file, own, add_plane); }, votes, edge == 1,
                communicator);
  sum_over_ranks(result.fractions, communicator);
  for (double &fraction : result.fractions)
    fraction /= static_cast<double>(region.size[0] * region.size[1]) *
                static_cast<double>(region.size[2]);
  return result;
}
} // namespace mesoslip
