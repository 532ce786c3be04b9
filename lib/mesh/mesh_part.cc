#include "mesh/mesh_part.h"

#include "base/object_exchange.h"
#include "mesh/boundary.h"

#include <deal.II/base/utilities.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace mesoslip
{
namespace
{
constexpr unsigned int nobody = dealii::numbers::invalid_unsigned_int;

/** The cells sorted along a Hilbert curve. */
template <int dim>
std::vector<unsigned int> curve_order(const Mesh<dim> &mesh)
{
  constexpr int bits = 20;
  std::vector<dealii::Point<dim>> middles(mesh.cells.size());
  for (std::size_t k = 0; k < middles.size(); ++k)
    {
      const auto &vertices = mesh.cells[k].vertices;
      for (const unsigned int v : vertices)
        middles[k] += mesh.points[v] / static_cast<double>(vertices.size());
    }
  const auto place =
    dealii::Utilities::inverse_Hilbert_space_filling_curve<dim>(middles, bits);
  std::vector<unsigned int> order(mesh.cells.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(
    order.begin(), order.end(),
    [&](const unsigned int a, const unsigned int b) { return place[a] < place[b]; });
  return order;
}

/** (periodic master, rank with a cell at the master or one of its copies) */
using PointAndRank = std::pair<unsigned int, unsigned int>;

/** The pairs for all points of several ranks, in ascending order. */
template <int dim>
std::vector<PointAndRank>
ranks_of_shared_points(const Mesh<dim> &mesh,
                       const std::vector<unsigned int> &rank_of_cell)
{
  std::vector<unsigned int> first(mesh.points.size(), nobody);
  std::vector<bool> shared(mesh.points.size());
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    for (const unsigned int v : mesh.cells[k].vertices)
      {
        const unsigned int p = mesh.master(v);
        if (first[p] == nobody)
          first[p] = rank_of_cell[k];
        else if (first[p] != rank_of_cell[k])
          shared[p] = true;
      }
  std::vector<PointAndRank> ranks;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    for (const unsigned int v : mesh.cells[k].vertices)
      if (const unsigned int p = mesh.master(v); shared[p])
        ranks.emplace_back(p, rank_of_cell[k]);
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

/** Owner of each point of the mesh: the lowest rank with a cell at it. */
template <int dim>
std::vector<unsigned int> owners_of_points(const Mesh<dim> &mesh,
                                           const std::vector<unsigned int> &rank_of_cell)
{
  std::vector<unsigned int> owners(mesh.points.size(), nobody);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    for (const unsigned int p : mesh.cells[k].vertices)
      owners[p] = std::min(owners[p], rank_of_cell[k]);
  return owners;
}

/** Makes the parts of all ranks one by one; working memory is a list of all points. */
template <int dim>
class PartMaker
{
public:
  PartMaker(const Mesh<dim> &mesh, const std::vector<unsigned int> &rank_of_cell)
    : mesh(mesh)
    , rank_of_cell(rank_of_cell)
    , order(curve_order(mesh))
    , ranks(ranks_of_shared_points(mesh, rank_of_cell))
    , owners(owners_of_points(mesh, rank_of_cell))
    , local(mesh.points.size(), nobody)
  {
  }

  MeshPart<dim> make(const unsigned int rank)
  {
    MeshPart<dim> part;
    std::vector<unsigned int> own_copies, foreign;
    for (const unsigned int k : order)
      if (rank_of_cell[k] == rank)
        {
          part.cell_in_mesh.push_back(k);
          for (const unsigned int p : mesh.cells[k].vertices)
            if (local[p] == nobody)
              {
                local[p] = 0;
                (owners[p] != rank     ? foreign
                 : mesh.master(p) == p ? part.point_in_mesh
                                       : own_copies)
                  .push_back(p);
              }
        }
    std::vector<unsigned int> &points = part.point_in_mesh;
    part.n_distinct                   = static_cast<unsigned int>(points.size());
    points.insert(points.end(), own_copies.begin(), own_copies.end());
    part.n_owned = static_cast<unsigned int>(points.size());
    points.insert(points.end(), foreign.begin(), foreign.end());
    for (unsigned int i = 0; i < part.point_in_mesh.size(); ++i)
      {
        local[part.point_in_mesh[i]] = i;
        part.points.push_back(mesh.points[part.point_in_mesh[i]]);
        part.master_in_mesh.push_back(mesh.master(part.point_in_mesh[i]));
      }
    for (const unsigned int k : part.cell_in_mesh)
      {
        part.cells.push_back(mesh.cells[k]);
        for (unsigned int &v : part.cells.back().vertices)
          v = local[v];
      }
    find_neighbours(rank, part);
    for (const unsigned int p : part.point_in_mesh)
      local[p] = nobody;
    return part;
  }

private:
  void find_neighbours(const unsigned int rank, MeshPart<dim> &part) const
  {
    std::vector<std::pair<unsigned int, unsigned int>> in_order;
    for (const unsigned int p : part.point_in_mesh)
      in_order.emplace_back(mesh.master(p), local[p]);
    std::sort(in_order.begin(), in_order.end());
    std::map<unsigned int, std::vector<unsigned int>> shared;
    for (std::size_t k = 0, first = 0; k < in_order.size(); ++k)
      {
        const auto [master, point] = in_order[k];
        if (k > first && master == in_order[first].first)
          {
            part.copies.emplace_back(point, in_order[first].second);
            continue;
          }
        first = k;
        for (auto entry =
               std::lower_bound(ranks.begin(), ranks.end(), PointAndRank(master, 0U));
             entry != ranks.end() && entry->first == master; ++entry)
          if (entry->second != rank)
            shared[entry->second].push_back(point);
      }
    for (const auto &[other, points] : shared)
      part.neighbours.push_back({other, points});
  }

  const Mesh<dim> &mesh;
  const std::vector<unsigned int> &rank_of_cell;
  const std::vector<unsigned int> order;
  const std::vector<PointAndRank> ranks;
  const std::vector<unsigned int> owners;
  std::vector<unsigned int> local; ///< index in the part of each point of the mesh
};

/** Graph of cells that share a face, like GridTools::get_face_connectivity_of_cells(),
 * but without a Triangulation, which takes a kilobyte per hexahedron. */
template <int dim>
dealii::SparsityPattern graph_of_cells(const Mesh<dim> &mesh)
{
  const auto n     = static_cast<dealii::types::global_dof_index>(mesh.cells.size());
  const auto pairs = neighbouring_cells(mesh);
  std::vector<unsigned int> row_lengths(n, 1); // the diagonal
  for (const auto &[one, other] : pairs)
    {
      ++row_lengths[one];
      ++row_lengths[other];
    }
  dealii::SparsityPattern graph(n, n, row_lengths);
  for (const auto &[one, other] : pairs)
    {
      graph.add(one, other);
      graph.add(other, one);
    }
  graph.compress();
  return graph;
}
} // namespace

template <int dim>
PointIndex::PointIndex(const MeshPart<dim> &part,
                       const std::vector<unsigned int> &masters)
{
  std::vector<bool> is_wanted;
  for (const unsigned int master : masters)
    {
      if (master >= is_wanted.size())
        is_wanted.resize(master + std::size_t{1}, false);
      is_wanted[master] = true;
    }
  for (unsigned int i = 0; i < part.master_in_mesh.size(); ++i)
    if (const unsigned int master = part.master_in_mesh[i];
        master < is_wanted.size() && is_wanted[master])
      sorted.emplace_back(master, i);
  std::sort(sorted.begin(), sorted.end());
}

template <int dim>
std::vector<std::pair<unsigned int, unsigned int>>
PointIndex::copies_in(const MeshPart<dim> &part)
{
  std::vector<bool> is_there;
  std::vector<unsigned int> again;
  for (const unsigned int master : part.master_in_mesh)
    {
      if (master >= is_there.size())
        is_there.resize(2 * (master + std::size_t{1}), false);
      if (is_there[master])
        again.push_back(master);
      is_there[master] = true;
    }
  std::vector<std::pair<unsigned int, unsigned int>> pairs;
  const auto sorted = PointIndex(part, again).sorted;
  for (std::size_t k = 1, first = 0; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[first].first)
      pairs.emplace_back(sorted[k].second, sorted[first].second);
    else
      first = k;
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<unsigned int> PointIndex::find(const unsigned int master) const
{
  std::vector<unsigned int> points;
  for (auto found =
         std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(master, 0U));
       found != sorted.end() && found->first == master; ++found)
    points.push_back(found->second);
  return points;
}

template <int dim>
std::vector<unsigned int> partition_cells(const Mesh<dim> &mesh,
                                          const unsigned int n_ranks,
                                          const std::vector<unsigned int> &weights)
{
  using namespace dealii;
  std::vector<unsigned int> ranks(mesh.cells.size(), 0);
  if (n_ranks == 1)
    return ranks;
  SparsityTools::partition(graph_of_cells(mesh), weights, n_ranks, ranks,
                           SparsityTools::Partitioner::metis);
  return ranks;
}

template <int dim>
MeshPart<dim> distribute(const Mesh<dim> &mesh,
                         const std::vector<unsigned int> &rank_of_cell,
                         const MPI_Comm communicator)
{
  const unsigned int n_ranks = mpi::n_mpi_processes(communicator);
  const bool is_root         = mpi::this_mpi_process(communicator) == 0;
  if (n_ranks == 1)
    return PartMaker<dim>(mesh, rank_of_cell).make(0);
  std::optional<PartMaker<dim>> parts;
  if (is_root)
    parts.emplace(mesh, rank_of_cell);
  const std::string message = scatter(communicator, [&parts](const unsigned int rank) {
    return save_state(parts->make(rank));
  });
  if (is_root)
    return parts->make(0);
  MeshPart<dim> own;
  load_state(message, own, "the part of the mesh");
  return own;
}

#define MESOSLIP_INSTANTIATE(dim)                                                    \
  template struct MeshPart<dim>;                                                     \
  template PointIndex::PointIndex(const MeshPart<dim> &,                             \
                                  const std::vector<unsigned int> &);                \
  template std::vector<std::pair<unsigned int, unsigned int>> PointIndex::copies_in( \
    const MeshPart<dim> &);                                                          \
  template std::vector<unsigned int> partition_cells(                                \
    const Mesh<dim> &, const unsigned int, const std::vector<unsigned int> &);       \
  template MeshPart<dim> distribute(const Mesh<dim> &,                               \
                                    const std::vector<unsigned int> &, const MPI_Comm);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
