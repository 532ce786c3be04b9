#include "morphology/fibre_parameters.h"

#include "base/errors.h"
#include "morphology/microstructure_parameters.h"
#include "parameters/keys.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
void bind_fibre_sizes(Keys &keys, FibrePlacement &placement)
{
  keys.bind("Seed", placement.seed, 0, largest_seed,
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

/** Checks fibre sizes against each other, the cells and the box. */
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
} // namespace

void bind_fibres(Keys &keys, MicrostructureParameters &p)
{
  const auto section = keys.section("Random fibres");
  bind_fibre_sizes(keys, p.placement);
  keys.bind("Phase", p.fibre_phase,
            "Name of the phase of the fibres; empty: the second of Phases/Names [-]");
  bind_rules(keys, p.placement);
  keys.bind("Placement spacing", p.placement_spacing, Range::non_negative(),
            "Edge of the squares on which fibres are placed, a multiple of the edge of "
            "a cell: the morphology stays the same when the grid is refined. 0: they "
            "are placed on the cells [m]");
}

void check_fibre_phase(const MicrostructureParameters &p, const std::string &section)
{
  if (p.fibre_phase_index() == 0)
    fail("Phase",
         "'" + p.phases[0].name +
           "' is the background, the first of Phases/Names; name another phase",
         section);
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
