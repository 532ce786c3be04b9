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

/** Distance of the Gauss points from the nearer end of [0, 1]: (1 - 1/sqrt(3)) / 2. */
constexpr double gauss_distance = 0.21132486540518711775;

template <int dim>
constexpr int n_components = dim *(dim + 1) / 2;

/** Voigt index of component (i, j). */
template <int dim>
constexpr int voigt_index(const int i, const int j)
{
  return i == j ? i : dim == 2 ? 2 : 6 - i - j;
}

/** The lower end of edge @p e along axis @p d of a quadrilateral or hexahedron. */
constexpr int lower_corner(const int d, const int e)
{
  return (e & ((1 << d) - 1)) | ((e >> d) << (d + 1));
}

/** Interpolates from the ends of [0, 1] to the Gauss points in place; also the transpose
 * of this. */
MESOSLIP_INLINE void interpolate(vdouble &a, vdouble &b)
{
  const vdouble difference = b - a;
  a                        = fma(splat(gauss_distance), difference, a);
  b                        = fnma(splat(gauss_distance), difference, b);
}

/** interpolate() along all axes but one of the values at the edges along this one. */
template <int dim>
MESOSLIP_INLINE void interpolate_edges(vdouble (&edge)[1 << (dim - 1)])
{
  for (int axis = 0; axis < dim - 1; ++axis)
    for (int e = 0; e < 1 << (dim - 1); ++e)
      if (!(e & (1 << axis)))
        interpolate(edge[e], edge[e | (1 << axis)]);
}

/** Derivatives along the reference axes: [axis][component][Gauss point of the others]. */
template <int dim>
MESOSLIP_INLINE void reference_gradients(const vdouble (&corner)[1 << dim][dim],
                                         vdouble (&gradient)[dim][dim][1 << (dim - 1)])
{
  for (int d = 0; d < dim; ++d)
    for (int c = 0; c < dim; ++c)
      {
        for (int e = 0; e < 1 << (dim - 1); ++e)
          {
            const int lower   = lower_corner(d, e);
            gradient[d][c][e] = corner[lower | (1 << d)][c] - corner[lower][c];
          }
        interpolate_edges<dim>(gradient[d][c]);
      }
}

/** adj(J) with adj(J) J = det(J), which is returned; J[c][d] = dx_c / dxi_d. */
MESOSLIP_INLINE vdouble adjugate(const vdouble (&J)[2][2], vdouble (&A)[2][2])
{
  A[0][0] = J[1][1];
  A[0][1] = -J[0][1];
  A[1][0] = -J[1][0];
  A[1][1] = J[0][0];
  return fnma(J[0][1], J[1][0], J[0][0] * J[1][1]);
}

MESOSLIP_INLINE vdouble adjugate(const vdouble (&J)[3][3], vdouble (&A)[3][3])
{
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c)
      {
        const int c1 = (c + 1) % 3, c2 = (c + 2) % 3, d1 = (d + 1) % 3, d2 = (d + 2) % 3;
        A[d][c] = fnma(J[c1][d2], J[c2][d1], J[c1][d1] * J[c2][d2]);
      }
  return fma(J[0][2], A[2][0], fma(J[0][1], A[1][0], J[0][0] * A[0][0]));
}

/** a[0] b[0] + a[1] b[1] + ..., where @p a and @p b are functions of the index. */
template <int n, typename A, typename B>
MESOSLIP_INLINE vdouble sum_of_products(const A &a, const B &b)
{
  vdouble sum = a(0) * b(0);
  for (int i = 1; i < n; ++i)
    sum = fma(a(i), b(i), sum);
  return sum;
}

template <int dim, bool anisotropic>
MESOSLIP_INLINE void multiply_stiffness(const double *C,
                                        const vdouble (&strain)[n_components<dim>],
                                        vdouble (&stress)[n_components<dim>])
{
  constexpr int n = n_components<dim>;
  const auto e    = [&](const int j) { return strain[j]; };
  for (int i = 0; i < n; ++i)
    {
      const auto row = [&](const int j) { return splat(C[i * n + j]); };
      if constexpr (anisotropic)
        stress[i] = sum_of_products<n>(row, e);
      else
        stress[i] = i < dim ? sum_of_products<dim>(row, e) : row(i) * e(i);
    }
}

/** From reference gradients [axis][component] of the displacement to the forces along
 * them, @p weight times sigma adj(J)^T, in place. */
template <int dim, bool anisotropic>
MESOSLIP_INLINE void gradient_to_force(const double *C,
                                       const double weight,
                                       const vdouble (&J)[dim][dim],
                                       vdouble (&gradient)[dim][dim])
{
  vdouble A[dim][dim], du[dim][dim];
  const vdouble scale = splat(weight) / adjugate(J, A);
  for (int c = 0; c < dim; ++c)
    for (int j = 0; j < dim; ++j)
      du[c][j] = sum_of_products<dim>([&](const int d) { return gradient[d][c]; },
                                      [&](const int d) { return A[d][j]; });
  vdouble strain[n_components<dim>], stress[n_components<dim>];
  for (int i = 0; i < dim; ++i)
    {
      strain[i] = scale * du[i][i];
      for (int j = i + 1; j < dim; ++j)
        strain[voigt_index<dim>(i, j)] = scale * (du[i][j] + du[j][i]);
    }
  multiply_stiffness<dim, anisotropic>(C, strain, stress);
  for (int c = 0; c < dim; ++c)
    for (int d = 0; d < dim; ++d)
      gradient[d][c] =
        sum_of_products<dim>([&](const int j) { return stress[voigt_index<dim>(c, j)]; },
                             [&](const int j) { return A[d][j]; });
}

/** The nodes of corner @p i of a batch. */
MESOSLIP_INLINE const std::uint32_t *corner(const std::uint32_t *nodes,
                                            const std::size_t i)
{
  return nodes + i * n_lanes;
}

/** Triangles and tetrahedra. */
template <int dim, bool anisotropic>
static void multiply_simplex(const CellBatches &cells,
                             const double *points,
                             const double *u,
                             double *f)
{
  constexpr double volume = dim == 2 ? 1. / 2. : 1. / 6.;
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      const std::uint32_t *node = cells.nodes + k * (dim + 1) * n_lanes;
      vdouble x[dim + 1][dim], v[dim + 1][dim], J[dim][dim], g[dim][dim];
      for (int i = 0; i <= dim; ++i)
        {
          load_nodes(points, corner(node, i), x[i]);
          load_nodes(u, corner(node, i), v[i]);
        }
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c)
          {
            J[c][d] = x[d + 1][c] - x[0][c];
            g[d][c] = v[d + 1][c] - v[0][c];
          }
      const double *C =
        cells.stiffness + cells.material[k] * n_components<dim> * n_components<dim>;
      gradient_to_force<dim, anisotropic>(C, volume, J, g);
      vdouble opposite[dim] = {};
      for (int d = 0; d < dim; ++d)
        {
          for (int c = 0; c < dim; ++c)
            opposite[c] -= g[d][c];
          put_nodes<true>(f, corner(node, d + 1), g[d]);
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
#pragma GCC unroll 32
            for (int i = 0; i < n_rows; ++i)
              sum[i] = fma(splat(K[j * n_dofs + row + i]), v[j / dim][j % dim], sum[i]);
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
