#ifndef mesoslip_elasticity_uniform_material_h
#define mesoslip_elasticity_uniform_material_h

#include "grid/uniform_grid.h"
#include "material/voigt.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What operator and mass need to know about a phase. */
template <int dim>
struct ElasticPhase
{
  /** Pa; in 2D the plane stiffness (plane strain or plane stress). */
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero();

  /** kg/m^3 */
  double density = 0.;
};

/** The phases of a UniformMaterial. */
using ElasticClass = ElasticPhase<2>;

/**
 * Opposite sides that are one and the same. Fields keep the duplicate last column (row);
 * operators read it and write it equal to the first.
 */
struct Periodicity
{
  bool x = false; ///< left and right side are one
  bool y = false; ///< bottom and top are one
};

/**
 * The material on a uniform grid of Q1 rectangles, by class: one byte for each cell and
 * up to 256 classes. A node row has `grid.cells[0] + 1` columns, periodic or not, and
 * there are `grid.cells[1] + 1` rows. Always describes the whole grid, on every rank.
 */
class UniformMaterial
{
public:
  /**
   * @p class_id holds one class for each cell, x fastest; empty means class 0 everywhere.
   * Classes that no cell uses are allowed. Throws std::invalid_argument on sizes or ids
   * that do not fit, spacings that are not positive, a density that is not positive or a
   * stiffness that is not symmetric and positive definite (in a class that is used).
   */
  UniformMaterial(const UniformGrid<2> &grid,
                  const std::vector<ElasticClass> &classes,
                  const std::vector<std::uint8_t> &class_id = {},
                  const Periodicity periodicity             = Periodicity());

  /** Of the body. */
  const UniformGrid<2> &grid() const
  {
    return the_grid;
  }

  /** Stiffness (Pa) and density (kg/m^3) of each class. */
  const std::vector<ElasticClass> &classes() const
  {
    return the_classes;
  }

  /** Which sides are one. */
  Periodicity periodicity() const
  {
    return periodic;
  }

  /** True if all cells are of one class: then class_row() is not to be called. */
  bool is_homogeneous() const
  {
    return ids.empty();
  }

  /** The class of all cells if is_homogeneous(), else 0. */
  std::uint8_t homogeneous_class() const
  {
    return only_class;
  }

  /** 1 + the largest class that occurs. */
  unsigned int n_classes() const
  {
    return number_of_classes;
  }

  /** D13 = D23 = 0 (to 1e-14 of the largest entry) in all classes that occur. */
  bool is_orthotropic() const
  {
    return orthotropic;
  }

  /** All classes that occur have one density. */
  bool has_uniform_density() const
  {
    return uniform_density;
  }

  /** Class of cell @p i from the left, @p j from the bottom. */
  std::uint8_t class_of(const unsigned int i, const unsigned int j) const
  {
    return ids.empty() ? only_class : ids[j * id_stride + i];
  }

  /** Classes of cell row @p j, followed by at least 64 more readable bytes. */
  const std::uint8_t *class_row(const unsigned int j) const
  {
    return ids.data() + j * id_stride;
  }

  /** Columns of nodes, the duplicate of a periodic side included. */
  unsigned int n_columns() const
  {
    return the_grid.cells[0] + 1;
  }

  /** Rows of nodes, the duplicate of a periodic side included. */
  unsigned int n_rows() const
  {
    return the_grid.cells[1] + 1;
  }

  /**
   * Lumped mass per unit thickness (kg/m) of the n_columns() nodes of global row @p j.
   * Nodes on a periodic side carry the mass of both sides, in both copies.
   */
  void mass_row(const unsigned int j, double *mass) const;

  /** Sum of density times area (kg/m). */
  double total_mass() const;

private:
  UniformGrid<2> the_grid;
  std::vector<ElasticClass> the_classes;
  Periodicity periodic;
  std::vector<std::uint8_t> ids;
  std::size_t id_stride          = 0;
  std::uint8_t only_class        = 0;
  unsigned int number_of_classes = 1;
  bool orthotropic               = true;
  bool uniform_density           = true;
};
} // namespace mesoslip

#endif
