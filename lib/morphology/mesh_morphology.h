#ifndef mesoslip_morphology_mesh_morphology_h
#define mesoslip_morphology_mesh_morphology_h

#include "material/voigt.h"
#include "mesh/mesh.h"
#include "mesh/periodic_points.h"
#include "morphology/microstructure_parameters.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** Key `Dimension` and section `Mesh`: bodies on meshes. */
struct MeshParameters
{
  unsigned int dim = 2;           ///< dimension of the body
  std::vector<std::string> files; ///< Gmsh meshes; empty: the body is a grid
  double scale     = 1.;          ///< m per unit of the file
  bool scale_typed = false;       ///< whether the .prm sets the scale
  double tolerance = 1e-3;        ///< see Mesh::tolerance

  unsigned int degree = 1; ///< polynomial degree of displacements, 1 or 2

  /** Whether the program supports cells of degree 2. */
  bool has_degrees = false;

  /** Whether all groups of cells are one phase, regardless of their names. */
  bool one_phase = false;

  /** Whether the program supports grids in 3D, so that Dimension = 3 needs no mesh. */
  bool has_grids_in_3d = false;

  /** Binds the keys. */
  void bind(Keys &keys);

  /** Binds only the keys of section Mesh, in the current section. */
  void bind_file(Keys &keys);
};

/** A mesh with the materials of its cells. */
template <int dim>
struct MeshMorphology
{
  std::string file; ///< path of the mesh file

  Mesh<dim> mesh; ///< phases in the order of `Phases/Names`

  std::vector<Phase<dim>> phases; ///< by phase number
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
 * Reads one of the meshes of @p parameters, as a whole on the calling rank.
 * @throws UserError naming the file if it cannot be read, has a phase without material,
 * flat, twisted, overlapping or duplicate cells, several pieces, or a size that looks
 * like another unit without `Mesh/Scale`
 */
template <int dim>
MeshMorphology<dim> read_mesh(const MeshParameters &parameters,
                              const std::string &file,
                              const std::vector<PhaseParameters> &phases);

/** @throws UserError unless the body is a box and, if it has to be @p periodic, the
 * points of opposite sides match. */
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
