#include "body/mesh/mesh_share.h"

#include "base/object_exchange.h"
#include "mesh/mesh_part.h"

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{

/** On rank 0: owning rank of each cell of the mesh. */
template <int dim>
std::vector<unsigned int> rank_of_cells(const Mesh<dim> &mesh,
                                        const DistributedMesh<dim> &distributed)
{
  std::vector<unsigned int> own;
  for (const auto &cell : distributed.dofs().active_cell_iterators())
    if (cell->is_locally_owned())
      own.push_back(static_cast<unsigned int>(cell->id().get_coarse_cell_id()));
  std::vector<unsigned int> ranks(mesh.cells.size(), 0);
  const auto all = mpi::gather(own, distributed.communicator());
  for (unsigned int rank = 0; rank < all.size(); ++rank)
    for (const unsigned int cell : all[rank])
      ranks[cell] = rank;
  return ranks;
}

/** Degrees of freedom of the points of @p part. */
template <int dim>
std::vector<dealii::types::global_dof_index>
dofs_of_part(const MeshPart<dim> &part, const DistributedMesh<dim> &distributed)
{
  std::vector<unsigned int> order(part.cells.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
    return part.cell_in_mesh[a] < part.cell_in_mesh[b];
  });
  std::vector<dealii::types::global_dof_index> dofs(dim * part.points.size());
  for (const auto &cell : distributed.dofs().active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const auto number   = cell->id().get_coarse_cell_id();
        const auto found    = std::lower_bound(order.begin(), order.end(), number,
                                               [&](const unsigned int k, const auto wanted) {
                                              return part.cell_in_mesh[k] < wanted;
                                            });
        const auto &corners = part.cells[*found].vertices;
        for (unsigned int v = 0; v < corners.size(); ++v)
          for (unsigned int c = 0; c < dim; ++c)
            dofs[dim * corners[v] + c] =
              cell->vertex_dof_index(v, c, cell->active_fe_index());
      }
  return dofs;
}
} // namespace

template <int dim>
MeshShare<dim> whole_share(const MeshBodyInput<dim> &given, const MPI_Comm communicator)
{
  MeshShare<dim> share;
  share.outline   = outline_of(given.mesh, given);
  share.all_ranks = std::make_unique<DistributedMesh<dim>>(given.mesh, communicator);
  share.mesh      = given.mesh;
  share.point_in_mesh.resize(given.mesh.points.size());
  std::iota(share.point_in_mesh.begin(), share.point_in_mesh.end(), 0U);
  share.cell_in_mesh.resize(given.mesh.cells.size());
  std::iota(share.cell_in_mesh.begin(), share.cell_in_mesh.end(), 0U);
  share.n_counted = share.n_owned = share.point_in_mesh.size();
  share.dofs   = share.all_ranks->dofs_of_points(given.mesh, share.point_in_mesh);
  share.copies = share.all_ranks->dofs_of_points(given.mesh, share.outline.copies);
  return share;
}

template <int dim>
MeshShare<dim> divided_share(const Mesh<dim> &mesh,
                             const MeshBodyInput<dim> &given,
                             const MPI_Comm communicator)
{
  MeshShare<dim> share;
  share.is_divided = true;
  on_root(communicator, [&]() { share.outline = outline_of(mesh, given); });
  broadcast_object(communicator, share.outline);
  share.all_ranks = std::make_unique<DistributedMesh<dim>>(mesh, communicator);
  share.copies    = share.all_ranks->dofs_of_points(mesh, share.outline.copies);
  MeshPart<dim> part =
    distribute(mesh, rank_of_cells(mesh, *share.all_ranks), communicator);
  const auto dofs = dofs_of_part(part, *share.all_ranks);
  // With mixed cell types, the owner of a degree of freedom may differ from the owner of
  // the point in MeshPart.
  const dealii::IndexSet &owned = share.all_ranks->dofs().locally_owned_dofs();
  const auto kind               = [&](const unsigned int i) {
    const bool is_master = part.master_in_mesh[i] == part.point_in_mesh[i];
    return owned.is_element(dofs[dim * i]) ? (is_master ? 0 : 1) : 2;
  };
  std::vector<unsigned int> order(part.points.size()), place(order.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(
    order.begin(), order.end(),
    [&](const unsigned int a, const unsigned int b) { return kind(a) < kind(b); });
  for (const unsigned int i : order)
    {
      place[i] = static_cast<unsigned int>(share.mesh.points.size());
      share.mesh.points.push_back(part.points[i]);
      share.point_in_mesh.push_back(part.point_in_mesh[i]);
      share.dofs.insert(share.dofs.end(), dofs.begin() + dim * i,
                        dofs.begin() + dim * (i + 1));
      share.n_counted += kind(i) == 0 ? 1 : 0;
      share.n_owned += kind(i) < 2 ? 1 : 0;
    }
  share.mesh.cells   = std::move(part.cells);
  share.cell_in_mesh = std::move(part.cell_in_mesh);
  for (auto &cell : share.mesh.cells)
    for (unsigned int &v : cell.vertices)
      v = place[v];
  return share;
}

#define MESOSLIP_INSTANTIATE(dim)                                                      \
  template MeshShare<dim> whole_share(const MeshBodyInput<dim> &, const MPI_Comm);     \
  template MeshShare<dim> divided_share(const Mesh<dim> &, const MeshBodyInput<dim> &, \
                                        const MPI_Comm);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
