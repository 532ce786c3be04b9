#ifndef mesoslip_morphology_mesh_morphology_h
#define mesoslip_morphology_mesh_morphology_h

#include "grid/brick_box.h"
#include "grid/cell_reader.h"
#include "material/orientations.h"
#include "material/voigt.h"
#include "mesh/mesh.h"
#include "mesh/periodic_points.h"
#include "morphology/microstructure_parameters.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Key `Dimension` and section `Mesh`: bodies that come from a mesh. */
struct MeshParameters
{
  unsigned int dim = 2;           ///< of the body
  std::vector<std::string> files; ///< meshes of Gmsh; empty: the body is a grid
  double scale     = 1.;          ///< m per unit of the file
  bool scale_typed = false;       ///< whether the .prm says so
  double tolerance = 1e-3;        ///< see Mesh::tolerance

  /** Whether all groups of cells are one phase, whatever their names. */
  bool one_phase = false;

  /** Whether the program has grids in 3D, so that Dimension = 3 needs no mesh. */
  bool has_grids_in_3d = false;

  /** Binds the keys. */
  void bind(Keys &keys);
};

/** A mesh, or a box of bricks, with the materials of its cells. */
template <int dim>
struct MeshMorphology
{
  std::string file; ///< where it comes from

  /** Its phases are those of `Phases/Names`, in their order; of a box with orientations they are
   * materials(). */
  Mesh<dim> mesh;

  /** Of a grid in 3D, whose nodes and cells are numbered with x fastest, then y. */
  std::optional<BrickBox> box;

  /** Reads the materials of the cells of a box: their phases, or which of @p oriented. */
  CellReader materials_in;

  /** The phases in the orientations that cells of a box have; empty: as they are. */
  std::vector<OrientedPhase> oriented;

  /** What the cells are made of, by their numbers. */
  std::vector<Phase<dim>> materials() const
  {
    return oriented_phases(phases, oriented);
  }

  /** The phase of material @p m. */
  unsigned int phase_of(const unsigned int m) const
  {
    return oriented.empty() ? m : oriented[m].phase;
  }

  /** Numbers in the box of the points of the mesh, ascending, where the mesh has only some;
   * empty: it has all. */
  std::vector<unsigned int> point_in_box;

  std::vector<unsigned int> cell_in_box; ///< the same of its cells

  /** Number in the whole body of point @p i of the mesh. */
  unsigned int whole_point(const unsigned int i) const
  {
    return point_in_box.empty() ? i : point_in_box[i];
  }

  /** The same of cell @p k. */
  unsigned int whole_cell(const unsigned int k) const
  {
    return cell_in_box.empty() ? k : cell_in_box[k];
  }

  /** Where point @p number of the whole body is. */
  dealii::Point<dim> point(const unsigned int number) const
  {
    if constexpr (dim == 3)
      if (box)
        {
          const auto place = box->grid.node(number);
          return {place[0], place[1], place[2]};
        }
    return mesh.points[number];
  }

  /** Of the whole body. */
  std::size_t n_points() const
  {
    return box ? box->grid.n_nodes() : mesh.points.size();
  }

  /** Of the whole body. */
  std::size_t n_cells() const
  {
    return box ? box->grid.n_cells() : mesh.cells.size();
  }

  std::vector<Phase<dim>> phases; ///< by index
  std::vector<double> fractions;  ///< volume fraction of each phase

  /**
   * Lines for the log: points and cells, bounding box, worst cell; cells, volume and
   * material of each phase; faces and area of each boundary.
   */
  std::vector<std::string> description;

  /** Sentences for the log: phases without cells, cells that are nearly flat, open seams. */
  std::vector<std::string> warnings;
};

/**
 * Reads one of the meshes of @p parameters. The calling rank reads the whole mesh.
 * @throws UserError naming the file when it cannot be read, has a phase without material,
 * flat, twisted, overlapping or duplicate cells, several pieces, or a size that looks like another
 * unit and no `Mesh/Scale`
 */
template <int dim>
MeshMorphology<dim> read_mesh(const MeshParameters &parameters,
                              const std::string &file,
                              const std::vector<PhaseParameters> &phases);

/** @throws UserError unless the body is a box, and if it has to be @p periodic unless the
 * points of opposite sides are opposite. */
template <int dim>
void require_volume(const Mesh<dim> &mesh, const bool periodic);

/** "25 points each, opposite within 1e-19 m". */
template <int dim>
std::string opposite_text(const OppositePoints<dim> &sides);

/**
 * Lines on how well the opposite sides of a volume element match, for each axis.
 * @throws UserError unless the body is a box
 */
template <int dim>
std::vector<std::string> periodicity_lines(const Mesh<dim> &mesh);
} // namespace mesoslip

#endif
