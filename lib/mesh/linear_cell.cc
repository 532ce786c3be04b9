#include "mesh/linear_cell.h"

#include <deal.II/base/quadrature_lib.h>

#include <array>

namespace mesoslip
{
template <int dim>
LinearCell<dim>::LinearCell(const std::size_t n_corners)
  : is_simplex(dim > 1 && n_corners == dim + 1)
{
  Assert(is_simplex || n_corners == 1U << dim,
         dealii::ExcMessage("a cell is a simplex or a hypercube"));
}

template <int dim>
dealii::Quadrature<dim> LinearCell<dim>::quadrature() const
{
  if (is_simplex)
    return dealii::QGaussSimplex<dim>(2);
  return dealii::QGauss<dim>(2);
}

template <int dim>
dealii::Point<dim> LinearCell<dim>::corner(const unsigned int v) const
{
  dealii::Point<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = is_simplex ? v == d + 1 : v >> d & 1U;
  return result;
}

template <int dim>
dealii::Point<dim> LinearCell<dim>::barycenter() const
{
  dealii::Point<dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = is_simplex ? 1. / (dim + 1) : 0.5;
  return result;
}

template <int dim>
double LinearCell<dim>::shape(const dealii::Point<dim> &xi, const unsigned int v) const
{
  if (is_simplex && v > 0)
    return xi[v - 1];
  double value = 1.;
  for (unsigned int d = 0; d < dim; ++d)
    if (is_simplex)
      value -= xi[d];
    else
      value *= (v >> d & 1U) != 0 ? xi[d] : 1. - xi[d];
  return value;
}

template <int dim>
dealii::Tensor<1, dim> LinearCell<dim>::gradient(const dealii::Point<dim> &xi,
                                                 const unsigned int v) const
{
  dealii::Tensor<1, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    if (is_simplex)
      result[d] = v == 0 ? -1. : v == d + 1 ? 1. : 0.;
    else
      {
        result[d] = (v >> d & 1U) != 0 ? 1. : -1.;
        for (unsigned int e = 0; e < dim; ++e)
          if (e != d)
            result[d] *= (v >> e & 1U) != 0 ? xi[e] : 1. - xi[e];
      }
  return result;
}

template <int dim>
dealii::ArrayView<const unsigned int>
LinearCell<dim>::corners_of_face(const unsigned int f) const
{
  AssertIndexRange(f, n_faces());
  static constexpr std::array<std::array<unsigned int, 2>, 3> triangle = {
    {{{0, 1}}, {{1, 2}}, {{2, 0}}}};
  static constexpr std::array<std::array<unsigned int, 2>, 4> square = {
    {{{0, 2}}, {{1, 3}}, {{0, 1}}, {{2, 3}}}};
  static constexpr std::array<std::array<unsigned int, 3>, 4> tetrahedron = {
    {{{0, 1, 2}}, {{1, 0, 3}}, {{0, 2, 3}}, {{2, 1, 3}}}};
  static constexpr std::array<std::array<unsigned int, 4>, 6> cube = {{{{0, 2, 4, 6}},
                                                                       {{1, 3, 5, 7}},
                                                                       {{0, 4, 1, 5}},
                                                                       {{2, 6, 3, 7}},
                                                                       {{0, 1, 2, 3}},
                                                                       {{4, 5, 6, 7}}}};
  if (dim == 2)
    return {is_simplex ? triangle[f].data() : square[f].data(), 2};
  if (is_simplex)
    return {tetrahedron[f].data(), 3};
  return {cube[f].data(), 4};
}

template class LinearCell<1>;
template class LinearCell<2>;
template class LinearCell<3>;
} // namespace mesoslip
