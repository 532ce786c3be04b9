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

#include <algorithm>
#include <cmath>
#include <map>

namespace mesoslip
{
namespace
{
/** Points (on rank 0) and components of the minimal Dirichlet supports against rigid
 * motions. */
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

/** Iterates over the degrees of freedom of cells: component and node position. */
template <int dim>
class NodesOfCells
{
public:
  explicit NodesOfCells(const DistributedMesh<dim> &mesh)
    : values(mesh.mapping(),
             mesh.dofs().get_fe_collection(),
             support_points(mesh),
             dealii::update_quadrature_points)
  {
  }

  /** Calls action(degree of freedom, component, point) for the degrees of freedom of
   * @p cell. */
  template <typename Cell, typename Action>
  void visit(const Cell &cell, const Action &action)
  {
    values.reinit(cell);
    const dealii::FEValues<dim> &here = values.get_present_fe_values();
    dofs.resize(here.dofs_per_cell);
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      action(dofs[i], here.get_fe().system_to_component_index(i).first,
             here.quadrature_point(i));
  }

private:
  static dealii::hp::QCollection<dim> support_points(const DistributedMesh<dim> &mesh)
  {
    dealii::hp::QCollection<dim> points;
    for (unsigned int k = 0; k < mesh.dofs().get_fe_collection().size(); ++k)
      points.push_back(dealii::Quadrature<dim>(
        mesh.dofs().get_fe_collection()[k].get_unit_support_points()));
    return points;
  }

  dealii::hp::FEValues<dim> values;
  std::vector<dealii::types::global_dof_index> dofs;
};
} // namespace

template <int dim>
MeshVolume<dim>::MeshVolume(const Mesh<dim> &given,
                            const std::vector<ElasticPhase<dim>> &the_phases,
                            const MPI_Comm communicator,
                            const unsigned int degree)
  : phases(the_phases)
  , mesh(given, communicator, degree)
  , is_apart(has_two_matrices(mesh, phases))
{
  mesh.require_cells();
  std::vector<std::array<unsigned int, 2>> held;
  std::vector<unsigned int> held_points;
  double tolerance = 0.;
  if (mpi::this_mpi_process(communicator) == 0)
    {
      const auto faces = faces_of_box(given, boundary_faces(given));
      held             = supported(given);
      for (const auto &[point, component] : held)
        held_points.push_back(point);
      const double edge = cell_quality(given).smallest_edge;
      tolerance         = given.tolerance * edge;
      try
        {
          for (unsigned int axis = 0; axis < dim; ++axis)
            opposite_points(given, faces[2 * axis], faces[2 * axis + 1], axis, edge);
        }
      catch (const UserError &e)
        {
          not_periodic = e.what();
        }
    }
  broadcast(communicator, not_periodic);
  find_sides(given);
  if (not_periodic.empty())
    find_copies(mpi::broadcast(tolerance, 0, communicator));
  held          = mpi::broadcast(held, 0, communicator);
  const auto at = mesh.dofs_of_points(given, held_points);
  for (std::size_t k = 0; k < held.size(); ++k)
    supports.push_back(at[dim * k + held[k][1]]);
}

// Faces of a box lie on its sides: each face is assigned to the nearest side.
template <int dim>
void MeshVolume<dim>::find_sides(const Mesh<dim> &given)
{
  std::array<double, 2UL *dim> ends = {};
  if (mpi::this_mpi_process(communicator()) == 0)
    {
      const dealii::BoundingBox<dim> box(given.points);
      for (unsigned int d = 0; d < dim; ++d)
        ends[2 * d] = box.lower_bound(d), ends[2 * d + 1] = box.upper_bound(d);
    }
  ends               = mpi::broadcast(ends, 0, communicator());
  const auto side_of = [&ends](const auto &face) {
    std::array<double, 2UL *dim> off = {};
    for (unsigned int side = 0; side < 2 * dim; ++side)
      for (const unsigned int v : face->vertex_indices())
        off[side] = std::max(off[side], std::abs(face->vertex(v)[side / 2] - ends[side]));
    return std::min_element(off.begin(), off.end()) - off.begin();
  };
  std::array<std::map<Index, OnSide>, 2UL * dim> own;
  std::vector<Index> dofs;
  NodesOfCells<dim> of_cells(mesh);
  for (const auto &cell : mesh.dofs().active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      {
        std::map<Index, OnSide> nodes;
        of_cells.visit(cell, [&](const Index dof, const unsigned int c, const auto &at) {
          OnSide &node = nodes[dof] = {dof, c, {}};
          for (unsigned int d = 0; d < dim; ++d)
            node.at[d] = at[d];
        });
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              dofs.resize(cell->get_fe().n_dofs_per_face(f));
              cell->face(f)->get_dof_indices(dofs, cell->active_fe_index());
              for (const Index dof : dofs)
                own[side_of(cell->face(f))][dof] = nodes.at(dof);
            }
      }
  for (unsigned int side = 0; side < 2 * dim; ++side)
    {
      std::vector<OnSide> mine;
      for (const auto &[dof, here] : own[side])
        mine.push_back(here);
      std::map<Index, OnSide> all; // dofs between two ranks are with both
      for (const std::vector<OnSide> &of_rank : mpi::all_gather(mine, communicator()))
        for (const OnSide &here : of_rank)
          all.emplace(here.dof, here);
      for (const auto &[dof, here] : all)
        sides[side].push_back(here);
    }
}

template <int dim>
void MeshVolume<dim>::find_copies(const double tolerance)
{
  for (unsigned int axis = 0; axis < dim; ++axis)
    {
      // Sorts by the coordinate along the side.
      const unsigned int along  = axis == 0 ? 1 : 0;
      std::vector<OnSide> lower = sides[2 * axis];
      const auto before         = [along](const OnSide &a, const double x) {
        return a.at[along] < x;
      };
      std::sort(lower.begin(), lower.end(), [along](const OnSide &a, const OnSide &b) {
        return a.at[along] < b.at[along];
      });
      for (const OnSide &here : sides[2 * axis + 1])
        {
          const auto distance = [&](const OnSide &other) {
            double square = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              square += d == axis ? 0. : std::pow(other.at[d] - here.at[d], 2);
            return std::sqrt(square);
          };
          const OnSide *nearest = nullptr;
          for (auto other = std::lower_bound(lower.begin(), lower.end(),
                                             here.at[along] - tolerance, before);
               other != lower.end() && other->at[along] <= here.at[along] + tolerance;
               ++other)
            if (other->component == here.component &&
                (nearest == nullptr || distance(*other) < distance(*nearest)))
              nearest = &*other;
          if (nearest == nullptr)
            throw UserError(std::string("Mesh/File: the sides at both ends of ") +
                            "xyz"[axis] + " have nodes that are not opposite");
          copies.push_back({{here.dof, nearest->dof}});
        }
    }
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
      tie_copies(copies, mesh.dofs().locally_owned_dofs(), mesh.relevant(), constraints);
      // Fixes the fluctuation at one point, which is not a periodic copy.
      fixed.assign(supports.begin(), supports.begin() + dim);
    }
  else if (condition == BoundaryCondition::SUBC)
    fixed = supports;
  else
    for (unsigned int side = 0; side < sides.size(); ++side)
      for (const OnSide &here : sides[side])
        if (is_prescribed<dim>(condition, k, side / 2, here.component))
          fixed.push_back(here.dof);
  for (const Index dof : fixed)
    if (constraints.get_local_lines().is_element(dof))
      constraints.add_line(dof);
  constraints.close();
}

template <int dim>
std::vector<typename MeshVolume<dim>::Vector> MeshVolume<dim>::rigid_motions() const
{
  const dealii::IndexSet &owned = mesh.dofs().locally_owned_dofs();
  constexpr unsigned int n      = dim * (dim + 1) / 2;
  std::vector<Vector> motions(n, Vector(owned, mesh.communicator()));
  const double size = dealii::GridTools::diameter(mesh.dofs().get_triangulation());
  NodesOfCells<dim> of_cells(mesh);
  for (const auto &cell : mesh.dofs().active_cell_iterators())
    if (cell->is_locally_owned())
      of_cells.visit(cell, [&](const Index dof, const unsigned int c, const auto &at) {
        if (!owned.is_element(dof) || constraints.is_constrained(dof))
          return;
        motions[c](dof) = 1.;
        // Rotation in the plane of the axes c and d: one component has a minus sign.
        for (unsigned int d = 0; d < dim; ++d)
          if (d != c)
            motions[voigt_index<dim>(c, d)](dof) = (c < d ? -1. : 1.) * at[d] / size;
      });
  for (Vector &motion : motions)
    motion.compress(dealii::VectorOperation::insert);
  return motions;
}

template <int dim>
SolverReport MeshVolume<dim>::solve_case(const unsigned int k, const double tolerance)
{
  // Forces of a homogeneous volume cancel to round-off.
  constexpr double cancelled    = 1e-12;
  const dealii::IndexSet &owned = mesh.dofs().locally_owned_dofs();
  const double reference        = loads[k].l2_norm();
  SolverReport report;
  Vector x(owned, mesh.communicator());
  if (!(reference <= cancelled * gross_loads[k]))
    report =
      conjugate_gradients(matrix, x, loads[k], preconditioner, reference, tolerance,
                          to_string(condition) + " " + name_of_case<dim>(k));
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
  condition                             = wanted;
  solutions                             = std::vector<Vector>(n_loads);
  const std::vector<unsigned int> order = order_of_cases<dim>(has_expansion(phases));
  std::vector<SolverReport> reports(order.size());
  for (const unsigned int k : order)
    {
      if (begins_group<dim>(condition, k))
        {
          set_constraints(k);
          assemble();
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
