// Kernels of general cells for one instruction set, see element_kernel.h. Compiled once
// for each set, see kernel_variants.h.
#include "elasticity/element_kernel.h"

#ifdef __x86_64__
#  include <immintrin.h>
#endif

// GCC 12 warns about its own headers, which leave halves of vectors uninitialized on
// purpose.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"

namespace mesoslip::kernels::MESOSLIP_VARIANT
{
#include "elasticity/simd.h"
//
#include "elasticity/node_transpose.h"
//
#include "elasticity/cell_stream.h"
//
#include "elasticity/element_gradients.h"
//
#include "elasticity/element_modes.h"
//
#include "elasticity/hexahedron.h"
//
#include "elasticity/quadrilateral.h"

/**
 * ShapeFunction of simplices: adj(J) / det(J) times the square root of the volume, det(J)
 * / dim!.
 */
template <int dim>
static void simplex_shapes(const CellBatches &cells, const double *points, double *shapes)
{
  constexpr double volume = dim == 2 ? 1. / 2. : 1. / 6.;
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      vdouble x[dim + 1][dim], J[dim][dim], A[dim][dim];
      for (int i = 0; i < dim + 1; ++i)
        load_nodes(points, corner(cells.nodes, k * (dim + 1) + i), x[i]);
      to_modes<dim>(x);
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c)
          J[c][d] = x[d + 1][c];
      const vdouble determinant = adjugate(J, A);
      const vdouble scale       = square_root(splat(volume) / determinant);
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c, shapes += n_lanes)
          store(shapes, scale * A[d][c]);
    }
}

/** ShapeFunction of quadrilaterals and hexahedra. */
template <int dim>
static void tensor_shapes(const CellBatches &cells, const double *points, double *shapes)
{
  constexpr int n_corners = 1 << dim;
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      vdouble x[n_corners][dim];
      for (int i = 0; i < n_corners; ++i)
        load_nodes(points, corner(cells.nodes, k * n_corners + i), x[i]);
      to_modes<dim>(x);
      scale_modes<dim>(x);
      for (int i = 1; i < n_corners; ++i)
        for (int c = 0; c < dim; ++c, shapes += n_lanes)
          store(shapes, x[i][c]);
    }
}

/** CellFunction of triangles and tetrahedra. */
template <int dim, bool anisotropic>
static void multiply_simplex(const CellBatches &cells, const double *u, double *f)
{
  CellStream<dim, dim + 1> stream(cells, u, f);
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      vdouble value[dim + 1][dim], gradient[dim][dim], A[dim][dim];
      stream.start(k, value);
      to_modes<dim>(value);
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c)
          {
            gradient[d][c] = value[d + 1][c];
            A[d][c]        = stream.shape(d + 1, c);
          }
      const double *C =
        cells.stiffness + cells.material[k] * n_components<dim> * n_components<dim>;
      vdouble strain[n_components<dim>], stress[n_components<dim>];
      strain_from_gradients<dim>(gradient, A, strain);
      stream.move(0);
      multiply_stiffness<dim, anisotropic>(C, strain, stress);
      stream.move(1);
      forces_from_stress<dim>(stress, A, gradient);
      for (int i = 2; i < dim + 1; ++i)
        stream.move(i);
      for (int d = 0; d < dim; ++d)
        for (int c = 0; c < dim; ++c)
          value[d + 1][c] = gradient[d][c];
      from_modes<dim>(value);
      stream.finish(value);
    }
  stream.end();
}

/** CellFunction of congruent cells, see mode_block(). */
template <int dim, int n_corners>
static void multiply_matrix(const CellBatches &cells, const double *u, double *f)
{
  constexpr bool simplex = is_simplex<dim, n_corners>;
  CellStream<dim, n_corners, false> stream(cells, u, f);
  for (std::size_t k = 0; k < cells.n; ++k)
    {
      vdouble value[n_corners][dim], force[n_corners][dim] = {};
      stream.start(k, value);
      to_modes<dim>(value);
      const double *K =
        &cells.stiffness[n_matrix_numbers<dim>(n_corners) * cells.material[k]];
      stream.move(0);
#pragma GCC unroll 8
      for (int block = 1; block <= (simplex ? 1 : dim); ++block)
#pragma GCC unroll 8
        for (int j = 1; j < n_corners; ++j)
          if (mode_block(simplex, j) == block)
            {
#pragma GCC unroll 4
              for (int c = 0; c < dim; ++c)
#pragma GCC unroll 8
                for (int i = 1; i < n_corners; ++i)
                  if (mode_block(simplex, i) == block)
                    for (int d = 0; d < dim; ++d)
                      force[i][d] = fma(splat(*K++), value[j][c], force[i][d]);
              stream.move(j);
            }
      from_modes<dim>(force);
      stream.finish(force);
    }
  stream.end();
}

template <int dim>
static void advance_nodes(const NodeArrays &nodes, const NodeStep &step)
{
  const double alpha = step.alpha;
  for (std::size_t first = 0; first < nodes.n; first += n_lanes)
    {
      vdouble force[dim], z[dim];
      load_row(nodes.force + node_stride<dim> * first, force);
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
          force[c] = fma(splat(alpha), w_new, splat(-step.acceleration[c])) * mass;
        }
      store_row(nodes.z + node_stride<dim> * first, z);
      store_row(nodes.force + node_stride<dim> * first, force);
    }
}

/** Calls the kernel for cells with excess, or the kernel for cells without. */
template <CellFunction with_excess, CellFunction without>
static void multiply_tensor(const CellBatches &cells, const double *u, double *f)
{
  (cells.excess != nullptr ? with_excess : without)(cells, u, f);
}

CellKernels plane_cell_kernels()
{
  return {
    &advance_nodes<2>,
    {&simplex_shapes<2>, &tensor_shapes<2>},
    {&multiply_simplex<2, false>, &multiply_simplex<2, true>, &multiply_matrix<2, 3>},
    {&multiply_tensor<multiply_quadrilaterals<false, true>,
                      multiply_quadrilaterals<false, false>>,
     &multiply_tensor<multiply_quadrilaterals<true, true>,
                      multiply_quadrilaterals<true, false>>,
     &multiply_matrix<2, 4>},
    n_lanes};
}

CellKernels solid_cell_kernels()
{
  return {
    &advance_nodes<3>,
    {&simplex_shapes<3>, &tensor_shapes<3>},
    {&multiply_simplex<3, false>, &multiply_simplex<3, true>, &multiply_matrix<3, 4>},
    {&multiply_tensor<multiply_hexahedra<false, true>, multiply_hexahedra<false, false>>,
     &multiply_tensor<multiply_hexahedra<true, true>, multiply_hexahedra<true, false>>,
     &multiply_matrix<3, 8>},
    n_lanes};
}
} // namespace mesoslip::kernels::MESOSLIP_VARIANT
