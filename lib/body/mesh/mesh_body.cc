#include "body/mesh/mesh_body.h"

#include "base/errors.h"
#include "body/mesh/mesh_discretization.h"
#include "body/mesh/ml_solver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mesoslip
{
Mesh<2> mesh_of_grid(const UniformMaterial &material)
{
  const UniformGrid<2> &grid = material.grid();
  Mesh<2> mesh;
  mesh.phases      = material.phases();
  mesh.periodicity = material.periodicity();
  mesh.n_columns   = material.n_columns();
  for (unsigned int j = 0; j < material.n_rows(); ++j)
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      mesh.points.push_back({{i * grid.spacing[0], j * grid.spacing[1]}});
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const unsigned int lower = j * mesh.n_columns + i, upper = lower + mesh.n_columns;
        mesh.cells.insert(mesh.cells.end(), {lower, lower + 1, upper, upper + 1});
        mesh.phase.push_back(material.phase_of(i, j));
      }
  return mesh;
}

Mesh<2> cut_into_triangles(const Mesh<2> &mesh)
{
  Mesh<2> result   = mesh;
  result.n_corners = 3;
  result.cells.clear();
  result.phase.clear();
  for (std::size_t k = 0; k < mesh.n_cells(); ++k)
    {
      const unsigned int *p = &mesh.cells[4 * k];
      if (k % 2 == 0)
        result.cells.insert(result.cells.end(), {p[0], p[1], p[3], p[0], p[3], p[2]});
      else
        result.cells.insert(result.cells.end(), {p[0], p[1], p[2], p[1], p[3], p[2]});
      result.phase.insert(result.phase.end(), 2, mesh.phase[k]);
    }
  return result;
}

std::vector<unsigned int> points_of_side(const Mesh<2> &mesh, const unsigned int side)
{
  const unsigned int axis    = side / 2;
  const auto [first, second] = std::minmax_element(
    mesh.points.begin(), mesh.points.end(),
    [axis](const auto &a, const auto &b) { return a[axis] < b[axis]; });
  const double lower = (*first)[axis], upper = (*second)[axis],
               place = side % 2 == 0 ? lower : upper;
  std::vector<unsigned int> points;
  for (unsigned int k = 0; k < mesh.points.size(); ++k)
    if (std::fabs(mesh.points[k][axis] - place) <= 1e-9 * (upper - lower))
      points.push_back(k);
  std::sort(points.begin(), points.end(),
            [&](const unsigned int a, const unsigned int b) {
              return mesh.points[a][1 - axis] < mesh.points[b][1 - axis];
            });
  return points;
}

std::vector<std::array<unsigned int, 2>> opposite_points(const Mesh<2> &mesh,
                                                         const unsigned int axis)
{
  const std::vector<unsigned int> lower = points_of_side(mesh, 2 * axis),
                                  upper = points_of_side(mesh, 2 * axis + 1);
  const std::string sides = std::string("the sides at both ends of ") + "xy"[axis];
  if (lower.size() != upper.size())
    throw std::invalid_argument(sides + " have " + std::to_string(lower.size()) +
                                " and " + std::to_string(upper.size()) +
                                " nodes; a periodic mesh needs equal ones");
  const auto along = [&](const unsigned int k) { return mesh.points[k][1 - axis]; };
  std::vector<std::array<unsigned int, 2>> pairs;
  for (std::size_t k = 0; k < lower.size(); ++k)
    {
      const std::size_t next = k + 1 < lower.size() ? k + 1 : k - 1;
      const double distance  = std::fabs(along(upper[k]) - along(lower[k]));
      if (!(distance <= 1e-6 * std::fabs(along(lower[next]) - along(lower[k]))))
        throw std::invalid_argument(sides + " have nodes that are not opposite: " +
                                    std::to_string(distance * 1e3) + " mm apart");
      pairs.push_back({{upper[k], lower[k]}});
    }
  return pairs;
}

namespace
{
/** Cells that are evaluated at once. */
constexpr std::size_t group_size = 1024;

/** Corners counter-clockwise, from the order of deal.II. */
std::vector<unsigned int> around(const Mesh<2> &mesh, const std::size_t cell)
{
  const unsigned int *p = &mesh.cells[cell * mesh.n_corners];
  if (mesh.n_corners == 3)
    return {p[0], p[1], p[2]};
  return {p[0], p[1], p[3], p[2]};
}

double area(const Mesh<2> &mesh, const std::size_t cell)
{
  const std::vector<unsigned int> corner = around(mesh, cell);
  const std::array<double, 2> &o         = mesh.points[corner[0]];
  double twice                           = 0.;
  for (std::size_t v = 1; v + 1 < corner.size(); ++v)
    {
      const auto &a = mesh.points[corner[v]], &b = mesh.points[corner[v + 1]];
      twice += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
    }
  return 0.5 * twice;
}
} // namespace

template <int dim>
MeshBody<dim>::MeshBody(const Mesh<dim> &given, const MPI_Comm communicator)
  : ElasticBody<dim>(given.n_columns > 0 ? given.n_columns : given.points.size(),
                     given.n_columns > 0 ? given.points.size() / given.n_columns : 1,
                     given.phases,
                     given.periodicity)
  , mesh(given)
  , communicator(communicator)
  , lower(mesh.points.at(0))
{
  std::array<double, dim> upper = lower;
  for (const auto &p : mesh.points)
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], p[d]);
        upper[d] = std::max(upper[d], p[d]);
      }
  for (std::size_t k = 0; k < mesh.n_cells(); ++k)
    {
      volumes.push_back(area(mesh, k));
      if (!(volumes.back() > 0.))
        throw std::invalid_argument("cell " + std::to_string(k) +
                                    " has no area or its corners run clockwise");
      this->total_volume += volumes.back();
      this->mass += volumes.back() * mesh.phases[mesh.phase[k]].density;
    }
  for (unsigned int d = 0; d < dim; ++d)
    this->extents[d] = upper[d] - lower[d];
  this->number_of_cells = mesh.n_cells();
  int n_ranks           = 1;
  MPI_Comm_size(communicator, &n_ranks);
  this->distributed = n_ranks > 1;
  find_sides();
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
  for (unsigned int id = 0; id < 2 * dim; ++id)
    {
      const std::vector<unsigned int> points = points_of_side(mesh, id);
      const unsigned int axis = id / 2, n = points.size();
      const auto along = [&](const unsigned int k) {
        return mesh.points[points[std::min(k, n - 1)]][1 - axis];
      };
      for (unsigned int k = 0; k < n; ++k)
        {
          // Half the way to the neighbours on both sides.
          const double length          = 0.5 * (along(k + 1) - along(k > 0 ? k - 1 : 0));
          std::array<double, dim> area = {};
          area[axis]                   = id % 2 == 0 ? -length : length;
          this->sides[id].nodes.push_back(node(points[k]));
          this->sides[id].normal_area.push_back(area);
        }
      const bool periodic = axis == 0 ? mesh.periodicity.x : mesh.periodicity.y;
      if (periodic && id % 2 == 1)
        for (const auto &[duplicate, original] : opposite_points(mesh, axis))
          this->duplicates.push_back({{node(duplicate), node(original)}});
    }
}

template <int dim>
std::array<double, dim> MeshBody<dim>::point(const NodeIndex &node) const
{
  std::array<double, dim> p =
    mesh.points[static_cast<std::size_t>(node.j) * this->n_columns() + node.i];
  for (unsigned int d = 0; d < dim; ++d)
    p[d] -= lower[d];
  return p;
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

// By the divergence theorem: displacements are linear along the edges.
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
      const std::vector<unsigned int> corner = around(mesh, k);
      VoigtVector<dim> strain                = VoigtVector<dim>::Zero();
      for (std::size_t v = 0; v < corner.size(); ++v)
        {
          const unsigned int a = corner[v], b = corner[(v + 1) % corner.size()];
          const double nx = mesh.points[b][1] - mesh.points[a][1],
                       ny = mesh.points[a][0] - mesh.points[b][0],
                       ux = 0.5 * (u(0, node(a)) + u(0, node(b))),
                       uy = 0.5 * (u(1, node(a)) + u(1, node(b)));
          strain += VoigtVector<2>(nx * ux, ny * uy, ny * ux + nx * uy) / volumes[k];
        }
      cells.phase.push_back(mesh.phase[k]);
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
std::unique_ptr<StaticSolver> MeshBody<dim>::make_solver() const
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
  if (this->n_cells() < n_ranks)
    throw UserError("ml cannot divide a mesh of " + std::to_string(this->n_cells()) +
                    " cells among " + std::to_string(n_ranks) +
                    " ranks; start at most as many ranks as there are cells");
  return std::make_unique<MlSolver<dim>>(*this, *discretization);
}

template <int dim>
std::unique_ptr<ElasticBody<dim>> MeshBody<dim>::make_periodic() const
{
  Mesh<dim> periodic   = mesh;
  periodic.periodicity = {true, true};
  return std::make_unique<MeshBody<dim>>(periodic, communicator);
}

template class MeshBody<2>;
} // namespace mesoslip
