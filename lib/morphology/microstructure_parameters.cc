#include "morphology/microstructure_parameters.h"

#include "base/errors.h"
#include "grid/uniform_grid.h"
#include "morphology/fibre_parameters.h"
#include "morphology/voxels.h"
#include "parameters/keys.h"
#include "program/output_folder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace mesoslip
{
namespace
{
using Type = MicrostructureParameters::Type;

/** Section `Grid` as given in the .prm, with two or three axes. */
struct GridKeys
{
  std::vector<long> cells     = {560, 160};
  std::vector<double> size    = {0.056, 0.016};
  std::vector<double> spacing = {};
};

/** Lengths of the box (m) from Size or Spacing, which must agree. */
std::vector<double> box_lengths(const Keys &keys, const GridKeys &given)
{
  if (given.spacing.empty())
    return given.size;
  std::vector<double> found;
  bool agrees = true;
  for (std::size_t d = 0; d < given.cells.size(); ++d)
    {
      found.push_back(static_cast<double>(given.cells[d]) *
                      given.spacing[given.spacing.size() == 1 ? 0 : d]);
      agrees = agrees && given.size.size() == given.cells.size() &&
               std::abs(given.size[d] - found[d]) <= 1e-9 * found[d];
    }
  keys.only_if(
    agrees, {"Size"},
    "Grid/Cells times Grid/Spacing make a box of " +
      (found.size() == 2 ? lengths_text(found[0], found[1]) : to_text(found) + " m"),
    "leave Grid/Spacing empty");
  return found;
}

/** Section `Grid`; the default is the paper's pin with cells of 0.1 mm. */
void bind_grid(Keys &keys, MicrostructureParameters &p)
{
  const auto section = keys.section("Grid");
  GridKeys given;
  keys.bind_list("Cells", given.cells, 1, 1000000,
                 "Numbers of cells along x and y (3D: x, y and z); a solution costs "
                 "memory and time in proportion to their product [-]",
                 2, 3);
  keys.bind_list(
    "Size", given.size, Range::length(),
    "Width (x) and height (y) of the box, in 3D its lengths along x, y and z; "
    "its lower left corner is the origin [m]",
    2, 3);
  keys.bind_list(
    "Spacing", given.spacing, Range::length(),
    "Instead of Size: edge of the square or cubic cells, or their edges along "
    "the axes. Empty: Size over Cells [m]",
    0, 3);
  const std::string wanted = " numbers where Dimension is " + std::to_string(p.dim) +
                             "; give one for each axis, or a mesh in Mesh/File";
  const auto require_axes = [&](const char *key, const std::size_t n) {
    keys.require(n == p.dim, key, "there are " + std::to_string(n) + wanted);
  };
  require_axes("Cells", given.cells.size());
  if (given.spacing.size() > 1)
    require_axes("Spacing", given.spacing.size());
  if (given.spacing.empty())
    require_axes("Size", given.size.size());
  const std::vector<double> size = box_lengths(keys, given);
  double n                       = 1.;
  for (const long cells : given.cells)
    n *= static_cast<double>(cells);
  keys.require(n < 2147483648., "Cells",
               to_text(n) + " cells are too many; there may be up to 2^31");
  for (std::size_t d = 0; d < given.cells.size(); ++d)
    {
      keys.require(Range::length().contains(size[d]), "Size",
                   to_text(size[d]) + " m is not the size of a box; give lengths " +
                     Range::length().text());
      const auto cells = static_cast<unsigned int>(given.cells[d]);
      p.box.cells[d]   = cells;
      p.box.spacing[d] = size[d] / cells;
      if (d == 2)
        continue;
      p.size[d]         = size[d];
      p.grid.cells[d]   = cells;
      p.grid.spacing[d] = size[d] / cells;
    }
}

void check_image_values(const MicrostructureParameters &p)
{
  const std::vector<long> &values = p.image.values;
  const std::set<long> distinct(values.begin(), values.end());
  if (!values.empty() &&
      (distinct.size() != values.size() || values.size() != p.phases.size()))
    throw UserError("Microstructure/Image values: there are " +
                    std::to_string(distinct.size()) + " different values for " +
                    std::to_string(p.phases.size()) +
                    " phases; give one value for each of Phases/Names");
  if (const std::size_t n = p.image.thresholds.size(); n > 0 && n + 1 != p.phases.size())
    throw UserError("Microstructure/Thresholds: there are " + std::to_string(n) +
                    " for " + std::to_string(p.phases.size()) +
                    " phases; give one less than Phases/Names");
}
} // namespace

void MicrostructureParameters::bind(Keys &keys, const unsigned int dimension)
{
  dim = dimension;
  bind_grid(keys, *this);
  bind_phases(keys, phases, is_volume);
  image.n_phases     = static_cast<unsigned int>(phases.size());
  const auto section = keys.section("Microstructure");
  keys.bind(
    "Type", type,
    {"homogeneous", "random fibres", "rectangles", "image", "voxels",
     "random inclusions"},
    "Where the morphology comes from: all of the first phase; random fibres; a "
    "list of rectangles; an image; in 3D an array of voxels, or random inclusions "
    "[-]");
  const bool in_3d = type == Type::voxels || type == Type::random_inclusions;
  keys.require(dim == 2 ? !in_3d : in_3d || type == Type::homogeneous, "Type",
               dim == 2
                 ? "voxels and random inclusions need Dimension = 3"
                 : "where Dimension is 3 it is voxels, random inclusions or homogeneous");
  keys.bind_input(
    "File", file,
    "Rectangles: CSV with x_left_mm,y_bottom_mm,width_mm,height_mm and, "
    "if needed, phase (the index, 1 where missing). Image: PNG, TIFF, .npy or text with "
    "rows of whole numbers from the top. Voxels [z][y][x]: .npy, .raw, .h5, or a "
    "stack of PNG or TIFF: their folder, a pattern of their names with * and ?, or a "
    "TIFF of several pages [-]");
  keys.bind_list(
    "Image values", image.values, std::numeric_limits<int>::min(),
    std::numeric_limits<int>::max(),
    "Image, voxels: the value of each phase in the order of Phases/Names. Empty: "
    "the values that occur, in ascending order, if there are as many as "
    "phases [-]",
    0, std::numeric_limits<std::size_t>::max());
  keys.bind_list(
    "Thresholds", image.thresholds, Range::any(),
    "Image, voxels: instead of Image values, numbers in ascending order, one less "
    "than phases: values below the first are the first of Phases/Names, those "
    "from a number on the next phase. For grey values and numbers with "
    "fractions. Empty: none [-]",
    0, 255);
  keys.only_if(image.thresholds.empty(), {"Image values"},
               "Microstructure/Thresholds is given", "leave that one empty");
  keys.require(std::is_sorted(image.thresholds.begin(), image.thresholds.end(),
                              std::less_equal<double>()),
               "Thresholds",
               to_text(image.thresholds) + " is not in ascending order; sort them");
  keys.bind("Oblong pixels", image.oblong_pixels,
            "Image: the pixels need not be squares in the body; otherwise Grid/Cells "
            "and Grid/Size have to make them so within 1 % [-]");
  keys.only_with("Type", {"random fibres"}, {"Random fibres/"});
  if (has_grids_in_3d)
    {
      voxels.bind(keys, file);
      orientation.bind(keys);
      keys.only_with("Type", {"random inclusions"}, {"Random inclusions/"});
      const auto subsection = keys.section("Random inclusions");
      inclusions.bind(keys);
    }
  keys.only_with("Type", {"rectangles", "image", "voxels"}, {"File"});
  keys.only_with("Type", {"image", "voxels"}, {"Image values", "Thresholds"});
  keys.only_with("Type", {"image"}, {"Oblong pixels"});

  bind_fibres(keys, *this);
}

void MicrostructureParameters::check() const
{
  for (const PhaseParameters &phase : phases)
    dim == 2 ? phase.check<2>() : phase.check<3>();
  if (type == Type::random_fibres)
    check_fibres(*this);
  if (type == Type::random_inclusions)
    {
      inclusions.check(box);
      check_fibre_phase(*this, random_inclusions_section);
    }
  if (type == Type::image || type == Type::voxels)
    check_image_values(*this);
  if (type == Type::voxels)
    check_voxels(*this);
  if (!orientation.file.empty())
    check_orientations(*this);
  if (type == Type::image || type == Type::rectangles)
    {
      require_memory({static_cast<double>(grid.n_cells()), "reduce Grid/Cells"});
      make_microstructure(*this);
    }
}

UniformGrid<2> MicrostructureParameters::placement_grid() const
{
  UniformGrid<2> result = grid;
  if (placement_spacing > 0.)
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double n    = std::max(1., std::round(size[d] / placement_spacing));
        result.cells[d]   = static_cast<unsigned int>(n);
        result.spacing[d] = size[d] / n;
      }
  return result;
}
} // namespace mesoslip
