#include "body/mesh/mesh_body.h"

#include "base/exchange.h"
#include "body/mesh/mesh_discretization.h"
#include "body/mesh/mesh_share.h"
#include "body/mesh/ml_solver.h"
#include "mesh/cell_quality.h"
#include "mesh/cell_shapes.h"

#include <algorithm>
#include <limits>
#include <numeric>

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
/** Number of cells evaluated at once. */
constexpr std::size_t group_size = 1024;

template <int dim>
MeshBodyInput<dim> with_mesh(MeshBodyInput<dim> input, Mesh<dim> &&mesh)
{
  input.mesh = std::move(mesh);
  return input;
}

/** Permutation that sorts @p numbers. */
std::vector<unsigned int> order_of(const std::vector<unsigned int> &numbers)
{
  std::vector<unsigned int> order(numbers.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
    return numbers[a] < numbers[b];
  });
  return order;
}

template <int dim>
std::vector<double> volumes_of(const Mesh<dim> &mesh)
{
  std::vector<double> volumes;
  for (const auto &cell : mesh.cells)
    volumes.push_back(cell_volume<dim>(mesh.points, cell.vertices));
  return volumes;
}
} // namespace

template <int dim>
MeshBody<dim>::MeshBody(const MeshBodyInput<dim> &given, MeshShare<dim> &&share)
  : PointBody<dim>(given.n_columns > 0 ? given.n_columns : share.mesh.points.size(),
                   given.n_columns > 0 ? share.mesh.points.size() / given.n_columns : 1,
                   given.phases,
                   given.periodicity)
  , input(with_mesh(given, std::move(share.mesh)))
  , mesh(input.mesh)
  , all_ranks(share.all_ranks->communicator())
  , lower(share.outline.lower)
  , in_mesh(std::move(share.point_in_mesh))
  , in_order(order_of(in_mesh))
  , cell_in_mesh(std::move(share.cell_in_mesh))
  , volumes(volumes_of(mesh))
{
  this->n_owned         = share.n_owned;
  this->extents         = share.outline.extents;
  this->total_volume    = share.outline.volume;
  this->mass            = share.outline.mass;
  this->number_of_cells = share.outline.n_cells;
  this->distributed     = mpi::n_mpi_processes(all_ranks) > 1;
  this->n_counted       = share.n_counted;
  if (share.is_divided)
    this->sharing = all_ranks;
  set_sides(share);
  discretization = std::make_unique<MeshDiscretization<dim>>(std::move(share), *this);
}

template <int dim>
MeshBody<dim>::MeshBody(const MeshBodyInput<dim> &given, const MPI_Comm communicator)
  : MeshBody(given, whole_share(given, communicator))
{
}

template <int dim>
std::unique_ptr<MeshBody<dim>> MeshBody<dim>::divide(const Mesh<dim> &mesh,
                                                     const MeshBodyInput<dim> &given,
                                                     const MPI_Comm communicator)
{
  return std::unique_ptr<MeshBody>(
    new MeshBody(given, divided_share(mesh, given, communicator)));
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
std::optional<NodeIndex> MeshBody<dim>::find(const unsigned int number) const
{
  const auto found = std::lower_bound(
    in_order.begin(), in_order.end(), number,
    [this](const unsigned int i, const unsigned int n) { return in_mesh[i] < n; });
  if (found == in_order.end() || in_mesh[*found] != number)
    return std::nullopt;
  return node(*found);
}

template <int dim>
std::uint64_t MeshBody<dim>::number(const NodeIndex &node) const
{
  return in_mesh[this->index(node)];
}

template <int dim>
void MeshBody<dim>::set_sides(const MeshShare<dim> &share)
{
  this->of_contact     = share.outline.sides[ElasticBody<dim>::bottom].points;
  const bool may_close = dim == 2 && !share.is_divided && mesh.masters.empty();
  for (unsigned int id = 0; id < 2 * dim; ++id)
    {
      const auto &points      = share.outline.sides[id].points;
      SurfaceNodes<dim> &side = this->sides[id];
      side.normal_area        = share.outline.sides[id].normal_area;
      side.closed = may_close && (id < 2 ? input.periodicity.y : input.periodicity.x);
      for (std::size_t k = 0; k < points.size(); ++k)
        if (const auto found = find(points[k]))
          {
            side.nodes.push_back(*found);
            side.place_of_nodes.push_back(k);
          }
    }
  const std::vector<unsigned int> &pairs = share.outline.copies;
  for (std::size_t k = 0; k < pairs.size() && !share.is_divided; k += 2)
    this->copies.push_back({{node(pairs[k]), node(pairs[k + 1])}});
}

template <int dim>
void MeshBody<dim>::update_copies(NodalField<double> &field) const
{
  if (this->communicator() == MPI_COMM_SELF)
    ElasticBody<dim>::update_copies(field); // replicated fields: no communication
  else
    discretization->to_field(field, discretization->to_vector(field));
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
std::vector<double> MeshBody<dim>::mass_of_cells() const
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
  return (mesh.cells.size() + group_size - 1) / group_size;
}

template <int dim>
void MeshBody<dim>::evaluate(const NodalField<double> &u,
                             const std::size_t group,
                             typename ElasticBody<dim>::Cells &cells) const
{
  const std::size_t begin = group * group_size,
                    end   = std::min(begin + group_size, mesh.cells.size());
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
std::vector<VoigtMatrix<dim>>
MeshBody<dim>::strain_products(const NodalField<double> &u) const
{
  return discretization->strain_products(discretization->to_vector(u));
}

template <int dim>
void MeshBody<dim>::multiply(NodalField<double> &Ku, const NodalField<double> &u) const
{
  const auto x = discretization->to_vector(u);
  auto y       = x;
  discretization->stiffness().vmult(y, x);
  discretization->to_field(Ku, y);
}

template <int dim>
std::vector<MatrixEntry> MeshBody<dim>::stiffness_entries() const
{
  // The matrix has unit entries in the rows of periodic copies.
  std::vector<bool> copy(mesh.points.size(), false);
  for (const auto &pair : this->copies)
    copy[static_cast<std::size_t>(pair[0].j) * this->n_columns() + pair[0].i] = true;
  constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> numbers(discretization->n_dofs(), none);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
    for (unsigned int c = 0; c < dim && !copy[p]; ++c)
      numbers[discretization->dof(c, node(p))] = dim * p + c;
  std::vector<MatrixEntry> entries;
  discretization->stiffness().for_each(
    [&](const std::uint64_t row, const std::uint64_t column, const double value) {
      if (numbers[row] != none && numbers[column] != none)
        entries.push_back({numbers[row], numbers[column], value});
    });
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
  return std::make_unique<MeshBody<dim>>(periodic, all_ranks);
}

template class MeshBody<2>;
template class MeshBody<3>;
} // namespace mesoslip
