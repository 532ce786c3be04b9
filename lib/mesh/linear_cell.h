#ifndef mesoslip_mesh_linear_cell_h
#define mesoslip_mesh_linear_cell_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/quadrature.h>

namespace mesoslip
{
/**
 * The reference cell of linear shape functions: a simplex, or a hypercube with the first axis
 * running fastest over its corners, as in deal.II, whose class of this purpose is another one
 * in each of its releases.
 */
template <int dim>
class LinearCell
{
public:
  /** That with so many corners. */
  explicit LinearCell(const std::size_t n_corners);

  /** Exact for gradients and volumes of bi- and trilinear cells: two Gauss points along each
   * axis, on simplices as deal.II has it. */
  dealii::Quadrature<dim> quadrature() const;

  /** Corner @p v. */
  dealii::Point<dim> corner(const unsigned int v) const;

  /** The mean of the corners. */
  dealii::Point<dim> barycenter() const;

  /** Shape function of corner @p v at @p xi. */
  double shape(const dealii::Point<dim> &xi, const unsigned int v) const;

  /** Its gradient. */
  dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &xi,
                                  const unsigned int v) const;

  /** In 2D of edges. */
  unsigned int n_faces() const
  {
    return is_simplex ? dim + 1 : 2 * dim;
  }

  /** Of face @p f in two or three dimensions, those of a quadrilateral row by row. */
  dealii::ArrayView<const unsigned int> corners_of_face(const unsigned int f) const;

private:
  bool is_simplex;
};
} // namespace mesoslip

#endif
