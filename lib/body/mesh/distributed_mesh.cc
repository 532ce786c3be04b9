#include "body/mesh/distributed_mesh.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "body/mesh/curved_mapping.h"
#include "mesh/triangulation_cells.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_tools.h>

#include <unordered_map>

namespace mesoslip
{
namespace
{
/** On rank 0: a cell and the index of one of its corners for each point. */
template <int dim>
std::vector<std::array<unsigned int, 2>>
find_corners(const Mesh<dim> &mesh, const std::vector<unsigned int> &points)
{
  using Corner = std::array<unsigned int, 2>;
  std::unordered_map<unsigned int, Corner> corner_of;
  for (const unsigned int p : points)
    corner_of[p] = Corner();
  for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
    for (unsigned int v = 0; v < mesh.cells[cell].vertices.size(); ++v)
      {
        const auto found = corner_of.find(mesh.cells[cell].vertices[v]);
        if (found != corner_of.end())
          found->second = {{cell, v}};
      }
  std::vector<Corner> corners;
  for (const unsigned int p : points)
    corners.push_back(corner_of[p]);
  return corners;
}
} // namespace

template <int dim>
DistributedMesh<dim>::DistributedMesh(const Mesh<dim> &mesh,
                                      const MPI_Comm communicator,
                                      const unsigned int degree)
  : ranks(communicator)
  , triangulation(communicator)
  , elements(dealii::FESystem<dim>(dealii::FE_Q<dim>(degree), dim),
             dealii::FESystem<dim>(dealii::FE_SimplexP<dim>(degree), dim))
  , mappings(mappings_of(mesh, communicator, degree))
  , quadratures(dealii::QGauss<dim>(degree + 1), dealii::QGaussSimplex<dim>(degree + 1))
  , dof_handler(triangulation)
{
  using namespace dealii;
  const unsigned int n_ranks = mpi::n_mpi_processes(communicator);
  const auto create          = [&mesh](Triangulation<dim> &serial) {
    serial.create_triangulation(mesh.points, to_dealii<dim>(mesh.cells), SubCellData());
  };
  const auto divide = [n_ranks](Triangulation<dim> &serial, MPI_Comm, unsigned int) {
    GridTools::partition_triangulation(n_ranks, serial,
                                       SparsityTools::Partitioner::metis);
  };
  triangulation.create_triangulation(
    TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<
      dim, dim>(create, divide, communicator, n_ranks));
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_active_fe_index(cell->reference_cell().is_simplex() ? 1 : 0);
  dof_handler.distribute_dofs(elements);
  relevant_dofs = DoFTools::extract_locally_relevant_dofs(dof_handler);
}

template <int dim>
std::vector<typename DistributedMesh<dim>::Index>
DistributedMesh<dim>::dofs_of_points(const Mesh<dim> &mesh,
                                     const std::vector<unsigned int> &points) const
{
  const auto corners = mpi::broadcast(find_corners(mesh, points), 0, communicator());
  std::unordered_map<unsigned int, std::vector<std::size_t>> of_cell;
  for (std::size_t k = 0; k < corners.size(); ++k)
    of_cell[corners[k][0]].push_back(k);
  std::vector<Index> known(dim * corners.size(), 0), result(known.size());
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const auto found = of_cell.find(cell->id().get_coarse_cell_id());
        if (found != of_cell.end())
          for (const std::size_t k : found->second)
            for (unsigned int c = 0; c < dim; ++c)
              known[dim * k + c] =
                cell->vertex_dof_index(corners[k][1], c, cell->active_fe_index());
      }
  dealii::Utilities::MPI::max(known, communicator(), result);
  return result;
}

namespace
{
/**
 * Clears @p constraints. @p used are the degrees of freedom for which this rank may have
 * lines, @p owned the locally owned ones.
 */
void reinit(dealii::AffineConstraints<double> &constraints,
            [[maybe_unused]] const dealii::IndexSet &owned,
            const dealii::IndexSet &used)
{
  constraints.clear();
#if DEAL_II_VERSION_GTE(9, 6, 0)
  constraints.reinit(owned, used);
#else
  constraints.reinit(used);
#endif
}
} // namespace

template <int dim>
void DistributedMesh<dim>::begin(dealii::AffineConstraints<double> &constraints) const
{
  reinit(constraints, dof_handler.locally_owned_dofs(), relevant_dofs);
}

template <int dim>
void DistributedMesh<dim>::require_cells() const
{
  const auto n_cells         = triangulation.n_global_active_cells();
  const unsigned int n_ranks = mpi::n_mpi_processes(communicator());
  if (n_cells < n_ranks)
    throw UserError("ml cannot divide a mesh of " + std::to_string(n_cells) +
                    " cells among " + std::to_string(n_ranks) +
                    " ranks; start at most as many ranks as there are cells");
}

std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
masters_of(const std::vector<std::array<dealii::types::global_dof_index, 2>> &copies)
{
  // Periodic copies of periodic copies (corners) are mapped to their final periodic
  // master.
  std::map<dealii::types::global_dof_index, dealii::types::global_dof_index> masters;
  for (auto pair = copies.rbegin(); pair != copies.rend(); ++pair)
    {
      const auto next     = masters.find((*pair)[1]);
      masters[(*pair)[0]] = next == masters.end() ? (*pair)[1] : next->second;
    }
  return masters;
}

void tie_copies(const std::vector<std::array<dealii::types::global_dof_index, 2>> &copies,
                const dealii::IndexSet &owned,
                const dealii::IndexSet &relevant,
                dealii::AffineConstraints<double> &constraints)
{
  const auto masters    = masters_of(copies);
  dealii::IndexSet used = relevant;
  for (const auto &[copy, master] : masters)
    if (relevant.is_element(copy))
      used.add_index(master);
  reinit(constraints, owned, used);
  for (const auto &[copy, master] : masters)
    if (relevant.is_element(copy))
      {
        constraints.add_line(copy);
        constraints.add_entry(copy, master, 1.);
      }
}

template class DistributedMesh<2>;
template class DistributedMesh<3>;
} // namespace mesoslip
