#include "elasticity/element_operator.h"

#include "material/stiffness.h"
#include "mesh/cell_order.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mesoslip
{
namespace
{
/** Least number of congruent cells that share an element matrix. */
constexpr unsigned int least_congruent = 128;

/** Tolerance of congruence: deviation of corners relative to the mean cell size. */
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

bool is_simplex(const unsigned int dim, const std::size_t n_corners)
{
  return n_corners == dim + 1;
}

template <typename Matrix>
void append(std::vector<double> &numbers, const Matrix &matrix)
{
  numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
}

/**
 * Whether congruent cells of this shape can share a matrix: simplices, parallelograms and
 * parallelepipeds.
 */
bool can_be_shared(const unsigned int dim, const std::vector<std::int64_t> &shape)
{
  const std::size_t n_corners = (shape.size() - 1) / dim;
  const auto corner           = [&](const std::size_t v, const unsigned int d) {
    return shape[1 + v * dim + d];
  };
  for (std::size_t v = 3; v < n_corners && !is_simplex(dim, n_corners); ++v)
    for (unsigned int d = 0; d < dim; ++d)
      {
        std::int64_t sum = 0;
        for (std::size_t bit = 1; bit <= v; bit *= 2)
          sum += (v & bit) != 0 ? corner(bit, d) : 0;
        // Each corner is rounded.
        if (std::abs(corner(v, d) - sum) > 2)
          return false;
      }
  return true;
}

/** Corners relative to the first one, in units of @p length. */
template <int dim>
std::vector<std::int64_t> shape_of(const std::vector<dealii::Point<dim>> &points,
                                   const Cell &cell,
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
                     const std::vector<Cell> &cells)
{
  double sum = 0.;
  for (const auto &cell : cells)
    sum += points[cell.vertices.front()].distance(points[cell.vertices.back()]);
  return sum / static_cast<double>(cells.size());
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
  AssertThrow(points.size() + lanes<double> <
                std::numeric_limits<std::uint32_t>::max() / kernels::node_stride<dim>,
              dealii::ExcMessage("indices into fields have 32 bits"));
  const bool is_apart = std::any_of(phases.begin(), phases.end(),
                                    [](const auto &p) { return p.mean_dilatation; });
  for (const ElasticPhase<dim> &phase : phases)
    {
      const VoigtMatrix<dim> about = phase.stiffness_about_mean(),
                             more  = phase.stiffness - about;
      append(stiffness, phase.stiffness);
      append(about_mean, about);
      if (is_apart)
        append(excess, more);
      if (!is_orthotropic<dim>(phase.stiffness))
        phase_material = Material::anisotropic;
    }

  // The nodes are followed by the corners of a unit cell, which fills up batches, and in
  // 2D by zeros up to the end of a vector.
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
    function(group)(batches(group), u, f);
}

template <int dim>
kernels::CellBatches ElementOperator<dim>::batches(const Group &group) const
{
  const bool shared  = group.common == Material::matrix,
             tensor  = group.kind == 1 && !shared;
  const auto &K      = shared ? matrices[group.kind] : tensor ? about_mean : stiffness;
  const double *more = tensor && !excess.empty() ? excess.data() : nullptr;
  return {
    group.material.size(), group.nodes.data(), group.material.data(), K.data(), more,
    group.shapes.data()};
}

template <int dim>
void ElementOperator<dim>::set_shapes(Group &group, const double *points) const
{
  if (group.common == Material::matrix)
    return;
  const std::size_t n_corners = group.kind == 0 ? dim + 1 : 1 << dim;
  group.shapes.resize(group.material.size() * dim * (n_corners - 1) *
                      kernels.cells_at_once);
  kernels.shapes[group.kind](batches(group), points, group.shapes.data());
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
    if (members.size() >= least_congruent && can_be_shared(dim, shape))
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
std::vector<double> ElementOperator<dim>::element_matrix(const Cell &cell) const
{
  // A batch of the cell and of dummy cells, each with its own nodes.
  constexpr unsigned int stride = kernels::node_stride<dim>;
  const unsigned int lanes = kernels.cells_at_once, n_corners = cell.vertices.size();
  const bool simplex = is_simplex(dim, n_corners);
  Group group{simplex ? 0U : 1U, phase_material, {}, {}, {}};
  group.material = {cell.material_id};
  LineVector<double> points(std::size_t{n_corners} * lanes * stride), u = points,
                                                                      f = points;
  for (unsigned int k = 0; k < n_corners * lanes; ++k)
    {
      group.nodes.push_back(k * stride);
      std::copy_n(&coordinates[std::size_t(cell.vertices[k / lanes]) * stride], stride,
                  &points[std::size_t(k) * stride]);
    }
  set_shapes(group, points.data());

  // Value at corner @p v of the field with a single mode.
  const auto shape = [&](const unsigned int mode, const unsigned int v) {
    if (simplex)
      return v == mode ? 1. : 0.;
    return (kernels::mode_block(false, mode & ~v) % 2 == 0 ? 1. : -1.) / n_corners;
  };
  std::vector<double> K;
  const auto add_forces = [&](const int block) {
    for (unsigned int mode = 1; mode < n_corners; ++mode)
      for (unsigned int c = 0; c < dim && kernels::mode_block(simplex, mode) == block;
           ++c)
        {
          double sum = 0.;
          for (unsigned int v = 0; v < n_corners; ++v)
            sum += shape(mode, v) * f[v * lanes * stride + c];
          K.push_back(sum);
        }
  };
  for (int block = 1; block <= (simplex ? 1 : dim); ++block)
    for (unsigned int mode = 1; mode < n_corners; ++mode)
      for (unsigned int c = 0; c < dim && kernels::mode_block(simplex, mode) == block;
           ++c)
        {
          std::fill(u.begin(), u.end(), 0.);
          std::fill(f.begin(), f.end(), 0.);
          for (unsigned int v = 0; v < n_corners; ++v)
            u[v * lanes * stride + c] = shape(mode, v);
          function(group)(batches(group), u.data(), f.data());
          add_forces(block);
        }
  return K;
}

template <int dim>
std::vector<typename ElementOperator<dim>::Group>
ElementOperator<dim>::make_groups(const std::vector<dealii::Point<dim>> &points,
                                  const Cells &cells)
{
  const std::vector<int> matrix = find_congruent(points, cells);
  // Groups by kind and CellMaterial; cells waiting for a full batch, by phase or matrix.
  std::array<std::array<Group, 3>, 2> groups;
  std::array<std::array<std::map<std::uint32_t, std::vector<std::uint32_t>>, 3>, 2>
    waiting;
  for (const std::size_t k :
       spread_out<dim>(cells, points.size(), std::size_t{2} * lanes<double>))
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
        set_shapes(group, coordinates.data());
        result.push_back(std::move(group));
      }
  return result;
}

/** Adds a batch to the nodes of a group, filled up with dummy cells; clears it. */
template <int dim>
void ElementOperator<dim>::finish_batch(const unsigned int n_corners,
                                        std::vector<std::uint32_t> &cells,
                                        Group &group) const
{
  const std::size_t n = cells.size() / n_corners;
  for (unsigned int v = 0; v < n_corners; ++v)
    for (std::size_t l = 0; l < kernels.cells_at_once; ++l)
      {
        // A simplex has the corners 0, e_x, e_y, e_z.
        const unsigned int corner = n_corners == dim + 1 && v > 0 ? 1U << (v - 1) : v;
        const std::uint32_t node =
          l < n ? cells[l * n_corners + v] : first_dummy + corner;
        group.nodes.push_back(node * kernels::node_stride<dim>);
      }
  cells.clear();
}

template class ElementOperator<2>;
template class ElementOperator<3>;
} // namespace mesoslip
