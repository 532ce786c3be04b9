#include "elasticity/element_operator.h"

#include "material/stiffness.h"
#include "mesh/linear_shape.h"

#include <deal.II/base/quadrature.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mesoslip
{
namespace
{
/** So many congruent cells are worth a matrix of their own. */
constexpr unsigned int least_congruent = 128;

/** Corners of cells may deviate from congruence by this part of the mean cell size. */
constexpr double congruence = 1e-10;

template <int dim>
kernels::CellKernels cell_kernels(const InstructionSet isa)
{
  using namespace kernels;
  using Function                     = CellKernels (*)();
  static constexpr Function planes[] = MESOSLIP_VARIANTS(plane_cell_kernels);
  static constexpr Function solids[] = MESOSLIP_VARIANTS(solid_cell_kernels);
  return (dim == 2 ? variant(planes, isa) : variant(solids, isa))();
}

/** Corners relative to the first one, in units of @p length. */
template <int dim>
std::vector<std::int64_t> shape_of(const std::vector<dealii::Point<dim>> &points,
                                   const dealii::CellData<dim> &cell,
                                   const double length)
{
  std::vector<std::int64_t> shape = {cell.material_id};
  for (const unsigned int v : cell.vertices)
    for (unsigned int d = 0; d < dim; ++d)
      shape.push_back(
        std::llround((points[v][d] - points[cell.vertices[0]][d]) / length));
  return shape;
}

template <int dim>
double mean_diagonal(const std::vector<dealii::Point<dim>> &points,
                     const std::vector<dealii::CellData<dim>> &cells)
{
  double sum = 0.;
  for (const auto &cell : cells)
    sum += points[cell.vertices.front()].distance(points[cell.vertices.back()]);
  return sum / static_cast<double>(cells.size());
}

bool is_simplex(const unsigned int dim, const std::size_t n_corners)
{
  return n_corners == dim + 1;
}
} // namespace

template <int dim>
ElementOperator<dim>::ElementOperator(const std::vector<dealii::Point<dim>> &points,
                                      const std::vector<Cells> &parts,
                                      const std::vector<ElasticPhase<dim>> &phases,
                                      const InstructionSet isa)
  : kernels(cell_kernels<dim>(isa))
  , first_dummy(static_cast<std::uint32_t>(points.size()))
  , phase_material(Material::orthotropic)
{
  Assert(points.size() < std::numeric_limits<std::uint32_t>::max() - (1 << dim),
         dealii::ExcMessage("indices of nodes have 32 bits"));
  for (const ElasticPhase<dim> &phase : phases)
    {
      const double *C = phase.stiffness.data();
      stiffness.insert(stiffness.end(), C, C + phase.stiffness.size());
      if (!is_orthotropic<dim>(phase.stiffness))
        phase_material = Material::anisotropic;
    }

  // Behind the nodes the corners of a unit cell, which fills up batches; in the plane
  // they are followed by nothing up to the end of a vector.
  constexpr unsigned int stride = kernels::node_stride<dim>;
  coordinates.assign((points.size() + lanes<double>)*stride, 0.);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (unsigned int d = 0; d < dim; ++d)
      coordinates[i * stride + d] = points[i][d];
  for (unsigned int v = 0; v < 1U << dim; ++v)
    for (unsigned int d = 0; d < dim; ++d)
      coordinates[(first_dummy + v) * stride + d] = (v >> d) & 1;

  for (const Cells &cells : parts)
    this->parts.push_back(make_groups(points, cells));
}

template <int dim>
kernels::CellFunction ElementOperator<dim>::function(const Group &group) const
{
  return (group.kind == 0 ? kernels.simplex
                          : kernels.tensor)[static_cast<int>(group.common)];
}

template <int dim>
void ElementOperator<dim>::add_product(const unsigned int part,
                                       double *f,
                                       const double *u) const
{
  AssertIndexRange(part, parts.size());
  for (const Group &group : parts[part])
    function(group)(batches(group), coordinates.data(), u, f);
}

template <int dim>
kernels::CellBatches ElementOperator<dim>::batches(const Group &group) const
{
  const bool shared = group.common == Material::matrix;
  const double *K   = (shared ? matrices[group.kind] : stiffness).data();
  return {group.material.size(), group.nodes.data(), group.material.data(), K,
          group.gradients.data()};
}

template <int dim>
void ElementOperator<dim>::set_gradients(Group &group, const double *points) const
{
  if (group.kind != 0 || group.common == Material::matrix)
    return;
  group.gradients.resize(group.material.size() * dim * dim * kernels.cells_at_once);
  kernels.simplex_gradients(batches(group), points, group.gradients.data());
}

template <int dim>
std::vector<int>
ElementOperator<dim>::find_congruent(const std::vector<dealii::Point<dim>> &points,
                                     const Cells &cells)
{
  std::vector<int> result(cells.size(), -1);
  const double length = congruence * mean_diagonal(points, cells);
  std::map<std::vector<std::int64_t>, std::vector<std::size_t>> shapes;
  for (std::size_t k = 0; k < cells.size(); ++k)
    shapes[shape_of(points, cells[k], length)].push_back(k);
  for (const auto &[shape, members] : shapes)
    if (members.size() >= least_congruent)
      {
        const auto &cell             = cells[members[0]];
        const auto K                 = element_matrix(cell);
        std::vector<double> &already = matrices[!is_simplex(dim, cell.vertices.size())];
        const int number             = static_cast<int>(already.size() / K.size());
        already.insert(already.end(), K.begin(), K.end());
        for (const std::size_t k : members)
          result[k] = number;
        n_congruent += members.size();
      }
  return result;
}

template <int dim>
std::vector<double>
ElementOperator<dim>::element_matrix(const dealii::CellData<dim> &cell) const
{
  // A batch of the cell and of cells of no account, each with nodes of its own.
  constexpr unsigned int stride = kernels::node_stride<dim>;
  const unsigned int lanes      = kernels.cells_at_once;
  const std::size_t n_corners = cell.vertices.size(), n = (n_corners - 1) * dim;
  Group group{is_simplex(dim, n_corners) ? 0U : 1U, phase_material, {}, {}, {}};
  group.material = {cell.material_id};
  LineVector<double> points(n_corners * lanes * stride), u = points, f = points;
  for (unsigned int k = 0; k < n_corners * lanes; ++k)
    {
      group.nodes.push_back(k);
      std::copy_n(&coordinates[std::size_t(cell.vertices[k / lanes]) * stride], stride,
                  &points[std::size_t(k) * stride]);
    }
  const auto dof = [&](const std::size_t i) {
    return (1 + i / dim) * lanes * stride + i % dim;
  };
  set_gradients(group, points.data());
  std::vector<double> K(n * n);
  for (std::size_t j = 0; j < n; ++j)
    {
      std::fill(u.begin(), u.end(), 0.);
      std::fill(f.begin(), f.end(), 0.);
      u[dof(j)] = 1.;
      function(group)(batches(group), points.data(), u.data(), f.data());
      for (std::size_t i = 0; i < n; ++i)
        K[j * n + i] = f[dof(i)];
    }
  return K;
}

template <int dim>
std::vector<typename ElementOperator<dim>::Group>
ElementOperator<dim>::make_groups(const std::vector<dealii::Point<dim>> &points,
                                  const Cells &cells)
{
  const std::vector<int> matrix = find_congruent(points, cells);
  // By kind and CellMaterial; by phase or matrix the cells that wait for their batch.
  std::array<std::array<Group, 3>, 2> groups;
  std::array<std::array<std::map<std::uint32_t, std::vector<std::uint32_t>>, 3>, 2>
    waiting;
  for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const auto &vertices   = cells[k].vertices;
      const bool shared      = matrix[k] >= 0;
      const std::size_t kind = is_simplex(dim, vertices.size()) ? 0 : 1;
      const auto material =
        static_cast<std::size_t>(shared ? Material::matrix : phase_material);
      const std::uint32_t own =
        shared ? static_cast<std::uint32_t>(matrix[k]) : cells[k].material_id;
      auto &batch = waiting[kind][material][own];
      batch.insert(batch.end(), vertices.begin(), vertices.end());
      if (batch.size() == vertices.size() * kernels.cells_at_once)
        {
          groups[kind][material].material.push_back(own);
          finish_batch(static_cast<unsigned int>(vertices.size()), batch,
                       groups[kind][material]);
        }
    }

  std::vector<Group> result;
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::size_t material = 0; material < 3; ++material)
      {
        Group &group = groups[kind][material];
        for (auto &[own, batch] : waiting[kind][material])
          if (!batch.empty())
            {
              group.material.push_back(own);
              finish_batch(kind == 0 ? dim + 1 : 1U << dim, batch, group);
            }
        if (group.material.empty())
          continue;
        group.kind   = static_cast<unsigned int>(kind);
        group.common = static_cast<Material>(material);
        set_gradients(group, coordinates.data());
        result.push_back(std::move(group));
      }
  return result;
}

/** Adds a batch to the nodes of a group, dummy cells where it is not full; empties it. */
template <int dim>
void ElementOperator<dim>::finish_batch(const unsigned int n_corners,
                                        std::vector<std::uint32_t> &cells,
                                        Group &group) const
{
  const std::size_t n = cells.size() / n_corners;
  for (unsigned int v = 0; v < n_corners; ++v)
    for (std::size_t l = 0; l < kernels.cells_at_once; ++l)
      {
        // Of a simplex the corners 0, e_x, e_y, e_z.
        const unsigned int corner = n_corners == dim + 1 && v > 0 ? 1U << (v - 1) : v;
        group.nodes.push_back(l < n ? cells[l * n_corners + v] : first_dummy + corner);
      }
  cells.clear();
}

namespace
{
/** Shape functions of one kind of cells at the points of a quadrature rule. */
template <int dim>
struct ShapeTable
{
  explicit ShapeTable(const std::size_t n_corners)
  {
    const dealii::ReferenceCell shape = reference_cell<dim>(n_corners);
    const auto quadrature             = shape.template get_gauss_type_quadrature<dim>(2);
    weights                           = quadrature.get_weights();
    for (const auto &point : quadrature.get_points())
      for (unsigned int v = 0; v < n_corners; ++v)
        {
          value.push_back(shape.template d_linear_shape_function<dim>(point, v));
          gradient.push_back(linear_shape_gradient<dim>(shape, point, v));
        }
  }

  std::vector<double> weights, value; ///< value: [point][corner]
  std::vector<dealii::Tensor<1, dim>> gradient;
};
} // namespace

template <int dim>
std::vector<double> lumped_mass(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<dealii::CellData<dim>> &cells,
                                const std::vector<ElasticPhase<dim>> &phases)
{
  std::vector<double> mass(points.size());
  std::map<std::size_t, ShapeTable<dim>> tables; // by the number of corners
  for (const auto &cell : cells)
    {
      const std::size_t n  = cell.vertices.size();
      const auto &table    = tables.try_emplace(n, n).first->second;
      const double density = phases[cell.material_id].density;
      for (std::size_t q = 0; q < table.weights.size(); ++q)
        {
          dealii::Tensor<2, dim> J;
          for (unsigned int v = 0; v < n; ++v)
            J += outer_product(points[cell.vertices[v]], table.gradient[q * n + v]);
          for (unsigned int v = 0; v < n; ++v)
            mass[cell.vertices[v]] +=
              density * determinant(J) * table.weights[q] * table.value[q * n + v];
        }
    }
  return mass;
}

template class ElementOperator<2>;
template class ElementOperator<3>;
template std::vector<double> lumped_mass(const std::vector<dealii::Point<2>> &,
                                         const std::vector<dealii::CellData<2>> &,
                                         const std::vector<ElasticPhase<2>> &);
template std::vector<double> lumped_mass(const std::vector<dealii::Point<3>> &,
                                         const std::vector<dealii::CellData<3>> &,
                                         const std::vector<ElasticPhase<3>> &);
} // namespace mesoslip
