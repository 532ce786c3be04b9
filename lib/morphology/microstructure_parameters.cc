#include "morphology/microstructure_parameters.h"

#include "base/errors.h"
#include "grid/uniform_grid.h"
#include "morphology/voxels.h"
#include "parameters/keys.h"
#include "program/output_folder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mesoslip
{
namespace
{
using Type = MicrostructureParameters::Type;

/** Section `Grid` as it stands in the .prm, of two or three axes. */
struct GridKeys
{
  std::vector<long> cells     = {560, 160};
  std::vector<double> size    = {0.056, 0.016};
  std::vector<double> spacing = {};
};

/** Lengths of the box (m) from Size or Spacing, which must not contradict each other. */
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

void bind_fibres(Keys &keys, FibrePlacement &placement)
{
  keys.bind("Seed", placement.seed, 0, std::numeric_limits<long>::max(),
            "Start of the random numbers; the same seed gives the same morphology on "
            "every machine [-]");
  keys.bind("Fibre width", placement.width, Range::positive(),
            "Width of all fibres along x [m]");
  keys.bind("Minimum height", placement.min_height, Range::positive(),
            "Smallest height of a fibre along y; heights are uniformly distributed in "
            "[Minimum height, Maximum height] [m]");
  keys.bind("Maximum height", placement.max_height, Range::positive(),
            "Largest height of a fibre along y [m]");
}

void bind_rules(Keys &keys, FibrePlacement &placement)
{
  keys.bind("Area fraction", placement.area_fraction, Range::open(0., 1.),
            "Area of the fibres over area of the box [-]");
  keys.bind("Fraction rule", placement.fraction_rule, {"actual", "nominal"},
            "What counts for the area fraction: actual: the area of the cells that "
            "become fibre; nominal: the sum of the fibres' areas, overlaps counted "
            "twice [-]");
  keys.bind("Trim last fibre", placement.trim_last,
            "With the actual fraction: shorten the last fibre so that the fraction is "
            "met [-]");
  keys.bind("Allow overlap", placement.allow_overlap, "Fibres may overlap [-]");
  keys.bind("Minimum gap", placement.minimum_gap, Range::non_negative(),
            "Free distance between two fibres, in x or in y, rounded up to whole cells "
            "[m]");
  keys.bind("Cut by border", placement.cut_by_border,
            "Fibres may extend beyond the box and are cut at its sides; otherwise they "
            "lie inside [-]");
  keys.bind("Align to grid", placement.align_to_grid,
            "Edges of fibres lie on edges of cells; otherwise they lie anywhere, and "
            "the cells with their centre inside become fibre [-]");
  keys.only_with("Fraction rule", {"actual"}, {"Trim last fibre"});
}

[[noreturn]] void fail(const std::string &key,
                       const std::string &what,
                       const std::string &section = random_fibres_section)
{
  throw UserError(section + "/" + key + ": " + what);
}

/** Fibres or inclusions are not made of the first phase. */
void check_fibre_phase(const MicrostructureParameters &p, const std::string &section)
{
  if (p.fibre_phase_index() == 0)
    fail("Phase",
         "'" + p.phases[0].name +
           "' is the background, the first of Phases/Names; name another phase",
         section);
}

void check_placement_spacing(const MicrostructureParameters &p)
{
  for (unsigned int d = 0; d < 2; ++d)
    if (!is_multiple(p.placement_spacing, p.grid.spacing[d]) ||
        !is_multiple(p.grid.extent(d), p.placement_spacing))
      fail("Placement spacing",
           to_text(p.placement_spacing) +
             " m does not divide the box of Grid/Size into whole squares of whole "
             "cells; a side is " +
             to_text(p.grid.extent(d)) + " m long and a cell " +
             to_text(p.grid.spacing[d]) + " m");
}

/** Fibre sizes against each other, the cells and the box. */
void check_sizes(const FibrePlacement &p, const UniformGrid<2> &grid)
{
  const double almost = 1. - 1e-6;
  if (!(p.min_height <= p.max_height))
    fail("Minimum height", to_text(p.min_height) +
                             " m is more than the maximum height of " +
                             to_text(p.max_height) + " m");
  const auto check = [&](const char *key, const double length, const unsigned int d,
                         const double largest) {
    if (!(length >= almost * grid.spacing[d]))
      fail(key, to_text(length) + " m is less than a cell, " + to_text(grid.spacing[d]) +
                  " m: such fibres would vanish; increase Grid/Cells or the " +
                  (d == 0 ? "width" : "height"));
    if (!p.cut_by_border && !(almost * largest <= grid.extent(d)))
      fail(d == 0 ? key : "Maximum height",
           to_text(largest) + " m is more than the box of " + to_text(grid.extent(d)) +
             " m; reduce it or set Cut by border");
  };
  check("Fibre width", p.width, 0, p.width);
  check("Minimum height", p.min_height, 1, p.max_height);
}

void check_fibres(const MicrostructureParameters &p)
{
  const FibrePlacement &rules = p.placement;
  if (p.placement_spacing > 0.)
    check_placement_spacing(p);
  check_sizes(rules, p.placement_grid());
  if (rules.allow_overlap && rules.minimum_gap > 0.)
    fail("Minimum gap", "a gap of " + to_text(rules.minimum_gap) +
                          " m contradicts Allow overlap; set one of them to 0 or false");
  check_fibre_phase(p, random_fibres_section);
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
}
} // namespace

void MicrostructureParameters::bind(Keys &keys, const unsigned int dimension)
{
  dim = dimension;
  bind_grid(keys, *this);
  bind_phases(keys, phases);
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
    "if needed, phase (the index, 1 where missing). Image: PNG, or text "
    "with rows of whole numbers from the top. Voxels [z][y][x]: .npy, .raw, .h5, or a "
    "stack of PNG or TIFF: their folder, a pattern of their names with * and ?, or a "
    "TIFF "
    "of several pages [-]");
  keys.bind_list(
    "Image values", image.values, std::numeric_limits<int>::min(),
    std::numeric_limits<int>::max(),
    "Image, voxels: the value of each phase in the order of Phases/Names. Empty: "
    "the values that occur, in ascending order, if there are as many as "
    "phases [-]",
    0, std::numeric_limits<std::size_t>::max());
  keys.bind("Oblong pixels", image.oblong_pixels,
            "Image: the pixels need not be squares in the body; otherwise Grid/Cells "
            "and Grid/Size have to make them so within 1 % [-]");
  keys.only_with("Type", {"random fibres"}, {"Random fibres/"});
  if (has_grids_in_3d)
    {
      voxels.bind(keys, file);
      keys.only_with("Type", {"random inclusions"}, {"Random inclusions/"});
      const auto subsection = keys.section("Random inclusions");
      inclusions.bind(keys);
    }
  keys.only_with("Type", {"rectangles", "image", "voxels"}, {"File"});
  keys.only_with("Type", {"image", "voxels"}, {"Image values"});
  keys.only_with("Type", {"image"}, {"Oblong pixels"});

  const auto subsection = keys.section("Random fibres");
  bind_fibres(keys, placement);
  keys.bind("Phase", fibre_phase,
            "Name of the phase of the fibres; empty: the second of Phases/Names [-]");
  bind_rules(keys, placement);
  keys.bind("Placement spacing", placement_spacing, Range::non_negative(),
            "Edge of the squares on which fibres are placed, a multiple of the edge of "
            "a cell: the morphology stays the same when the grid is refined. 0: they "
            "are placed on the cells [m]");
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

unsigned int MicrostructureParameters::fibre_phase_index() const
{
  const bool fibres             = type != Type::random_inclusions;
  const std::string &phase_name = fibres ? fibre_phase : inclusions.phase;
  if (phase_name.empty() && phases.size() < 2)
    throw UserError("Phases/Names: there is only one phase; name a second one for the " +
                    std::string(fibres ? "fibres" : "inclusions") +
                    ", or choose the homogeneous microstructure");
  if (phase_name.empty())
    return 1;
  std::vector<std::string> names;
  for (const PhaseParameters &phase : phases)
    names.push_back(phase.name);
  const auto found = std::find(names.begin(), names.end(), phase_name);
  if (found == names.end())
    fail("Phase",
         "there is no phase '" + phase_name + "'; Phases/Names has " + to_text(names),
         fibres ? random_fibres_section : random_inclusions_section);
  return static_cast<unsigned int>(found - names.begin());
}
} // namespace mesoslip
