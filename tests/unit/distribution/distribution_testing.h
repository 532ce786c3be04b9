#ifndef mesoslip_tests_unit_distribution_testing_h
#define mesoslip_tests_unit_distribution_testing_h

#include "base/exchange.h"
#include "mesh/mesh_part.h"
#include "mesh_of_triangulation.h"

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <vector>

namespace distribution_testing
{
using namespace mesoslip;

constexpr unsigned int n_edge = 16; // cells along an edge of the cube

/** A cube of 16^dim cells of size 1. */
template <int dim>
Mesh<dim> cube()
{
  dealii::Triangulation<dim> tria;
  dealii::GridGenerator::subdivided_hyper_cube(tria, n_edge, 0., n_edge);
  Mesh<dim> mesh;
  take_cells(mesh, tria);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    mesh.cells[k].material_id = k % 5;
  return mesh;
}

template <int dim>
MeshPart<dim> part_of(const Mesh<dim> &mesh)
{
  const bool is_root = mpi::this_mpi_process(MPI_COMM_WORLD) == 0;
  const auto ranks = is_root ? partition_cells(mesh, mpi::n_mpi_processes(MPI_COMM_WORLD))
                             : std::vector<unsigned int>();
  return distribute(is_root ? mesh : Mesh<dim>(), ranks, MPI_COMM_WORLD);
}

} // namespace distribution_testing

#endif
