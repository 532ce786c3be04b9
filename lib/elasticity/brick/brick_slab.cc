#include "elasticity/brick/brick_slab.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "grid/cell_planes.h"
#include "grid/nodal_field.h"

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
/** Layers of cells across y of this rank. */
PlaneRange own_layers(const BrickBox &box, const MPI_Comm communicator)
{
  const unsigned int n_layers = box.grid.cells[1],
                     n_ranks  = mpi::n_mpi_processes(communicator);
  if (n_ranks > n_layers)
    throw UserError("the body has " + std::to_string(n_layers) +
                    " layers of cells along y, which are divided among the processes; "
                    "start at most as many, not " +
                    std::to_string(n_ranks));
  return own_planes(n_layers, communicator);
}

/** Phases of the cells of a rank, see BrickSlab. @throws exceptions of @p phases */
CellIndices phases_of_slab(const BrickSlab &slab, const CellReader &phases)
{
  const auto &n = slab.box.grid.cells;
  CellIndices phase((std::size_t{slab.n_planes} + 1) * n[2] * slab.stride, slab.none);
  const unsigned int end = slab.n_planes + (slab.has_layer(true) ? 1 : 0);
  unsigned int layer     = slab.has_layer(false) ? 0 : 1;
  while (layer < end)
    {
      // Contiguous layers, up to the end of the period.
      const unsigned int j     = (slab.first_plane + layer + n[1] - 1) % n[1],
                         after = std::min(end, layer + n[1] - j);
      const auto copy          = [&](const CellBlock<3> &block) {
        const std::vector<std::uint16_t> read = phases(block);
        auto next                             = read.begin();
        for (unsigned int k = block.first[2]; k < block.first[2] + block.cells[2]; ++k)
          for (std::size_t l = layer; l < after; ++l)
            for (unsigned int i = 0; i < n[0]; ++i)
              phase.set((l * n[2] + k) * slab.stride + i, *next++);
      };
      for_each_piece(CellBlock<3>{{{0, j, 0}}, {{n[0], after - layer, n[2]}}}, copy);
      layer = after;
    }
  return phase;
}

/** Sizes of the slab with these layers of cells; phases and part remain empty. */
BrickSlab extents_of_slab(const BrickBox &box,
                          const PlaneRange &layers,
                          const unsigned int n_phases)
{
  BrickSlab slab;
  slab.box         = box;
  slab.first_plane = layers.first;
  slab.n_planes    = layers.count + 1;
  slab.n_nodes = {{box.grid.cells[0] + (box.periodic[0] ? 0 : 1), box.grid.cells[2] + 1}};
  slab.stride  = whole_vectors<double>(slab.n_nodes[0] + 2);
  slab.none    = n_phases;
  return slab;
}

/** Builds the points and cells of a slab. */
class SlabPart
{
public:
  explicit SlabPart(BrickSlab &slab)
    : slab(slab)
    , part(slab.part)
    , grid(slab.box.grid)
    , columns(grid.cells[0] + 1)
    , n_copies(slab.box.periodic[0] ? slab.n_nodes[1] : 0)
  {
    slab.plane_start.resize(slab.n_planes);
    copy_start.resize(slab.n_planes);
  }

  void make(const std::vector<unsigned int> &cells)
  {
    const unsigned int last = slab.n_planes - 1, begin = slab.first_plane > 0 ? 1 : 0;
    const bool repeats = slab.box.periodic[1] && slab.first_plane + last == grid.cells[1];
    const unsigned int end      = repeats ? last : last + 1;
    const std::size_t n_columns = slab.n_nodes[0],
                      n_points = (n_columns * slab.n_nodes[1] + n_copies) * slab.n_planes;
    part.points.reserve(n_points);
    part.point_in_mesh.reserve(n_points);
    part.master_in_mesh.reserve(n_points);
    for (unsigned int p = begin; p < end; ++p)
      add_plane(p);
    part.n_distinct = static_cast<unsigned int>(part.points.size());
    if (repeats)
      add_plane(last);
    for (unsigned int p = begin; p <= last; ++p)
      add_copies(p);
    part.n_owned = static_cast<unsigned int>(part.points.size());
    if (begin > 0)
      {
        add_plane(0);
        add_copies(0);
      }
    part.copies = PointIndex::copies_in(part);
    for (const unsigned int cell : cells)
      add_cell(cell);
  }

private:
  void add_point(const unsigned int i, const unsigned int plane, const unsigned int k)
  {
    const unsigned int j = slab.first_plane + plane;
    const auto number    = [&](const unsigned int x, const unsigned int y) {
      return (k * (grid.cells[1] + 1) + y) * columns + x;
    };
    part.points.emplace_back(grid.origin[0] + i * grid.spacing[0],
                             grid.origin[1] + j * grid.spacing[1],
                             grid.origin[2] + k * grid.spacing[2]);
    part.point_in_mesh.push_back(number(i, j));
    part.master_in_mesh.push_back(
      number(slab.box.periodic[0] && i == grid.cells[0] ? 0 : i,
             slab.box.periodic[1] && j == grid.cells[1] ? 0 : j));
  }

  void add_plane(const unsigned int plane)
  {
    slab.plane_start[plane] = part.points.size();
    for (unsigned int k = 0; k < slab.n_nodes[1]; ++k)
      for (unsigned int i = 0; i < slab.n_nodes[0]; ++i)
        add_point(i, plane, k);
  }

  /** Adds the last nodes of rows, periodic copies in a box periodic in x. */
  void add_copies(const unsigned int plane)
  {
    copy_start[plane] = part.points.size();
    for (unsigned int k = 0; k < n_copies; ++k)
      add_point(grid.cells[0], plane, k);
  }

  unsigned int
  point(const unsigned int i, const unsigned int plane, const unsigned int k) const
  {
    return static_cast<unsigned int>(
      i < slab.n_nodes[0] ? slab.plane_start[plane] + std::size_t{k} * slab.n_nodes[0] + i
                          : copy_start[plane] + k);
  }

  void add_cell(const unsigned int number)
  {
    const auto &n        = grid.cells;
    const unsigned int i = number % n[0], j = number / n[0] % n[1],
                       k = number / n[0] / n[1];
    if (j < slab.first_plane || j + 1 >= slab.first_plane + slab.n_planes)
      return;
    const unsigned int layer = j - slab.first_plane;
    auto &cell               = part.cells.emplace_back(8);
    for (unsigned int v = 0; v < 8; ++v)
      cell.vertices[v] = point(i + (v & 1U), layer + (v >> 1U & 1U), k + (v >> 2U));
    cell.material_id =
      slab.phase[((layer + std::size_t{1}) * n[2] + k) * slab.stride + i];
    part.cell_in_mesh.push_back(number);
  }

  BrickSlab &slab;
  MeshPart<3> &part;
  const UniformGrid<3> &grid;
  const unsigned int columns;
  const unsigned int n_copies;
  std::vector<std::size_t> copy_start; ///< first periodic copy of each plane
};
} // namespace

std::array<unsigned int, 3> BrickSlab::place_of(const unsigned int point) const
{
  const unsigned int number = part.point_in_mesh[point], columns = box.grid.cells[0] + 1,
                     rows = box.grid.cells[1] + 1, i = number % columns;
  return {{i < n_nodes[0] ? i : 0, number / columns / rows,
           number / columns % rows - first_plane}};
}

BrickSlab divide_box(const BrickBox &box,
                     const CellReader &phases,
                     const unsigned int n_phases,
                     const MPI_Comm communicator,
                     const std::vector<unsigned int> &cells)
{
  BrickSlab slab = extents_of_slab(box, own_layers(box, communicator), n_phases);
  on_all_ranks(communicator, [&]() { slab.phase = phases_of_slab(slab, phases); });
  SlabPart(slab).make(cells);
  return slab;
}
} // namespace mesoslip
