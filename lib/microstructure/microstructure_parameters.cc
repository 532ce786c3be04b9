#include "microstructure/microstructure_parameters.h"

#include "io/errors.h"
#include "io/key_use.h"
#include "io/parameters.h"
#include "io/resources.h"

#include <deal.II/base/parameter_handler.h>

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

const std::vector<std::string> type_names = {"homogeneous", "random fibres", "rectangles",
                                             "image"};

void declare_shape(dealii::ParameterHandler &prm, const FibrePlacement &defaults)
{
  declare_integer(prm, "Seed", static_cast<long>(defaults.seed), 0,
                  std::numeric_limits<long>::max(),
                  "Start of the random numbers; a seed gives the same morphology "
                  "everywhere [-]");
  declare_double(prm, "Fibre width", defaults.width, Range::positive(),
                 "Width of all fibres along x [m]");
  declare_double(prm, "Minimum height", defaults.min_height, Range::positive(),
                 "Heights along y are uniform from here [m]");
  declare_double(prm, "Maximum height", defaults.max_height, Range::positive(),
                 "to here [m]");
  declare_string(prm, "Phase", "", "Phase of the fibres; empty: the second of Names [-]");
}

void declare_rules(dealii::ParameterHandler &prm, const FibrePlacement &defaults)
{
  declare_double(prm, "Area fraction", defaults.area_fraction, Range::open(0., 1.),
                 "Area of the fibres over area of the box [-]");
  declare_selection(prm, "Fraction rule", "actual", {"actual", "nominal"},
                    "actual: area of the cells that become fibre; nominal: sum of the "
                    "fibres' areas, overlaps counted twice [-]");
  declare_bool(prm, "Trim last fibre", defaults.trim_last,
               "With the actual fraction: shorten the last fibre to meet it [-]");
  declare_bool(prm, "Allow overlap", defaults.allow_overlap, "Fibres may overlap [-]");
  declare_double(prm, "Minimum gap", defaults.minimum_gap, Range::non_negative(),
                 "Between fibres, in x or in y, rounded up to whole cells [m]");
  declare_bool(prm, "Cut by border", defaults.cut_by_border,
               "Fibres may stick out of the box and are cut; otherwise they lie "
               "inside [-]");
  declare_bool(prm, "Align to grid", defaults.align_to_grid,
               "Edges of fibres lie on edges of cells; otherwise they lie anywhere and "
               "the cells with their centre inside become fibre [-]");
  declare_double(
    prm, "Placement spacing", 0., Range::non_negative(),
    "Edge of the squares on which fibres are placed, a multiple of the cell: "
    "keeps the morphology when the grid is refined. 0: the cells [m]");
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

void MicrostructureParameters::declare(dealii::ParameterHandler &prm,
                                       const RawParameters &raw)
{
  GridParameters::declare(prm);
  PhaseParameters::declare(prm, raw);
  {
    const ParameterSection section(prm, section_name);
    declare_selection(prm, "Type", "random fibres", type_names,
                      "Where the morphology comes from; homogeneous is all of the first "
                      "phase [-]");
    declare_input_file(
      prm, "File", "",
      "Rectangles: CSV with x_left_mm,y_bottom_mm,width_mm,height_mm and, "
      "if needed, phase (1 where missing). Image: PNG or rows of whole "
      "numbers from the top [-]");
    declare_integer_list(prm, "Image values", {}, std::numeric_limits<int>::min(),
                         std::numeric_limits<int>::max(),
                         "Image value of each phase in the order of Names. Empty: the "
                         "values that occur, in ascending order, if there are as many as "
                         "phases [-]");
    declare_bool(
      prm, "Oblong pixels", false,
      "Image: the pixels need not be squares in the body; otherwise Grid/Cells "
      "and Grid/Size have to make them so within 1 % [-]");
  }
  const ParameterSection section(prm, random_fibres_section);
  declare_shape(prm, FibrePlacement());
  declare_rules(prm, FibrePlacement());
}

void MicrostructureParameters::check_keys(const KeyUse &use)
{
  GridParameters::check_keys(use);
  PhaseParameters::check_keys(use);
  const std::string type = section_name + "/Type";
  use.only_with(type, {"random fibres"}, {random_fibres_section + "/"});
  use.only_with(type, {"rectangles", "image"}, {section_name + "/File"});
  use.only_with(type, {"image"},
                {section_name + "/Image values", section_name + "/Oblong pixels"});
  use.only_with(random_fibres_section + "/Fraction rule", {"actual"},
                {random_fibres_section + "/Trim last fibre"});
}

void MicrostructureParameters::parse(dealii::ParameterHandler &prm)
{
  grid.parse(prm);
  phases.parse(prm);
  {
    const ParameterSection section(prm, section_name);
    const std::string name = get_string(prm, "Type");
    for (std::size_t i = 0; i < type_names.size(); ++i)
      if (type_names[i] == name)
        type = static_cast<Type>(i);
    file          = get_string(prm, "File");
    image_values  = get_integer_list(prm, "Image values");
    oblong_pixels = get_bool(prm, "Oblong pixels");
  }
  const ParameterSection section(prm, random_fibres_section);
  placement.seed          = static_cast<std::uint64_t>(get_integer(prm, "Seed"));
  placement.width         = get_double(prm, "Fibre width");
  placement.min_height    = get_double(prm, "Minimum height");
  placement.max_height    = get_double(prm, "Maximum height");
  placement.area_fraction = get_double(prm, "Area fraction");
  placement.fraction_rule = get_string(prm, "Fraction rule") == "actual"
                              ? FractionRule::actual
                              : FractionRule::nominal;
  placement.trim_last     = get_bool(prm, "Trim last fibre");
  placement.allow_overlap = get_bool(prm, "Allow overlap");
  placement.minimum_gap   = get_double(prm, "Minimum gap");
  placement.cut_by_border = get_bool(prm, "Cut by border");
  placement.align_to_grid = get_bool(prm, "Align to grid");
  fibre_phase             = get_string(prm, "Phase");
  placement_spacing       = get_double(prm, "Placement spacing");
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
