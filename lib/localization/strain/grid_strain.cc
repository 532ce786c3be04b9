#include "localization/strain/grid_strain.h"

#include "exchange/mesh_datasets.h"
#include "localization/strain/cell_set.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** Kinds of cells along an axis: two at each side, and the interior. */
constexpr unsigned int n_kinds = 5;

/** Kind of cell @p i of @p n along an axis. */
unsigned int kind_of(const unsigned int i, const unsigned int n)
{
  if (n <= n_kinds || i < 2)
    return i;
  return n - i <= 2 ? n_kinds - (n - i) : 2;
}
} // namespace

template <int dim>
GridStrain<dim>::GridStrain(const UniformGrid<dim> &of_body,
                            const CellBlock<dim> &the_cells)
  : body(of_body)
  , cells(the_cells)
  , part{the_cells.cells, of_body.spacing, {}}
  , means(the_cells.n_cells())
{
  UniformGrid<dim> kinds = {{}, body.spacing, {}};
  for (unsigned int d = 0; d < dim; ++d)
    kinds.cells[d] = std::min(body.cells[d], n_kinds);
  const Mesh<dim> mesh  = mesh_of_cells(kinds);
  const auto integrated = integrated_gradients(mesh, mesh.cells[0].vertices);
  for (std::size_t v = 0; v < integrated.size(); ++v)
    gradient[v] = integrated[v] / body.cell_measure();
  const SlopeFits<dim> fits(mesh);
  for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    {
      const auto kind = places_of(kinds, k);
      auto &others    = neighbours[kind];
      for (const SlopeWeight<dim> &other : fits.of(k))
        {
          const auto to       = places_of(kinds, other.cell);
          std::ptrdiff_t step = 0;
          for (unsigned int d = dim; d-- > 0;)
            step = step * cells.cells[d] +
                   (static_cast<int>(to[d]) - static_cast<int>(kind[d]));
          others.push_back({step, other.weight});
        }
    }
}

template <int dim>
void GridStrain<dim>::set_displacement(const std::vector<double> &u)
{
  if (means.empty())
    return;
  const std::size_t n_x    = part.cells[0];
  const auto first_corners = part.corners(0);
  for (std::size_t row = 0; row * n_x < means.size(); ++row)
    {
      const std::size_t lowest = part.corners(static_cast<unsigned int>(row * n_x))[0];
      for (std::size_t i = 0; i < n_x; ++i)
        {
          VoigtVector<dim> strain = VoigtVector<dim>::Zero();
          for (std::size_t v = 0; v < gradient.size(); ++v)
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                strain(voigt_index<dim>(c, d)) +=
                  gradient[v][d] * u[(lowest + i + first_corners[v]) * dim + c];
          means[row * n_x + i] = strain;
        }
    }
}

template <int dim>
VoigtVector<dim> GridStrain<dim>::at(const std::size_t k,
                                     const dealii::Point<dim> &place) const
{
  Kind kind, in_body = places_of(part, k);
  for (unsigned int d = 0; d < dim; ++d)
    {
      in_body[d] += cells.first[d];
      kind[d] = kind_of(in_body[d], body.cells[d]);
    }
  const dealii::Tensor<1, dim> from_middle = place - middle_of<dim>(body, in_body);
  VoigtVector<dim> strain                  = means[k];
  for (const Neighbour &other : neighbours.at(kind))
    strain +=
      (other.weight * from_middle) *
      (means[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(k) + other.step)] -
       means[k]);
  return strain;
}

template class GridStrain<2>;
template class GridStrain<3>;
} // namespace mesoslip
