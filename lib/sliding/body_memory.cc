#include "sliding/body_memory.h"

#include "base/exchange.h"
#include "program/output_folder.h"
#include "sliding/complex/complex_cases.h"
#include "sliding/run_plan.h"
#include "statics/voxel/planes.h"

#include <algorithm>
#include <utility>

namespace mesoslip
{
namespace
{
/** Per corner of a cell of a mesh in memory, including its share of the point. */
constexpr double bytes_of_corner = 30.;

/** Bytes per cell with @p n_corners in time steps, including the mesh. */
template <int dim>
double bytes_of_stepped_cell(const std::size_t n_corners)
{
  if (n_corners == dim + 1)
    return dim == 2 ? 380. : 320.;
  return dim == 2 ? 610. : 970.;
}

/** Additional bytes per cell with damping by phase. */
template <int dim>
double bytes_of_damped_cell(const ContactParameters &parameters,
                            const std::size_t n_corners)
{
  if (!parameters.step.damps_by_phase())
    return 0.;
  return n_corners == dim + 1 ? 60. : dim == 2 ? 360. : 270.;
}

/** Per component of a snapshot in the write buffer. */
constexpr double bytes_of_shown_dof = 35.;

/** Memory of statics, modes and complex modes for @p n_nodes nodes of a mesh (with ML) or
 * of a box. */
template <int dim>
BodyMemory of_static_body(const ContactParameters &parameters,
                          const double n_nodes,
                          const double bytes_of_mesh,
                          const bool ml)
{
  if (parameters.analysis == ContactAnalysis::complex_modes)
    return {0., 0., complex_modes_memory(dim * n_nodes, dim)};
  return {bytes_of_mesh, static_node_memory(parameters, dim, ml) * n_nodes, 0.};
}

double bytes_of_snapshots(const ContactParameters &parameters, const double n_dofs)
{
  return parameters.observation.snapshots_interval > 0. ? bytes_of_shown_dof * n_dofs
                                                        : 0.;
}
} // namespace

std::string BodyMemory::text(const unsigned int n_ranks) const
{
  const double other      = on_other_rank(n_ranks);
  const std::string first = bytes_text(on_rank_0 + other) + " of memory";
  return n_ranks == 1 ? first
                      : first + " on rank 0, " + bytes_text(other) + " on each other";
}

template <int dim>
BodyMemory memory_on_mesh(const ContactParameters &parameters, const Mesh<dim> &mesh)
{
  double corners = 0., steps = 0.;
  for (const auto &cell : mesh.cells)
    {
      corners += static_cast<double>(cell.vertices.size());
      steps += bytes_of_stepped_cell<dim>(cell.vertices.size()) +
               bytes_of_damped_cell<dim>(parameters, cell.vertices.size());
    }
  const double read = bytes_of_corner * corners;
  const auto points = static_cast<double>(mesh.points.size());
  if (parameters.analysis != ContactAnalysis::transient)
    return of_static_body<dim>(parameters, points, read, true);
  return {read, steps - read + bytes_of_snapshots(parameters, dim * points), 0.};
}

BodyMemory memory_of_box(const ContactParameters &parameters, const UniformGrid<3> &grid)
{
  constexpr double bytes_of_corners = 8. * bytes_of_corner;
  const double bytes_of_brick       = parameters.step.damps_by_phase() ? 390. : 330.;
  const auto cells                  = static_cast<double>(grid.n_cells());
  double nodes = 1., inside = 1.;
  for (const unsigned int n : grid.cells)
    {
      nodes *= n + 1.;
      inside *= std::max(n, 2U) - 2.;
    }
  const double bytes_at_sides = bytes_of_corners * (cells - inside);
  if (parameters.analysis != ContactAnalysis::transient)
    {
      BodyMemory memory = of_static_body<3>(parameters, nodes, bytes_at_sides, false);
      if (!voxel::is_divided_among(grid.cells[2] + std::size_t{1},
                                   mpi::n_mpi_processes(MPI_COMM_WORLD)))
        std::swap(memory.divided, memory.on_each);
      return memory;
    }
  return {bytes_at_sides,
          bytes_of_brick * cells + bytes_of_snapshots(parameters, 3. * nodes), 0.};
}

template BodyMemory memory_on_mesh(const ContactParameters &, const Mesh<2> &);
template BodyMemory memory_on_mesh(const ContactParameters &, const Mesh<3> &);
} // namespace mesoslip
