#ifndef mesoslip_mesh_linear_cell_h
#define mesoslip_mesh_linear_cell_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/quadrature.h>

namespace mesoslip
{
/**
 * The reference cell of linear shape functions: a simplex, or a hypercube whose first
 * axis runs fastest over the corners, as in deal.II. Replaces deal.II's class for this
 * purpose, which differs between releases.
 */
template <int dim>
class LinearCell
{
public:
  /** The reference cell with @p n_corners corners. */
  explicit LinearCell(const std::size_t n_corners);

  /** Exact for gradients and volumes of bi- and trilinear cells: two Gauss points along each
   * axis, on simplices as deal.II has it. */
  dealii::Quadrature<dim> quadrature() const;

  /** Reference coordinates of corner @p v. */
  dealii::Point<dim> corner(const unsigned int v) const;

  /** The mean of the corners. */
  dealii::Point<dim> barycenter() const;

  /** Shape function of corner @p v at @p xi. */
  double shape(const dealii::Point<dim> &xi, const unsigned int v) const;

  /** Gradient of the shape function of corner @p v at @p xi. */
  dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &xi,
                                  const unsigned int v) const;

  /** Number of faces; in 2D edges. */
  unsigned int n_faces() const
  {
    return is_simplex ? dim + 1 : 2 * dim;
  }

  /** Corners of face @p f in 2D or 3D; for a quadrilateral row by row. */
  dealii::ArrayView<const unsigned int> corners_of_face(const unsigned int f) const;

private:
  bool is_simplex;
};
} // namespace mesoslip

#endif
