#include "morphology/microstructure_parameters.h"

#include "base/errors.h"
#include "parameters/keys.h"
#include "program/resources.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mesoslip
{
namespace
{
const std::string section_name = "Microstructure";

using Type = MicrostructureParameters::Type;

void bind_shape(Keys &keys, FibrePlacement &placement)
{
  keys.bind("Seed", placement.seed, 0, std::numeric_limits<long>::max(),
            "Start of the random numbers; a seed gives the same morphology everywhere "
            "[-]");
  keys.bind("Fibre width", placement.width, Range::positive(),
            "Width of all fibres along x [m]");
  keys.bind("Minimum height", placement.min_height, Range::positive(),
            "Smallest height of a fibre along y; heights are uniformly distributed "
            "between the two [m]");
  keys.bind("Maximum height", placement.max_height, Range::positive(),
            "Largest height of a fibre along y [m]");
}

void bind_rules(Keys &keys, FibrePlacement &placement)
{
  keys.bind("Area fraction", placement.area_fraction, Range::open(0., 1.),
            "Area of the fibres over area of the box [-]");
  keys.bind("Fraction rule", placement.fraction_rule, {"actual", "nominal"},
            "actual: area of the cells that become fibre; nominal: sum of the "
            "fibres' areas, overlaps counted twice [-]");
  keys.bind("Trim last fibre", placement.trim_last,
            "With the actual fraction: shorten the last fibre to meet it [-]");
  keys.bind("Allow overlap", placement.allow_overlap, "Fibres may overlap [-]");
  keys.bind("Minimum gap", placement.minimum_gap, Range::non_negative(),
            "Between fibres, in x or in y, rounded up to whole cells [m]");
  keys.bind("Cut by border", placement.cut_by_border,
            "Fibres may stick out of the box and are cut; otherwise they lie "
            "inside [-]");
  keys.bind("Align to grid", placement.align_to_grid,
            "Edges of fibres lie on edges of cells; otherwise they lie anywhere and "
            "the cells with their centre inside become fibre [-]");
}

[[noreturn]] void fail(const std::string &key, const std::string &what)
{
  throw UserError(random_fibres_section + "/" + key + ": " + what);
}

void check_placement_spacing(const MicrostructureParameters &p)
{
  const UniformGrid<2> grid = p.grid.grid();
  for (unsigned int d = 0; d < 2; ++d)
    if (!is_multiple(p.placement_spacing, grid.spacing[d]) ||
        !is_multiple(grid.extent(d), p.placement_spacing))
      fail(
        "Placement spacing",
        to_text(p.placement_spacing) +
          " m does not divide the box of Grid/Size into whole squares of whole cells; a "
          "side is " +
          to_text(grid.extent(d)) + " m long and a cell " + to_text(grid.spacing[d]) +
          " m");
}

/** Fibre sizes against each other, the cells and the box. */
void check_sizes(const FibrePlacement &p, const UniformGrid<2> &grid)
{
  const double almost = 1. - 1e-6;
  if (!(p.min_height <= p.max_height))
    fail("Minimum height", to_text(p.min_height) +
                             " m is more than the maximum height of " +
                             to_text(p.max_height) + " m");
  if (!(p.width >= almost * grid.spacing[0]))
    fail("Fibre width",
         to_text(p.width) + " m is less than a cell, " + to_text(grid.spacing[0]) +
           " m: such fibres would vanish; increase Grid/Cells or the width");
  if (!(p.min_height >= almost * grid.spacing[1]))
    fail("Minimum height",
         to_text(p.min_height) + " m is less than a cell, " + to_text(grid.spacing[1]) +
           " m: such fibres would vanish; increase Grid/Cells or the height");
  if (!p.cut_by_border && !(almost * p.width <= grid.extent(0)))
    fail("Fibre width", to_text(p.width) + " m is more than the box of " +
                          to_text(grid.extent(0)) + " m; reduce it or set Cut by border");
  if (!p.cut_by_border && !(almost * p.max_height <= grid.extent(1)))
    fail("Maximum height", to_text(p.max_height) + " m is more than the box of " +
                             to_text(grid.extent(1)) +
                             " m; reduce it or set Cut by border");
}

void check_fibres(const MicrostructureParameters &p)
{
  const FibrePlacement &rules = p.placement;
  if (!(rules.area_fraction > 0. && rules.area_fraction < 1.))
    fail("Area fraction",
         to_text(rules.area_fraction) + " must lie between 0 and 1; 0.1 is 10 %");
  if (p.placement_spacing > 0.)
    check_placement_spacing(p);
  check_sizes(rules, p.placement_grid());
  if (!(rules.minimum_gap >= 0.) || !std::isfinite(rules.minimum_gap))
    fail("Minimum gap", to_text(rules.minimum_gap) + " m is not a length");
  if (rules.allow_overlap && rules.minimum_gap > 0.)
    fail("Minimum gap", "a gap of " + to_text(rules.minimum_gap) +
                          " m contradicts Allow overlap; set one of them to 0 or false");
  if (p.fibre_phase_index() == 0)
    fail("Phase", "'" + p.phases.phases[0].name +
                    "' is the background, the first of Phases/Names; name another phase");
}

void check_image_values(const MicrostructureParameters &p)
{
  const std::set<long> distinct(p.image_values.begin(), p.image_values.end());
  if (!p.image_values.empty() && (distinct.size() != p.image_values.size() ||
                                  p.image_values.size() != p.phases.phases.size()))
    throw UserError(section_name + "/Image values: there are " +
                    std::to_string(distinct.size()) + " different values for " +
                    std::to_string(p.phases.phases.size()) +
                    " phases; give one value for each of Phases/Names");
}
} // namespace

void MicrostructureParameters::bind(Keys &keys)
{
  grid.bind(keys);
  phases.bind(keys);
  {
    const auto section = keys.section(section_name);
    keys.bind("Type", type, {"homogeneous", "random fibres", "rectangles", "image"},
              "Where the morphology comes from; homogeneous is all of the first "
              "phase [-]");
    keys.bind_input("File", file,
                    "Rectangles: CSV with x_left_mm,y_bottom_mm,width_mm,height_mm and, "
                    "if needed, phase (1 where missing). Image: PNG or rows of whole "
                    "numbers from the top [-]");
    keys.bind_list("Image values", image_values, std::numeric_limits<int>::min(),
                   std::numeric_limits<int>::max(),
                   "Image value of each phase in the order of Names. Empty: the "
                   "values that occur, in ascending order, if there are as many as "
                   "phases [-]",
                   0, std::numeric_limits<std::size_t>::max());
    keys.bind("Oblong pixels", oblong_pixels,
              "Image: the pixels need not be squares in the body; otherwise Grid/Cells "
              "and Grid/Size have to make them so within 1 % [-]");
  }
  const auto section = keys.section(random_fibres_section);
  bind_shape(keys, placement);
  keys.bind("Phase", fibre_phase, "Phase of the fibres; empty: the second of Names [-]");
  bind_rules(keys, placement);
  keys.bind("Placement spacing", placement_spacing, Range::non_negative(),
            "Edge of the squares on which fibres are placed, a multiple of the cell: "
            "keeps the morphology when the grid is refined. 0: the cells [m]");
}

void MicrostructureParameters::check_keys(const Keys &keys)
{
  GridParameters::check_keys(keys);
  PhaseParameters::check_keys(keys);
  const std::string type = section_name + "/Type";
  keys.only_with(type, {"random fibres"}, {random_fibres_section + "/"});
  keys.only_with(type, {"rectangles", "image"}, {section_name + "/File"});
  keys.only_with(type, {"image"},
                 {section_name + "/Image values", section_name + "/Oblong pixels"});
  keys.only_with(random_fibres_section + "/Fraction rule", {"actual"},
                 {random_fibres_section + "/Trim last fibre"});
}

void MicrostructureParameters::check() const
{
  grid.check();
  phases.check();
  if (type == Type::random_fibres)
    check_fibres(*this);
  if (type == Type::image)
    check_image_values(*this);
  if (type == Type::image || type == Type::rectangles)
    {
      require_memory({static_cast<double>(grid.grid().n_cells()), "reduce Grid/Cells"});
      make_microstructure(*this);
    }
}

UniformGrid<2> MicrostructureParameters::placement_grid() const
{
  UniformGrid<2> result = grid.grid();
  if (placement_spacing > 0.)
    for (unsigned int d = 0; d < 2; ++d)
      {
        const double n    = std::max(1., std::round(grid.size[d] / placement_spacing));
        result.cells[d]   = static_cast<unsigned int>(n);
        result.spacing[d] = grid.size[d] / n;
      }
  return result;
}

unsigned int MicrostructureParameters::fibre_phase_index() const
{
  if (!fibre_phase.empty())
    return phases.index_of(fibre_phase, random_fibres_section + "/Phase");
  if (phases.phases.size() < 2)
    throw UserError("Phases/Names: there is only one phase; name a second one for the "
                    "fibres, or choose the homogeneous microstructure");
  return 1;
}
} // namespace mesoslip
