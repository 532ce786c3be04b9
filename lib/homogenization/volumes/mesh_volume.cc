#include "homogenization/volumes/mesh_volume.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "body/mesh/cell_values.h"
#include "body/mesh/conjugate_gradients.h"
#include "mesh/boundary.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>

namespace mesoslip
{
namespace
{
/** On rank 0 the points at which supports stop rigid motions, and their components. */
template <int dim>
std::vector<std::array<unsigned int, 2>> supported(const Mesh<dim> &mesh)
{
  const auto nearest = [&mesh](const dealii::Point<dim> &place) {
    return static_cast<unsigned int>(
      std::min_element(mesh.points.begin(), mesh.points.end(),
                       [&](const auto &a, const auto &b) {
                         return a.distance_square(place) < b.distance_square(place);
                       }) -
      mesh.points.begin());
  };
  const dealii::BoundingBox<dim> box(mesh.points);
  const dealii::Point<dim> origin = box.get_boundary_points().first;
  std::vector<std::array<unsigned int, 2>> result;
  for (unsigned int c = 0; c < dim; ++c)
    result.push_back({{nearest(origin), c}});
  for (unsigned int axis = 0; axis + 1 < dim; ++axis)
    {
      dealii::Point<dim> end = origin;
      end[axis] += box.side_length(axis);
      for (unsigned int c = axis + 1; c < dim; ++c)
        result.push_back({{nearest(end), c}});
    }
  return result;
}
} // namespace

template <int dim>
MeshVolume<dim>::MeshVolume(const Mesh<dim> &given,
                            const std::vector<ElasticPhase<dim>> &the_phases,
                            const MPI_Comm communicator)
  : phases(the_phases)
  , mesh(given, communicator)
  , is_apart(has_two_matrices(mesh, phases))
{
  mesh.require_cells();
  std::array<BoundaryPoints<dim>, 2UL * dim> points;
  std::vector<std::array<unsigned int, 2>> held;
  std::vector<unsigned int> upper, lower, held_points;
  const bool is_root = mpi::this_mpi_process(communicator) == 0;
  if (is_root)
    {
      const auto faces = faces_of_box(given, boundary_faces(given));
      for (unsigned int side = 0; side < 2 * dim; ++side)
        points[side] = boundary_points(given, faces[side]);
      held = supported(given);
      for (const auto &[point, component] : held)
        held_points.push_back(point);
      const double edge = cell_quality(given).smallest_edge;
      try
        {
          for (unsigned int axis = 0; axis < dim; ++axis)
            for (const auto &[p, opposite] :
                 opposite_points(given, faces[2 * axis], faces[2 * axis + 1], axis, edge)
                   .pairs)
              {
                upper.push_back(p);
                lower.push_back(opposite);
              }
        }
      catch (const UserError &e)
        {
          not_periodic = e.what();
        }
    }
  broadcast(communicator, not_periodic);
  for (unsigned int side = 0; side < 2 * dim; ++side)
    {
      sides[side].dofs = mesh.dofs_of_points(given, points[side].points);
      for (const dealii::Tensor<1, dim> &area : points[side].normal_area)
        {
          auto &components = sides[side].normal_area.emplace_back();
          for (unsigned int d = 0; d < dim; ++d)
            components[d] = area[d];
        }
      sides[side].normal_area = mpi::broadcast(sides[side].normal_area, 0, communicator);
    }
  held          = mpi::broadcast(held, 0, communicator);
  const auto at = mesh.dofs_of_points(given, held_points);
  for (std::size_t k = 0; k < held.size(); ++k)
    supports.push_back(at[dim * k + held[k][1]]);
  const auto upper_dofs = mesh.dofs_of_points(given, upper),
             lower_dofs = mesh.dofs_of_points(given, lower);
  for (std::size_t k = 0; k < upper_dofs.size(); ++k)
    duplicates.push_back({{upper_dofs[k], lower_dofs[k]}});
}

template <int dim>
void MeshVolume<dim>::set_constraints(const unsigned int k)
{
  mesh.begin(constraints);
  std::vector<Index> fixed;
  if (condition == BoundaryCondition::PBC)
    {
      if (!not_periodic.empty())
        throw UserError(not_periodic);
      tie_duplicates(duplicates, mesh.dofs().locally_owned_dofs(), mesh.relevant(),
                     constraints);
      // One point holds the fluctuation; it has no duplicate itself.
      fixed.assign(supports.begin(), supports.begin() + dim);
    }
  else if (condition == BoundaryCondition::SUBC)
    fixed = supports;
  else
    for (unsigned int side = 0; side < sides.size(); ++side)
      for (std::size_t n = 0; n < sides[side].dofs.size(); ++n)
        if (is_prescribed<dim>(condition, k, side / 2, n % dim))
          fixed.push_back(sides[side].dofs[n]);
  for (const Index dof : fixed)
    if (constraints.get_local_lines().is_element(dof))
      constraints.add_line(dof);
  constraints.close();
}

template <int dim>
void MeshVolume<dim>::add_tractions()
{
  const dealii::IndexSet &owned = mesh.dofs().locally_owned_dofs();
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      {
        Vector &load = loads[voigt_index<dim>(c, d)];
        for (const Side &side : sides)
          for (std::size_t p = 0; p < side.normal_area.size(); ++p)
            {
              const Index dof = side.dofs[dim * p + c];
              if (owned.is_element(dof) && !constraints.is_constrained(dof))
                load(dof) += side.normal_area[p][d];
            }
      }
  for (unsigned int k = 0; k < n_loads; ++k)
    loads[k].compress(dealii::VectorOperation::add);
}

template <int dim>
std::vector<typename MeshVolume<dim>::Vector> MeshVolume<dim>::rigid_motions() const
{
  const dealii::IndexSet &owned = mesh.dofs().locally_owned_dofs();
  constexpr unsigned int n      = dim * (dim + 1) / 2;
  std::vector<Vector> motions(n, Vector(owned, mesh.communicator()));
  const double size = dealii::GridTools::diameter(mesh.dofs().get_triangulation());
  for (const auto &cell : mesh.dofs().active_cell_iterators())
    if (cell->is_locally_owned())
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int c = 0; c < dim; ++c)
          {
            const Index dof = cell->vertex_dof_index(v, c, cell->active_fe_index());
            if (!owned.is_element(dof) || constraints.is_constrained(dof))
              continue;
            motions[c](dof) = 1.;
            // In the plane of the axes c and d one of the two components turns back.
            for (unsigned int d = 0; d < dim; ++d)
              if (d != c)
                motions[voigt_index<dim>(c, d)](dof) =
                  (c < d ? -1. : 1.) * cell->vertex(v)[d] / size;
          }
  for (Vector &motion : motions)
    motion.compress(dealii::VectorOperation::insert);
  return motions;
}

template <int dim>
SolverReport MeshVolume<dim>::solve_case(const unsigned int k, const double tolerance)
{
  // What is left of the forces of a homogeneous volume is round-off.
  constexpr double cancelled    = 1e-12;
  const dealii::IndexSet &owned = mesh.dofs().locally_owned_dofs();
  const double reference        = loads[k].l2_norm();
  SolverReport report;
  Vector x(owned, mesh.communicator());
  if (!(reference <= cancelled * gross_loads[k]))
    report =
      conjugate_gradients(matrix, x, loads[k], preconditioner, reference, tolerance,
                          to_string(condition) + " " + voigt_names<dim>[k]);
  constraints.distribute(x);
  solutions[k].reinit(owned, mesh.relevant(), mesh.communicator());
  solutions[k].copy_locally_owned_data_from(x);
  solutions[k].update_ghost_values();
  return report;
}

template <int dim>
VolumeSums<dim> MeshVolume<dim>::solve(const BoundaryCondition wanted,
                                       const double tolerance,
                                       const std::function<void()> &case_done)
{
  condition = wanted;
  solutions = std::vector<Vector>(n_loads);
  std::array<SolverReport, n_loads> reports;
  for (unsigned int k = 0; k < n_loads; ++k)
    {
      if (begins_group<dim>(condition, k))
        {
          set_constraints(k);
          assemble();
          if (condition == BoundaryCondition::SUBC)
            add_tractions();
          preconditioner.initialize(is_apart ? gentle : matrix, rigid_motions());
        }
      reports[k] = solve_case(k, tolerance);
      if (case_done)
        case_done();
    }
  VolumeSums<dim> sums = integrate();
  sums.reports         = reports;
  return sums;
}

template class MeshVolume<2>;
template class MeshVolume<3>;
} // namespace mesoslip
