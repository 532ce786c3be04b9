#ifndef mesoslip_mesh_linear_shape_h
#define mesoslip_mesh_linear_shape_h

#include <deal.II/grid/reference_cell.h>

namespace mesoslip
{
/** Simplex or hypercube. */
template <int dim>
dealii::ReferenceCell reference_cell(const std::size_t n_vertices)
{
  return dealii::ReferenceCell::n_vertices_to_type(dim,
                                                   static_cast<unsigned int>(n_vertices));
}

/**
 * Gradient of the linear shape function of vertex @p v at @p xi in the reference cell.
 * Of tetrahedra deal.II 9.4.1 says (0, 0, 0).
 */
template <int dim>
dealii::Tensor<1, dim> linear_shape_gradient(const dealii::ReferenceCell &cell,
                                             const dealii::Point<dim> &xi,
                                             const unsigned int v)
{
  if (cell.is_hyper_cube())
    return cell.template d_linear_shape_function_gradient<dim>(xi, v);
  dealii::Tensor<1, dim> gradient;
  for (unsigned int d = 0; d < dim; ++d)
    gradient[d] = v == 0 ? -1. : v == d + 1 ? 1. : 0.;
  return gradient;
}
} // namespace mesoslip

#endif
