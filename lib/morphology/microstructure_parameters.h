#ifndef mesoslip_morphology_microstructure_parameters_h
#define mesoslip_morphology_microstructure_parameters_h

#include "grid/uniform_grid.h"
#include "material/voigt.h"
#include "morphology/image_map.h"
#include "morphology/orientations/orientation_reading.h"
#include "morphology/phases/phase_parameters.h"
#include "morphology/random_fibres.h"
#include "morphology/random_inclusions.h"
#include "morphology/rectangles.h"
#include "morphology/voxel_reading.h"

#include <cmath>
#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** Section of random fibres in a .prm. */
inline const std::string random_fibres_section = "Microstructure/Random fibres";

/** Whether @p length is a whole multiple of @p unit, at least one. */
inline bool is_multiple(const double length, const double unit)
{
  const double ratio = length / unit;
  return ratio > 0.5 && std::abs(ratio - std::round(ratio)) <= 1e-6 * ratio;
}

/**
 * Sections `Grid`, `Phases` and `Microstructure`: everything that determines the
 * materials of the cells.
 */
struct MicrostructureParameters
{
  /** Source of the morphology. */
  enum class Type
  {
    homogeneous,
    random_fibres,
    rectangles,
    image,
    voxels,
    random_inclusions
  };

  /** Whether the program has grids in 3D, with their keys. */
  bool has_grids_in_3d = false;

  /** Whether the volume is homogenized: then phases have keys for derivatives of the
   * stiffness. */
  bool is_volume = false;

  /** Dimension of the box: 2, or 3 in programs with grids in 3D. */
  unsigned int dim = 2;

  UniformGrid<2> grid; ///< section Grid in 2D; the origin is the lower left corner
  UniformGrid<3> box;  ///< section Grid in 3D; default in 2D
  std::array<double, 2> size = {};     ///< extents of the box in 2D (m), as in the .prm
  std::vector<PhaseParameters> phases; ///< section Phases, in the order of `Names`

  Type type = Type::random_fibres; ///< key Type

  /** Rectangles (CSV), image (PNG, plain text), or voxels (file, folder or
   *  pattern). */
  std::string file;

  ImageReading image; ///< settings for an image

  FibrePlacement placement; ///< rules of random fibres

  VoxelReading voxels; ///< settings for voxels

  OrientationReading orientation; ///< settings for orientations of cells in 3D

  InclusionPlacement inclusions; ///< rules of random inclusions, in 3D

  /** Name of the phase of the fibres; empty: the second one. */
  std::string fibre_phase;

  /** Edge (m) of the square cells on which fibres are placed; 0: cells of the grid. */
  double placement_spacing = 0.;

  /** Binds the keys of all three sections, for a box of @p dimension. */
  void bind(Keys &keys, const unsigned int dimension = 2);

  /**
   * Throws UserError: checks of each section and across sections. Files are read; random
   * fibres are not placed.
   */
  void check() const;

  /** The grid that fibres are placed on: the grid itself or a coarser one. */
  UniformGrid<2> placement_grid() const;

  /** Index of the phase of the fibres or inclusions; throws UserError if there is
   * none. */
  unsigned int fibre_phase_index() const;

  /** Whether the members of an ensemble differ by their seed. */
  bool is_random() const
  {
    return type == Type::random_fibres || type == Type::random_inclusions;
  }

  /** Seed of random fibres or inclusions. */
  std::uint64_t seed() const
  {
    return type == Type::random_inclusions ? inclusions.seed : placement.seed;
  }

  /** Parameters of member number @p m of an ensemble. */
  MicrostructureParameters member(const unsigned int m) const
  {
    MicrostructureParameters own = *this;
    own.placement.seed += m;
    own.inclusions.seed += m;
    return own;
  }
};

/** A morphology with its materials. */
struct Microstructure
{
  PhaseMap<2> map;              ///< phase of each cell
  std::vector<Phase<2>> phases; ///< by phase number

  /** Placed or read rectangles in the order of drawing; empty for the other types. */
  std::vector<Rectangle> rectangles;

  /** Lines for the log: source; value, cells and material of each phase. */
  std::vector<std::string> description;

  /** Sentences for the log: target not reached, sizes rounded to the grid. */
  std::vector<std::string> warnings;
};

/**
 * Places, draws or reads the morphology. @p parameters have passed check(). Same result
 * on all ranks. Throws UserError if a file does not fit.
 */
Microstructure make_microstructure(const MicrostructureParameters &parameters);
} // namespace mesoslip

#endif
