#ifndef mesoslip_localization_strain_cell_strain_h
#define mesoslip_localization_strain_cell_strain_h

#include "material/voigt.h"
#include "mesh/mesh.h"

#include <cstddef>
#include <vector>

namespace mesoslip
{
/**
 * The strain (engineering shear) in some cells of a body from nodal displacements: the
 * mean over each cell, and its linear continuation E(x) = E_c + G_c (x - x_c) in cell c,
 * with the mean strain E_c and the centroid x_c. G_c is the slope by SlopeFits. Linear
 * strain fields are reproduced exactly; at the centroid the strain is the mean of the
 * cell. With only_means, G_c is left out: its fits take most of the time, and memory.
 */
template <int dim>
class CellStrain
{
public:
  /** For the cells @p wanted of @p mesh, which are addressed by their index in this list;
   * with @p only_means only at their centroids. The mesh is not needed later. */
  CellStrain(const Mesh<dim> &mesh,
             const std::vector<unsigned int> &wanted,
             const bool only_means = false);

  /** Evaluates the strains for the displacement of all points (m) [n_points][dim]. */
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

  /** A corner of a cell and its weight in the displacement gradient. */
  struct Corner
  {
    std::size_t point;
    Tensor gradient; ///< mean over the cell (1/m)
  };

  /** A neighbour cell and its weight in the slope. */
  struct Neighbour
  {
    std::size_t cell;
    Tensor weight; ///< 1/m
  };

  /** Fits the slopes of the wanted cells.
   * @return the wanted cells, then the neighbours whose means the fits use */
  std::vector<unsigned int> add_neighbours(const Mesh<dim> &mesh,
                                           const std::vector<unsigned int> &wanted);

  void add_corners(const Mesh<dim> &mesh, const std::vector<unsigned int> &cells);

  std::vector<Corner> corners;
  std::vector<std::size_t> first_corner; ///< per cell, the wanted cells first
  std::vector<Neighbour> neighbours;
  std::vector<std::size_t> first_neighbour; ///< per wanted cell
  std::vector<dealii::Point<dim>> centroid; ///< for cells with a slope (m)
  std::vector<VoigtVector<dim>> mean;       ///< strain of all cells
  std::vector<std::array<VoigtVector<dim>, dim>>
    slope; ///< per wanted cell, or empty (1/m)
};

/**
 * Mean strain over a body as a linear function of nodal displacements (m)
 * [n_points][dim], or the contribution of some points.
 */
template <int dim>
class MeanStrain
{
public:
  /** No points. */
  MeanStrain() = default;

  /** The mesh is not needed later. */
  explicit MeanStrain(const Mesh<dim> &mesh);

  /** Contribution of @p n points from point @p first on. */
  MeanStrain part(const std::size_t first, const std::size_t n) const;

  /** Adds the contribution of the displacement @p u to @p strain, point by point. */
  void add(const std::vector<double> &u, VoigtVector<dim> &strain) const;

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &gradient;
  }

private:
  std::vector<dealii::Tensor<1, dim>> gradient; ///< per point (1/m)
};
} // namespace mesoslip

#endif
