#include "localization/strain/slope_fits.h"

#include "mesh/cell_shapes.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>

namespace mesoslip
{
namespace
{
/** Least-squares weights (1 / distance^2) with which differences of values at @p places
 * from the value at the origin form the gradient. */
template <int dim>
struct Fit
{
  explicit Fit(const std::vector<dealii::Tensor<1, dim>> &places)
  {
    const auto n = static_cast<Eigen::Index>(places.size());
    Eigen::Matrix<double, Eigen::Dynamic, dim> A(n, dim);
    for (Eigen::Index k = 0; k < n; ++k)
      for (unsigned int d = 0; d < dim; ++d)
        A(k, d) = places[k][d] / places[k].norm();
    // The slope is zero in directions without neighbours.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(0.1);
    solver.compute(A);
    spans = solver.rank() == dim;
    const Eigen::MatrixXd inverse =
      n > 0 ? solver.pseudoInverse() : Eigen::MatrixXd(dim, 0);
    for (Eigen::Index k = 0; k < n; ++k)
      {
        auto &weight = weights.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          weight[d] = inverse(d, k) / places[k].norm();
      }
  }

  std::vector<dealii::Tensor<1, dim>> weights;
  bool spans; ///< whether the gradient is fully determined
};
} // namespace

template <int dim>
SlopeFits<dim>::SlopeFits(const Mesh<dim> &of_mesh)
  : cells_of_point(of_mesh.points.size())
  , mesh(of_mesh)
{
  for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
    for (const unsigned int point : mesh.cells[cell].vertices)
      cells_of_point[point].push_back(cell);
}

// Cells with dim points in common share a face: two points in 2D, three in 3D.
template <int dim>
std::vector<unsigned int> SlopeFits<dim>::face_neighbours(const unsigned int cell) const
{
  std::map<unsigned int, unsigned int> n_common;
  for (const unsigned int point : mesh.cells[cell].vertices)
    for (const unsigned int other : cells_of_point[point])
      ++n_common[other];
  std::vector<unsigned int> result;
  for (const auto &[other, n] : n_common)
    if (other != cell && n >= dim)
      result.push_back(other);
  return result;
}

template <int dim>
std::vector<SlopeWeight<dim>> SlopeFits<dim>::of(const unsigned int cell) const
{
  const auto centroid_of = [this](const unsigned int k) {
    return cell_measure(mesh, mesh.cells[k].vertices).centroid;
  };
  const dealii::Point<dim> centroid = centroid_of(cell);
  const auto fit_to                 = [&](const std::vector<unsigned int> &others) {
    std::vector<dealii::Tensor<1, dim>> places;
    for (const unsigned int other : others)
      places.push_back(centroid_of(other) - centroid);
    return Fit<dim>(places);
  };
  std::vector<unsigned int> others = face_neighbours(cell);
  Fit<dim> fit                     = fit_to(others);
  if (!fit.spans)
    {
      for (const unsigned int near : std::vector<unsigned int>(others))
        for (const unsigned int next : face_neighbours(near))
          if (next != cell &&
              std::find(others.begin(), others.end(), next) == others.end())
            others.push_back(next);
      fit = fit_to(others);
    }
  std::vector<SlopeWeight<dim>> weights;
  for (std::size_t k = 0; k < others.size(); ++k)
    weights.push_back({others[k], fit.weights[k]});
  return weights;
}

template class SlopeFits<2>;
template class SlopeFits<3>;
} // namespace mesoslip
