#include "body/mesh/mesh_body.h"

#include "base/errors.h"
#include "base/text.h"
#include "body/mesh/mesh_discretization.h"
#include "body/mesh/ml_solver.h"
#include "mesh/boundary.h"
#include "mesh/cell_gradients.h"
#include "mesh/cell_quality.h"
#include "mesh/periodic_points.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

namespace mesoslip
{
MeshBodyInput<2> mesh_of_grid(const UniformMaterial &material)
{
  const UniformGrid<2> &grid = material.grid();
  MeshBodyInput<2> body;
  body.phases      = material.phases();
  body.periodicity = material.periodicity();
  body.n_columns   = material.n_columns();
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    body.mesh.phases.push_back(std::to_string(p));
  for (unsigned int j = 0; j < material.n_rows(); ++j)
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      body.mesh.points.emplace_back(i * grid.spacing[0], j * grid.spacing[1]);
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const unsigned int lower = j * body.n_columns + i, upper = lower + body.n_columns;
        auto &cell       = body.mesh.cells.emplace_back(4);
        cell.vertices    = {lower, lower + 1, upper, upper + 1};
        cell.material_id = material.phase_of(i, j);
      }
  return body;
}

Mesh<2> cut_into_triangles(const Mesh<2> &mesh)
{
  Mesh<2> result = mesh;
  result.cells.clear();
  for (const auto &cell : mesh.cells)
    {
      const auto &p       = cell.vertices;
      const bool rising   = result.cells.size() % 4 == 0;
      const auto triangle = [&](const std::vector<unsigned int> &corners) {
        auto &added       = result.cells.emplace_back(3);
        added.vertices    = corners;
        added.material_id = cell.material_id;
      };
      triangle({p[0], p[1], rising ? p[3] : p[2]});
      triangle({rising ? p[0] : p[1], p[3], p[2]});
    }
  return result;
}

namespace
{
/** Cells that are evaluated at once. */
constexpr std::size_t group_size = 1024;

/** The faces in one of the planes of the bounding box. */
template <int dim>
std::vector<BoundaryFace<dim>> faces_in_plane(const Mesh<dim> &mesh,
                                              const std::vector<BoundaryFace<dim>> &faces,
                                              const dealii::BoundingBox<dim> &box,
                                              const unsigned int side)
{
  const unsigned int axis = side / 2;
  const double level      = side % 2 == 0 ? box.lower_bound(axis) : box.upper_bound(axis);
  std::vector<BoundaryFace<dim>> result;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(result),
               [&](const BoundaryFace<dim> &face) {
                 return std::all_of(face.points.begin(),
                                    face.points.begin() + face.n_points,
                                    [&](const unsigned int p) {
                                      return std::fabs(mesh.points[p][axis] - level) <=
                                             1e-9 * box.side_length(axis);
                                    });
               });
  return result;
}

/** Areas of points that move together summed up at the original. */
template <int dim>
BoundaryPoints<dim> of_originals(const Mesh<dim> &mesh, const BoundaryPoints<dim> &all)
{
  if (mesh.originals.empty())
    return all;
  std::map<unsigned int, dealii::Tensor<1, dim>> area;
  for (std::size_t k = 0; k < all.points.size(); ++k)
    area[mesh.original(all.points[k])] += all.normal_area[k];
  BoundaryPoints<dim> result;
  for (const auto &[point, of_point] : area)
    {
      result.points.push_back(point);
      result.normal_area.push_back(of_point);
    }
  return result;
}

template <int dim>
std::vector<BoundaryFace<dim>> faces_called(const Mesh<dim> &mesh,
                                            const std::vector<BoundaryFace<dim>> &faces,
                                            const std::string &name)
{
  const auto found = std::find(mesh.boundaries.begin(), mesh.boundaries.end(), name);
  std::vector<BoundaryFace<dim>> result;
  if (found != mesh.boundaries.end())
    result = faces_of_group(mesh, faces, found - mesh.boundaries.begin());
  if (result.empty())
    throw UserError("Mesh: there is no boundary '" + name +
                    "' with faces on the surface of the body; its boundaries are " +
                    to_text(mesh.boundaries));
  return result;
}
} // namespace

template <int dim>
MeshBody<dim>::MeshBody(const MeshBodyInput<dim> &given, const MPI_Comm communicator)
  : ElasticBody<dim>(given.n_columns > 0 ? given.n_columns : given.mesh.points.size(),
                     given.n_columns > 0 ? given.mesh.points.size() / given.n_columns : 1,
                     given.phases,
                     given.periodicity)
  , input(given)
  , mesh(input.mesh)
  , communicator(communicator)
{
  cell_quality(mesh);
  for (const auto &cell : mesh.cells)
    {
      volumes.push_back(dealii::GridTools::cell_measure(
        mesh.points, dealii::ArrayView<const unsigned int>(cell.vertices)));
      this->total_volume += volumes.back();
      this->mass += volumes.back() * input.phases[cell.material_id].density;
    }
  this->number_of_cells = mesh.cells.size();
  this->distributed     = dealii::Utilities::MPI::n_mpi_processes(communicator) > 1;
  find_sides();
  tie_sides();
  discretization = std::make_unique<MeshDiscretization<dim>>(mesh, *this, communicator);
}

template <int dim>
MeshBody<dim>::~MeshBody() = default;

template <int dim>
NodeIndex MeshBody<dim>::node(const std::size_t point) const
{
  return {static_cast<unsigned int>(point % this->n_columns()),
          static_cast<unsigned int>(point / this->n_columns())};
}

template <int dim>
void MeshBody<dim>::find_sides()
{
  const auto faces = boundary_faces(mesh);
  const dealii::BoundingBox<dim> box(mesh.points);
  for (unsigned int d = 0; d < dim; ++d)
    {
      lower[d]         = box.lower_bound(d);
      this->extents[d] = box.side_length(d);
    }
  for (unsigned int id = 0; id < 2 * dim; ++id)
    {
      const std::string &name = id == ElasticBody<dim>::bottom ? input.contact_boundary
                                : id == ElasticBody<dim>::top  ? input.top_boundary
                                                               : std::string();
      const auto side         = of_originals(
                mesh, boundary_points(mesh, name.empty() ? faces_in_plane(mesh, faces, box, id)
                                                         : faces_called(mesh, faces, name)));
      std::vector<std::size_t> order(side.points.size());
      std::iota(order.begin(), order.end(), 0);
      if (dim == 2)
        std::sort(order.begin(), order.end(),
                  [&](const std::size_t a, const std::size_t b) {
                    return mesh.points[side.points[a]][1 - id / 2] <
                           mesh.points[side.points[b]][1 - id / 2];
                  });
      const Periodicity ends = input.periodicity;
      this->sides[id].closed =
        dim == 2 && mesh.originals.empty() && (id < 2 ? ends.y : ends.x);
      for (const std::size_t k : order)
        {
          this->sides[id].nodes.push_back(node(side.points[k]));
          std::array<double, dim> area;
          for (unsigned int d = 0; d < dim; ++d)
            area[d] = side.normal_area[k][d];
          this->sides[id].normal_area.push_back(area);
        }
    }
}

template <int dim>
void MeshBody<dim>::tie_copies()
{
  for (unsigned int p = 0; p < mesh.originals.size(); ++p)
    if (mesh.originals[p] != p)
      this->duplicates.push_back({{node(p), node(mesh.originals[p])}});
}

template <int dim>
void MeshBody<dim>::tie_sides()
{
  if (!mesh.originals.empty())
    return tie_copies();
  const auto points = [this](const unsigned int side) {
    std::vector<unsigned int> result;
    for (const NodeIndex &n : this->sides[side].nodes)
      result.push_back(n.j * this->n_columns() + n.i);
    return result;
  };
  const std::array<bool, 2> periodic = {{input.periodicity.x, input.periodicity.y}};
  for (unsigned int axis = 0; axis < 2; ++axis)
    if (periodic[axis])
      for (const auto &[duplicate, original] :
           opposite_points(mesh, points(2 * axis), points(2 * axis + 1), axis,
                           cell_quality(mesh).smallest_edge)
             .pairs)
        this->duplicates.push_back({{node(duplicate), node(original)}});
}

template <int dim>
std::array<double, dim> MeshBody<dim>::point(const NodeIndex &node) const
{
  const dealii::Point<dim> &p =
    mesh.points[static_cast<std::size_t>(node.j) * this->n_columns() + node.i];
  std::array<double, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = p[d] - lower[d];
  return result;
}

template <int dim>
std::vector<double> MeshBody<dim>::lumped_mass() const
{
  NodalField<double> mass = this->zero_field();
  discretization->to_field(mass, discretization->lumped_mass());
  std::vector<double> result;
  for (unsigned int j = 0; j < this->n_rows(); ++j)
    result.insert(result.end(), mass.row(0, j), mass.row(0, j) + this->n_columns());
  return result;
}

template <int dim>
std::size_t MeshBody<dim>::n_cell_groups() const
{
  return (this->n_cells() + group_size - 1) / group_size;
}

template <int dim>
void MeshBody<dim>::evaluate(const NodalField<double> &u,
                             const std::size_t group,
                             typename ElasticBody<dim>::Cells &cells) const
{
  const std::size_t begin = group * group_size,
                    end   = std::min(begin + group_size, this->n_cells());
  cells                   = {};
  for (std::size_t k = begin; k < end; ++k)
    {
      const auto &corners     = mesh.cells[k].vertices;
      const auto gradient     = integrated_gradients(mesh, corners);
      VoigtVector<dim> strain = VoigtVector<dim>::Zero();
      for (std::size_t v = 0; v < corners.size(); ++v)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            strain(voigt_index<dim>(c, d)) +=
              gradient[v][d] * u(c, node(corners[v])) / volumes[k];
      cells.phase.push_back(mesh.cells[k].material_id);
      cells.strain.push_back(strain);
      cells.volume.push_back(volumes[k] * this->n_cells() / this->volume());
    }
}

template <int dim>
void MeshBody<dim>::vmult(NodalField<double> &Ku, const NodalField<double> &u) const
{
  const auto x = discretization->to_vector(u);
  auto y       = x;
  discretization->stiffness().vmult(y, x);
  discretization->to_field(Ku, y);
}

template <int dim>
std::vector<MatrixEntry> MeshBody<dim>::stiffness_entries() const
{
  // The matrix has ones of its own in the rows of duplicates.
  std::vector<bool> duplicate(mesh.points.size(), false);
  for (const auto &pair : this->duplicates)
    duplicate[static_cast<std::size_t>(pair[0].j) * this->n_columns() + pair[0].i] = true;
  constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> number(discretization->n_dofs(), none);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    for (unsigned int c = 0; c < dim && !duplicate[p]; ++c)
      number[discretization->dof(c, node(p))] = dim * p + c;
  const auto &matrix = discretization->stiffness();
  std::vector<MatrixEntry> entries;
  for (const auto row : matrix.locally_owned_range_indices())
    if (number[row] != none)
      for (auto entry = matrix.begin(row); entry != matrix.end(row); ++entry)
        if (number[entry->column()] != none)
          entries.push_back({number[row], number[entry->column()], entry->value()});
  return entries;
}

template <int dim>
std::unique_ptr<StaticSolver> MeshBody<dim>::make_solver() const
{
  discretization->require_cells();
  return std::make_unique<MlSolver<dim>>(*this, *discretization);
}

template <int dim>
std::unique_ptr<ElasticBody<dim>> MeshBody<dim>::make_periodic() const
{
  MeshBodyInput<dim> periodic = input;
  periodic.periodicity        = {true, true};
  return std::make_unique<MeshBody<dim>>(periodic, communicator);
}

template class MeshBody<2>;
template class MeshBody<3>;
} // namespace mesoslip
