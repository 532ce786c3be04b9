// The kernels of general cells for one instruction set, see element_kernel.h. Compiled
// once for each set, see kernel_variants.h.
#include "elasticity/element_kernel.h"

#include <cstring>

#ifdef __x86_64__
#  include <immintrin.h>
#endif

// GCC 12 warns about its own headers, where halves of vectors are left open on purpose.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

namespace mesoslip::kernels::MESOSLIP_VARIANT
{
#include "elasticity/simd.h"
//
#include "elasticity/node_transpose.h"
//
#include "elasticity/element_gradients.h"

/** The nodes of corner @p i of a batch. */
MESOSLIP_INLINE const std::uint32_t *corner(const std::uint32_t *nodes,
                                            const std::size_t i)
{
  return nodes + i * n_lanes;
}

/** See SimplexFunction: adj(J) / det(J) times the root of the volume, det(J) / dim!. */
template <int dim>
static void
simplex_gradients(const CellBatches &cells, const double *points, double *gradients)
{
  constexpr double volume = dim == 2 ? 1. / 2. : 1. / 6.;
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      const std::uint32_t *node = cells.nodes + k * (dim + 1) * n_lanes;
      vdouble first[dim], x[dim], J[dim][dim], A[dim][dim];
      load_nodes(points, node, first);
      for (int d = 0; d < dim; ++d)
        {
          load_nodes(points, corner(node, d + 1), x);
          for (int c = 0; c < dim; ++c)
            J[c][d] = x[c] - first[c];
        }
      const vdouble determinant = adjugate(J, A);
      const vdouble scale       = square_root(splat(volume) / determinant);
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c)
          store(gradients + ((k * dim + d) * dim + c) * n_lanes, scale * A[d][c]);
    }
}

/** Triangles and tetrahedra. */
template <int dim, bool anisotropic>
static void
multiply_simplex(const CellBatches &cells, const double *, const double *u, double *f)
{
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      const std::uint32_t *node = cells.nodes + k * (dim + 1) * n_lanes;
      const double *gradients   = cells.gradients + k * dim * dim * n_lanes;
      vdouble first[dim], v[dim][dim], A[dim][dim];
      load_nodes(u, node, first);
      for (int d = 0; d < dim; ++d)
        {
          load_nodes(u, corner(node, d + 1), v[d]);
          for (int c = 0; c < dim; ++c)
            {
              v[d][c] -= first[c];
              A[d][c] = load(gradients + std::size_t(d * dim + c) * n_lanes);
            }
        }
      const double *C =
        cells.stiffness + cells.material[k] * n_components<dim> * n_components<dim>;
      vdouble strain[n_components<dim>], stress[n_components<dim>], opposite[dim] = {};
      strain_from_gradients<dim>(v, A, strain);
      multiply_stiffness<dim, anisotropic>(C, strain, stress);
      forces_from_stress<dim>(stress, A, v);
      for (int d = 0; d < dim; ++d)
        {
          for (int c = 0; c < dim; ++c)
            opposite[c] -= v[d][c];
          put_nodes<true>(f, corner(node, d + 1), v[d]);
        }
      put_nodes<true>(f, node, opposite);
    }
}

/** Quadrilaterals and hexahedra. */
template <int dim, bool anisotropic>
static void multiply_tensor(const CellBatches &cells,
                            const double *points,
                            const double *u,
                            double *f)
{
  constexpr int n_corners = 1 << dim, n_edges = n_corners / 2;
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      const std::uint32_t *node = cells.nodes + k * n_corners * n_lanes;
      vdouble value[n_corners][dim];
      vdouble x[dim][dim][n_edges], v[dim][dim][n_edges], force[dim][dim][n_edges] = {};
      for (int i = 0; i < n_corners; ++i)
        load_nodes(points, corner(node, i), value[i]);
      reference_gradients<dim>(value, x);
      for (int i = 0; i < n_corners; ++i)
        load_nodes(u, corner(node, i), value[i]);
      reference_gradients<dim>(value, v);

      const double *C =
        cells.stiffness + cells.material[k] * n_components<dim> * n_components<dim>;
#pragma GCC unroll 8
      for (int q = 0; q < n_corners; ++q)
        {
          vdouble J[dim][dim], g[dim][dim];
          const auto edge = [&](const int d) {
            return (q & ((1 << d) - 1)) | ((q >> (d + 1)) << d);
          };
          for (int d = 0; d < dim; ++d)
            for (int c = 0; c < dim; ++c)
              {
                J[c][d] = x[d][c][edge(d)];
                g[d][c] = v[d][c][edge(d)];
              }
          gradient_to_force<dim, anisotropic>(C, 1. / n_corners, J, g);
          for (int d = 0; d < dim; ++d)
            for (int c = 0; c < dim; ++c)
              force[d][c][edge(d)] += g[d][c];
        }

      for (int i = 0; i < n_corners; ++i)
        for (int c = 0; c < dim; ++c)
          value[i][c] = vdouble{};
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c)
          {
            interpolate_edges<dim>(force[d][c]);
            for (int e = 0; e < n_edges; ++e)
              {
                const int lower = lower_corner(d, e);
                value[lower][c] -= force[d][c][e];
                value[lower | (1 << d)][c] += force[d][c][e];
              }
          }
      for (int i = 0; i < n_corners; ++i)
        put_nodes<true>(f, corner(node, i), value[i]);
    }
}

/** Congruent cells: the element matrix times displacements relative to the first corner,
 * on which the opposite of the other forces acts; as many rows at once as registers hold.
 */
template <int dim, int n_corners>
static void
multiply_matrix(const CellBatches &cells, const double *, const double *u, double *f)
{
  constexpr int n_dofs = dim * (n_corners - 1);
  constexpr int n_rows = n_dofs > 12 && n_lanes < 8 ? 7 : n_dofs;
  static_assert(n_dofs % n_rows == 0, "rows are taken in equal groups");
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      const std::uint32_t *node = cells.nodes + k * n_corners * n_lanes;
      vdouble first[dim], v[n_corners - 1][dim], force[n_corners - 1][dim],
        rest[dim] = {};
      load_nodes(u, node, first);
      for (int i = 0; i < n_corners - 1; ++i)
        {
          load_nodes(u, corner(node, i + 1), v[i]);
          for (int c = 0; c < dim; ++c)
            v[i][c] -= first[c];
        }
      const double *K =
        &cells.stiffness[std::size_t{n_dofs} * n_dofs * cells.material[k]];
      for (int row = 0; row < n_dofs; row += n_rows)
        {
          vdouble sum[n_rows] = {};
          for (int j = 0; j < n_dofs; ++j)
            {
#pragma GCC unroll 32
              for (int i = 0; i < n_rows; ++i)
                sum[i] = fma(splat(K[j * n_dofs + row + i]), v[j / dim][j % dim], sum[i]);
            }
#pragma GCC unroll 32
          for (int i = 0; i < n_rows; ++i)
            force[(row + i) / dim][(row + i) % dim] = sum[i];
        }
      for (int i = 0; i < n_corners - 1; ++i)
        {
          for (int c = 0; c < dim; ++c)
            rest[c] -= force[i][c];
          put_nodes<true>(f, corner(node, i + 1), force[i]);
        }
      put_nodes<true>(f, node, rest);
    }
}

template <int dim>
static void advance_nodes(const NodeArrays &nodes, const NodeStep &step)
{
  for (std::size_t first = 0; first < nodes.n; first += n_lanes)
    {
      std::uint32_t node[n_lanes];
      for (unsigned int l = 0; l < n_lanes; ++l)
        node[lane_order<dim>[l]] = static_cast<std::uint32_t>(first + l);
      vdouble force[dim], z[dim];
      load_nodes(nodes.force, node, force);
      const vdouble mass = nodes.mass == nullptr ? vdouble{} : load(nodes.mass + first);
      for (int c = 0; c < dim; ++c)
        {
          const vdouble w_old = load(nodes.w[c] + first);
          const vdouble w_new =
            fnma(splat(step.dt) * load(nodes.inverse_mass[c] + first), force[c], w_old);
          const vdouble u = fma(splat(step.c_new), w_new,
                                fma(splat(step.c_old), w_old, load(nodes.u[c] + first)));
          store(nodes.w[c] + first, w_new);
          store(nodes.u[c] + first, u);
          z[c]     = fma(splat(step.beta), w_new, u);
          force[c] = splat(-step.acceleration[c]) * mass;
        }
      put_nodes<false>(nodes.z, node, z);
      put_nodes<false>(nodes.force, node, force);
    }
}

template <int dim>
static CellKernels cell_kernels()
{
  return {&advance_nodes<dim>,
          &simplex_gradients<dim>,
          {&multiply_simplex<dim, false>, &multiply_simplex<dim, true>,
           &multiply_matrix<dim, dim + 1>},
          {&multiply_tensor<dim, false>, &multiply_tensor<dim, true>,
           &multiply_matrix<dim, 1 << dim>},
          n_lanes};
}

CellKernels plane_cell_kernels()
{
  return cell_kernels<2>();
}

CellKernels solid_cell_kernels()
{
  return cell_kernels<3>();
}
} // namespace mesoslip::kernels::MESOSLIP_VARIANT
