#ifndef mesoslip_localization_strain_cell_strain_h
#define mesoslip_localization_strain_cell_strain_h

#include "material/voigt.h"
#include "mesh/mesh.h"

#include <cstddef>
#include <vector>

namespace mesoslip
{
/**
 * The strain (engineering shear) in some cells of a body from the displacement of its
 * points: the mean over each cell, and a linear continuation from it.
 *
 * At a place in cell c it is E(x) = E_c + G_c (x - x_c), E_c being the mean strain and x_c
 * the centroid. G_c is that of SlopeFits. Linear fields of mean strain are continued exactly;
 * at the centroid the strain is that of the cell, whatever is around it. Where nothing else is asked for, G_c is
 * left out: its fits take more time than the rest, and memory.
 */
template <int dim>
class CellStrain
{
public:
  /** For the cells @p wanted of @p mesh, which are asked for by their place in that list,
   * with @p only_means at their centroids alone. The mesh is not needed later. */
  CellStrain(const Mesh<dim> &mesh,
             const std::vector<unsigned int> &wanted,
             const bool only_means = false);

  /** Evaluates the displacement of all points (m) [n_points][dim]. */
  void set_displacement(const std::vector<double> &u);

  /** Strain in wanted cell @p k at @p place. */
  VoigtVector<dim> at(const std::size_t k, const dealii::Point<dim> &place) const
  {
    VoigtVector<dim> strain = mean[k];
    if (slope.empty())
      return strain;
    const dealii::Tensor<1, dim> from_centroid = place - centroid[k];
    for (unsigned int d = 0; d < dim; ++d)
      strain += from_centroid[d] * slope[k][d];
    return strain;
  }

private:
  using Tensor = dealii::Tensor<1, dim>;

  /** One corner of a cell and what it adds to the gradient. */
  struct Corner
  {
    std::size_t point;
    Tensor gradient; ///< mean over the cell (1/m)
  };

  /** A cell near to a wanted one and what it adds to the slope there. */
  struct Neighbour
  {
    std::size_t cell;
    Tensor weight; ///< 1/m
  };

  /** Fits the slopes of the wanted cells, and returns these and then the others that the
   * fits take the means of. */
  std::vector<unsigned int> add_neighbours(const Mesh<dim> &mesh,
                                           const std::vector<unsigned int> &wanted);

  void add_corners(const Mesh<dim> &mesh, const std::vector<unsigned int> &cells);

  std::vector<Corner> corners;
  std::vector<std::size_t> first_corner; ///< of each cell, the wanted ones first
  std::vector<Neighbour> neighbours;
  std::vector<std::size_t> first_neighbour; ///< of each wanted cell
  std::vector<dealii::Point<dim>> centroid; ///< of cells with a slope (m)
  std::vector<VoigtVector<dim>> mean;       ///< strain of all cells
  std::vector<std::array<VoigtVector<dim>, dim>>
    slope; ///< of the wanted cells or none (1/m)
};

/**
 * Mean strain over a whole body, as a linear function of the displacement of its points
 * (m) [n_points][dim], or what some of them add to it.
 */
template <int dim>
class MeanStrain
{
public:
  /** Of no points. */
  MeanStrain() = default;

  /** The mesh is not needed later. */
  explicit MeanStrain(const Mesh<dim> &mesh);

  /** That of @p n points from point @p first on. */
  MeanStrain part(const std::size_t first, const std::size_t n) const;

  /** Adds to @p strain, point after point, what comes of the displacement @p u. */
  void add(const std::vector<double> &u, VoigtVector<dim> &strain) const;

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &gradient;
  }

private:
  std::vector<dealii::Tensor<1, dim>> gradient; ///< of each point (1/m)
};
} // namespace mesoslip

#endif
