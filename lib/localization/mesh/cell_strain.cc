#include "localization/mesh/cell_strain.h"

#include "mesh/cell_gradients.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <map>

namespace mesoslip
{
namespace
{
/** Cells that share a face with each cell, in ascending order. */
template <int dim>
class FaceNeighbours
{
public:
  explicit FaceNeighbours(const Mesh<dim> &mesh)
    : cells_of_point(mesh.points.size())
    , mesh(mesh)
  {
    for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
      for (const unsigned int point : mesh.cells[cell].vertices)
        cells_of_point[point].push_back(cell);
  }

  // Cells with dim points in common share a face: two points in 2D, three in 3D.
  std::vector<unsigned int> of(const unsigned int cell) const
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

private:
  std::vector<std::vector<unsigned int>> cells_of_point;
  const Mesh<dim> &mesh;
};

/** Weights of the differences of values at @p places from that at the origin in the
 * gradient there: least squares with weights 1 / distance^2. */
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
    // Directions in which there is hardly a neighbour have no slope.
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
CellStrain<dim>::CellStrain(const Mesh<dim> &mesh,
                            const std::vector<unsigned int> &wanted,
                            const bool only_means)
{
  const std::vector<unsigned int> cells =
    only_means ? wanted : add_neighbours(mesh, wanted);
  add_corners(mesh, cells);
  mean.resize(cells.size());
}

template <int dim>
std::vector<unsigned int>
CellStrain<dim>::add_neighbours(const Mesh<dim> &mesh,
                                const std::vector<unsigned int> &wanted)
{
  const FaceNeighbours<dim> face_neighbours(mesh);
  const auto centroid_of = [&mesh](const unsigned int cell) {
    return cell_measure(mesh, mesh.cells[cell].vertices).centroid;
  };
  std::vector<unsigned int> cells = wanted;
  std::map<unsigned int, std::size_t> number;
  for (std::size_t k = 0; k < wanted.size(); ++k)
    number.emplace(wanted[k], k);
  for (const unsigned int cell : wanted)
    {
      centroid.push_back(centroid_of(cell));
      const auto fit_to = [&](const std::vector<unsigned int> &others) {
        std::vector<Tensor> places;
        for (const unsigned int other : others)
          places.push_back(centroid_of(other) - centroid.back());
        return Fit<dim>(places);
      };
      std::vector<unsigned int> others = face_neighbours.of(cell);
      Fit<dim> fit                     = fit_to(others);
      if (!fit.spans)
        {
          for (const unsigned int near : std::vector<unsigned int>(others))
            for (const unsigned int next : face_neighbours.of(near))
              if (next != cell &&
                  std::find(others.begin(), others.end(), next) == others.end())
                others.push_back(next);
          fit = fit_to(others);
        }
      first_neighbour.push_back(neighbours.size());
      for (std::size_t k = 0; k < others.size(); ++k)
        {
          const auto [entry, is_new] = number.emplace(others[k], cells.size());
          if (is_new)
            cells.push_back(others[k]);
          neighbours.push_back({entry->second, fit.weights[k]});
        }
    }
  first_neighbour.push_back(neighbours.size());
  slope.resize(wanted.size());
  return cells;
}

template <int dim>
void CellStrain<dim>::add_corners(const Mesh<dim> &mesh,
                                  const std::vector<unsigned int> &cells)
{
  std::size_t n_corners = 0;
  for (const unsigned int cell : cells)
    n_corners += mesh.cells[cell].vertices.size();
  corners.reserve(n_corners);
  first_corner.reserve(cells.size() + 1);
  for (const unsigned int cell : cells)
    {
      const auto &vertices  = mesh.cells[cell].vertices;
      const auto integrated = integrated_gradients(mesh, vertices);
      const double volume   = cell_measure(mesh, vertices).volume;
      first_corner.push_back(corners.size());
      for (std::size_t v = 0; v < vertices.size(); ++v)
        corners.push_back({vertices[v], integrated[v] / volume});
    }
  first_corner.push_back(corners.size());
}

template <int dim>
void CellStrain<dim>::set_displacement(const std::vector<double> &u)
{
  for (std::size_t cell = 0; cell < mean.size(); ++cell)
    {
      VoigtVector<dim> strain = VoigtVector<dim>::Zero();
      for (std::size_t k = first_corner[cell]; k < first_corner[cell + 1]; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            strain(voigt_index<dim>(c, d)) +=
              corners[k].gradient[d] * u[corners[k].point * dim + c];
      mean[cell] = strain;
    }
  for (std::size_t cell = 0; cell < slope.size(); ++cell)
    {
      auto &of_cell = slope[cell];
      of_cell.fill(VoigtVector<dim>::Zero());
      for (std::size_t k = first_neighbour[cell]; k < first_neighbour[cell + 1]; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          of_cell[d] += neighbours[k].weight[d] * (mean[neighbours[k].cell] - mean[cell]);
    }
}

template <int dim>
MeanStrain<dim>::MeanStrain(const Mesh<dim> &mesh)
  : gradient(mesh.points.size())
{
  double volume = 0.;
  for (const auto &cell : mesh.cells)
    {
      volume += cell_measure(mesh, cell.vertices).volume;
      const auto integrated = integrated_gradients(mesh, cell.vertices);
      for (std::size_t v = 0; v < cell.vertices.size(); ++v)
        gradient[cell.vertices[v]] += integrated[v];
    }
  for (auto &of_point : gradient)
    of_point /= volume;
}

template <int dim>
MeanStrain<dim> MeanStrain<dim>::part(const std::size_t first, const std::size_t n) const
{
  const auto begin = gradient.begin() + static_cast<std::ptrdiff_t>(first);
  MeanStrain some;
  some.gradient.assign(begin, begin + static_cast<std::ptrdiff_t>(n));
  return some;
}

template <int dim>
void MeanStrain<dim>::add(const std::vector<double> &u, VoigtVector<dim> &strain) const
{
  for (std::size_t k = 0; k < gradient.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        strain(voigt_index<dim>(c, d)) += gradient[k][d] * u[k * dim + c];
}

template class CellStrain<2>;
template class CellStrain<3>;
template class MeanStrain<2>;
template class MeanStrain<3>;
} // namespace mesoslip
